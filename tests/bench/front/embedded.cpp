#include "tests/bench/front/embedded.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sfsm/number_text.h"
#include "sfsm/report/markup.h"
#include "tests/bench/front/chart.h"
#include "tests/bench/front/sentences.h"

namespace bench::front {
namespace {

using sfsm::report::json_string;

// A list of what write(item) gives for each.
template <class Items, class Write>
std::string list(const Items& items, Write write) {
    std::string out = "[";
    for (const auto& item : items) {
        if (out.size() > 1) out += ", ";
        out += write(item);
    }
    return out + "]";
}

std::string number(double value, int digits) {
    if (std::isnan(value)) return "\"NaN\"";
    if (std::isinf(value)) return value > 0 ? "\"Infinity\"" : "\"-Infinity\"";
    constexpr double plain = 1e7;  // beyond, a rounded text would be shorter but another number
    return std::abs(value) < plain ? sfsm::report::figure(value, digits) : sfsm::number_text(value);
}

std::string error_of(const ErrorKind& error) {
    return "{\"id\": " + json_string(error.id) + ", \"name\": " + json_string(error.name) +
           ", \"unit\": " + json_string(error.unit) + ", \"meaning\": " + json_string(error.meaning) +
           ", \"digits\": " + std::to_string(error.digits) +
           ", \"isMore\": " + (error.more_is_better ? "true" : "false") + "}";
}

std::string sentence_of(const Sentence& sentence) {
    return "[" + json_string(sentence.before) + ", " + json_string(sentence.key) + ", " + json_string(sentence.after) +
           "]";
}

// In the order that page/data.js takes them.
std::string row_of(const Row& row, std::size_t place, const std::vector<std::string>& families) {
    const auto family = std::find(families.begin(), families.end(), row.family) - families.begin();
    const auto error = [&](const ErrorKind& kind) { return number(kind.value(row), 5); };
    const auto count = [](std::int64_t value) { return std::to_string(value); };
    std::string out = "[" + std::to_string(place) + ", " + std::to_string(family) + ", " + json_string(row.family) +
                      ", " + json_string(row.setting) + ", " + json_string(row.law);
    for (const double ms : {row.target_ms, row.wall_ms, row.wall_low_ms, row.wall_high_ms, row.process_ms})
        out += ", " + number(ms, 3);
    out += ", " + list(error_kinds(), error) + ", " + list(row.work.counts, count);
    for (const double value : {row.crowd_share, row.frame.brightness, row.crowd.brightness, row.motion_worst_px,
                               row.outline_worst_px, row.covering_px, row.density})
        out += ", " + number(value, 4);
    return out + ", " + std::to_string(row.samples) + "]";
}

std::string scene_of(const Scene& scene, const std::vector<std::string>& families) {
    std::string out = "{\"people\": " + std::to_string(scene.people) + ", \"view\": " + json_string(scene.view) +
                      ", \"name\": " + json_string(scene.name()) + ", \"rows\": [";
    for (std::size_t i = 0; i < scene.rows.size(); ++i)
        out += (i == 0 ? "\n" : ",\n") + row_of(scene.rows[i], scene.places[i], families);
    const auto index = [](std::size_t i) { return std::to_string(i); };
    const auto front = [&](const ErrorKind& error) { return list(front_of(scene.rows, error), index); };
    const auto draw = [&](const ErrorKind& error) { return sentence_of(what_to_draw(scene, error)); };
    const auto buys = [&](const ErrorKind& error) { return sentence_of(what_a_millisecond_buys(scene, error)); };
    return out + "],\n\"fronts\": " + list(error_kinds(), front) + ", \"draw\": " + list(error_kinds(), draw) +
           ", \"buys\": " + list(error_kinds(), buys) + "}";
}

std::string loss_of(const Loss& loss) {
    const auto index = [](const std::optional<std::size_t>& i) { return i ? std::to_string(*i) : "null"; };
    return "{\"sentence\": " + sentence_of(loss.sentence) + ", \"scene\": " + index(loss.scene) +
           ", \"row\": " + index(loss.row) + "}";
}

std::string image_address(const std::string& bytes, const std::string& whose) {
    const bool is_png = bytes.starts_with("\x89PNG\r\n\x1A\n"), is_jpeg = bytes.starts_with("\xFF\xD8\xFF");
    if (!is_png && !is_jpeg) {
        throw std::runtime_error("the crop of " + whose + ": found " + std::to_string(bytes.size()) +
                                 " bytes of something else, expected a PNG or JPEG");
    }
    return json_string(std::string(is_png ? "data:image/png" : "data:image/jpeg") + ";base64," +
                       sfsm::report::base64(bytes));
}

std::string crops_of(const Front& front, const Crops& crops) {
    return "{" + list(crops.of_rows, [&](const Crop& crop) {
                     const std::string row = std::to_string(crop.row);
                     if (crop.row >= front.rows.size()) {
                         throw std::runtime_error("found a crop of row " + row + ", expected one of the " +
                                                  std::to_string(front.rows.size()) + " rows of the front");
                     }
                     return "\n\"" + row + "\": " + image_address(crop.image, "row " + row);
                 }).substr(1);
}

std::string references_of(const std::vector<Scene>& scenes, const Crops& crops) {
    return list(scenes, [&](const Scene& scene) {
        const auto found = crops.references.find({scene.people, scene.view});
        if (found == crops.references.end()) return std::string("null");
        return image_address(found->second, scene.name() + ", the reference");
    });
}

}  // namespace

std::string embedded(const Front& front, const std::vector<Scene>& scenes, const Crops& crops) {
    const std::vector<std::string> families = families_of(front);
    std::string crop_table = crops_of(front, crops);
    crop_table.back() = '}';
    const auto loses = [&](const ErrorKind& error) { return loss_of(where_the_law_loses(scenes, error)); };
    return "{\"frameMs\": " + number(frame_ms, 1) + ",\n\"errors\": " + list(error_kinds(), error_of) +
           ",\n\"families\": " + list(families, json_string) +
           ",\n\"work\": " + list(sfsm::work_table, [](const auto& kind) { return json_string(kind.meaning); }) +
           ",\n\"loses\": " + list(error_kinds(), loses) +
           ",\n\"scenes\": " + list(scenes, [&](const Scene& scene) { return scene_of(scene, families); }) +
           ",\n\"crops\": " + crop_table + ",\n\"references\": " + references_of(scenes, crops) + "}\n";
}

}  // namespace bench::front
