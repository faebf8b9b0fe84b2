#include "tests/bench/loss/sums.h"

#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "sfsm/number_text.h"

namespace bench::loss {

namespace {

constexpr std::string_view columns = "people,view,fitted,drawing,recipe,what,height,spacing,cell,shown,pixels,flip";
constexpr std::size_t fields = 12;
constexpr auto names = std::to_array<std::string_view>(
    {"mesh", "points", "splats", "shade", "motion", "background", "frame", "all", "ground", "unrest"});

constexpr std::array numbers = {&Sum::height, &Sum::spacing, &Sum::cell, &Sum::shown, &Sum::pixels, &Sum::flip};

std::string line_of(const Picture& picture, const Sum& sum) {
    std::string line = std::to_string(picture.people) + ',' + picture.view + ',' + (picture.is_fitted ? '1' : '0') +
                       ',' + std::string(sfsm::name_of(picture.drawing)) + ',' + picture.recipe + ',' +
                       std::string(names[static_cast<std::size_t>(sum.what)]);
    for (const auto number : numbers) {
        char text[32];
        std::snprintf(text, sizeof text, ",%.6g", sum.*number);
        line += text;
    }
    return line + '\n';
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> all;
    for (std::size_t from = 0, end = 0; end != std::string_view::npos; from = end + 1) {
        end = line.find(',', from);
        all.push_back(line.substr(from, end - from));
    }
    return all;
}

// Of a line that says which picture it is of; nothing for what is no such line.
std::optional<std::pair<Picture, Sum>> read(std::string_view line) {
    const std::vector<std::string_view> all = split(line);
    if (all.size() != fields) return {};
    std::pair<Picture, Sum> read;
    auto& [picture, sum] = read;
    const auto people = sfsm::parse_integer(all[0]);
    const auto drawing = sfsm::drawing_named(all[3]);
    if (!people || !drawing || (all[2] != "0" && all[2] != "1")) return {};
    picture = {*people, std::string(all[1]), all[2] == "1", *drawing, std::string(all[4]), {}};
    std::size_t what = 0;
    while (what < names.size() && names[what] != all[5]) ++what;
    if (what == names.size()) return {};
    sum.what = static_cast<What>(what);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = sfsm::parse_double(all[6 + i]);
        if (!number) return {};
        sum.*numbers[i] = *number;
    }
    return read;
}

bool is_same(const Picture& a, const Picture& b) {
    return a.people == b.people && a.view == b.view && a.drawing == b.drawing && a.recipe == b.recipe;
}

}  // namespace

std::string to_csv(const std::vector<Picture>& pictures) {
    std::string text = std::string(columns) + '\n';
    for (const Picture& picture : pictures)
        for (const Sum& sum : picture.sums) text += line_of(picture, sum);
    return text;
}

std::vector<Picture> from_csv(std::string_view text, const std::string& name) {
    std::vector<Picture> pictures;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const auto at = [&] { return name + ":" + std::to_string(number) + ": "; };
        if (number == 1) {
            if (line != columns)
                throw std::runtime_error(at() + "found other columns, expected " + std::string(columns));
            continue;
        }
        const auto found = read(line);
        if (!found) throw std::runtime_error(at() + "found '" + std::string(line) + "', expected a sum of a picture");
        if (pictures.empty() || !is_same(pictures.back(), found->first)) pictures.push_back(found->first);
        pictures.back().sums.push_back(found->second);
    }
    if (pictures.empty()) throw std::runtime_error(name + ":1: found no pictures, expected " + std::string(columns));
    return pictures;
}

}  // namespace bench::loss
