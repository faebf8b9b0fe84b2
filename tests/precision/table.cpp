#include "tests/precision/table.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/precision/control.h"
#include "tests/precision/people.h"
#include "tests/precision/things.h"

namespace precision {

namespace {

constexpr double broken = 0.5;                    // [px]
constexpr Setting sharpest{1, 0, 1, 7680, 4320};  // a third of an 8K picture's height through a lens of one degree

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

std::string large(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value < 1e6 ? "%.6g" : "%.2e", value);
    return text;
}

std::string name_of(const Lens& lens) {
    return std::to_string(static_cast<int>(lens.fov)) + "°, " + std::to_string(lens.width) + "x" +
           std::to_string(lens.height);
}

Setting setting_of(double origin, std::int64_t tick, const Lens& lens) {
    return {origin, tick, lens.fov, lens.width, lens.height};
}

// Doubles a value until its error is half a pixel.
template <typename Off>
double first_broken(double from, Off off) {
    while (from < 1e300 && off(from) <= broken) from *= 2;
    return from;
}

void measure_lens(const Lens& lens, std::vector<Line>& lines) {
    enum { standing, walking, depth, skinning, native, opengl, all, structure, middle, area, steps };
    constexpr std::array<const char*, steps> names{
        "where who stands is",  "where who walks is",      "depth, as long from aside",    "skinning, packed",
        "projection, natively", "projection, OpenGL",      "skinning to pixels, natively", "structure, natively",
        "coverage: its middle", "coverage: its area [px²]"};
    const std::size_t first = lines.size();
    for (const char* name : names) lines.push_back({name, name_of(lens), {}});
    for (std::size_t origin = 0; origin < origins.size(); ++origin)
        for (const std::int64_t tick : ticks) {
            const Setting setting = setting_of(origins[origin], tick, lens);
            const PeopleErrors people = errors_of_people(setting);
            const CoverageErrors coverage = errors_of_coverage(setting);
            const std::array<Errors, steps> errors{
                people.standing, people.walking, people.depth, people.skinning,
                people.native,   people.opengl,  people.all,   errors_of_structure(setting),
                coverage.middle, coverage.area};
            for (std::size_t step = 0; step < steps; ++step) lines[first + step].at[origin].include(errors[step]);
        }
}

double least_covered_height() {
    constexpr double off = 0.25;
    double height = 1;
    const double unit = area_of_person(height);
    while (height > 1e-6 && std::abs(area_of_person(height) / (unit * height * height) - 1) < off) height /= 2;
    return height;
}

}  // namespace

std::vector<Line> measure_lines() {
    std::vector<Line> lines;
    for (const Lens& lens : lenses) measure_lens(lens, lines);
    return lines;
}

std::vector<LawLine> measure_law() {
    const auto off = [](const Loop& loop) { return errors_of_control(loop).worst; };
    constexpr std::int64_t to_1e15 = 125'000'000;  // times eight million triangles; more count as so many
    return {{"times of 1e-3 ms", off({1e-4, 1})},
            {"times of 1e6 ms", off({1e5, 1})},
            {"counts to 1e15", off({1, to_1e15})},
            {"a million frames, against two thousand", drift_of_control(1'000'000)}};
}

std::vector<Limit> measure_limits() {
    const double standing = first_broken(origins.back(), [](double origin) {
        Setting setting = sharpest;
        setting.origin = origin;
        return errors_of_standing(setting, 0).worst;
    });
    const double away = first_broken(16, [](double metres) { return errors_of_standing(sharpest, metres).worst; });
    const double structure =
        first_broken(16, [](double metres) { return errors_of_structure(sharpest, metres).worst; });
    const double days = first_broken(30, [](double run) {
        Setting setting = sharpest;
        setting.tick = static_cast<std::int64_t>(run * static_cast<double>(thirty_days / 30));
        return errors_of_walking(setting).worst;
    });
    const double nearest = sharpest.distance() * errors_of_people(sharpest).skinning.worst / broken;
    return {
        {"a block, from the world's origin", standing, "m", "the cameras' own double; camera files end at 100 km"},
        {"a person, from their block's origin", away, "m",
         "float32 of their place; blocks that reach half as far are refused"},
        {"a corner, from the structure's origin", structure, "m",
         "float32 of its place, and of the camera's: structures are to be smaller"},
        {"who walks, into a run", days, "days", "double of the way that they have gone"},
        {"who is looked at through a lens of 1° in 8K, nearest", nearest, "m",
         "the 16 bits of packed poses: nearer, half a pixel shows"},
        {"two people 0.5 m apart: selection", depth_limit_of_frame(), "m of depth",
         "float32: they are equally far, and a twentieth of a pixel tall"},
        {"two people 0.5 m apart: depth buffer", depth_limit_of_buffer(), "m of depth", "float32 reversed: the same"},
        {"two people 0.5 m apart: native order", depth_limit_of_sort(), "m of depth",
         "the same: before, who is behind never prevails"},
        {"a far person's height, natively", least_covered_height(), "px",
         "coverage counts 1/8192 of a cell: whoever is lower fades"}};
}

std::string row_of(const Line& line) {
    std::string row = "| " + line.step + " | " + line.lens + " |";
    for (const Errors& errors : line.at) row += " " + number(errors.worst) + " (" + number(errors.mean()) + ") |";
    return row;
}

std::string row_of(const LawLine& line) {
    return "| " + line.loop + " | " + number(line.off) + " |";
}

std::string row_of(const Limit& limit) {
    return "| " + limit.what + " | " + large(limit.at) + " " + limit.unit + " | " + limit.meaning + " |";
}

}  // namespace precision
