#include "tests/bench/front/made_up.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "render/image.h"
#include "sfsm/controller.h"
#include "sfsm/number_text.h"
#include "sfsm/random.h"
#include "tests/bench/front/before_rates.h"

namespace bench::front {
namespace {

using sfsm::WorkKind;

constexpr double made_up_targets[] = {4, 8, 16.6, 33, 100};

struct View {
    std::string name;
    bool is_preset;
    double seen;  // share of the people
    double near;  // how large they are
};

std::vector<View> made_up_views() {
    std::vector<View> views = {{"still", true, 0.8, 1},
                               {"close", true, 0.3, 2.5},
                               {"medium", true, 0.5, 1.5},
                               {"remote", true, 1, 0.5},
                               {"wide", true, 1, 0.25}};
    for (int i = 0; i < 8; ++i) {
        const double swing = std::sin(1.7 * i);
        views.push_back({"roam-" + std::to_string(4 + i * 8) + "s", false, 0.6 + 0.3 * swing, 1.2 - 0.7 * swing});
    }
    return views;
}

// In [-1, 1], of the row alone.
double chance(const Row& row, std::uint64_t what) {
    const std::uint64_t bits =
        sfsm::hash(std::hash<std::string>{}(row.view + row.family + row.setting + row.law), what);
    return 2 * static_cast<double>(sfsm::upper_unit(bits)) - 1;
}

// What a setting is: how many ms a person and of itself, and what it leaves of an error.
struct Way {
    std::string family, setting;
    double us_a_person, flip, motion;
    double splat_size = 0, density = 0;
    int samples = 0;
    double rate = 0;
};

std::vector<Way> made_up_ways() {
    std::vector<Way> ways = {{"native triangles", "4 samples", 4.5, 0.004, 0, 0, 0, 4},
                             {"OpenGL triangles", "1 sample", 60, 0.031, 0, 0, 0, 1},
                             {"OpenGL triangles", "4 samples", 150, 0.009, 0, 0, 0, 4}};
    for (const double density : {1.2, 0.6, 2.4}) {
        for (const double s : {0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6}) {
            const std::string more = density == 1.2 ? "" : ", density " + sfsm::number_text(density);
            ways.push_back({"native points" + more, "S = " + sfsm::number_text(s), 0.25 + density / std::pow(s, 1.3),
                            0.008 + 0.012 * std::pow(s, 0.8) / std::sqrt(density), 0, s, density, 4});
        }
    }
    for (const double s : {1.0, 1.4, 2.0, 2.8, 4.0})
        ways.push_back({"OpenGL points", "S = " + sfsm::number_text(s), 3 + 9 / s, 0.02 + 0.02 * s, 0, s, 1.2, 1});
    for (const double rate : {0.0001, 0.0008, 0.0064, 0.0512}) {
        const double coarse = std::log2(rate / 0.0001) / 3;
        ways.push_back({"native rates", "rate = " + sfsm::number_text(rate), 0.2 + 3 / std::exp2(coarse),
                        0.005 + 0.006 * coarse, 0, 0.5 + coarse, 0, 4, rate});
        ways.push_back({"rival: by distance", sfsm::number_text(320 / std::exp2(coarse)) + " m",
                        0.25 + 3.5 / std::exp2(coarse), 0.006 + 0.009 * coarse, 0, 0.5 + coarse, 0, 4});
    }
    for (const double share : {0.05, 0.25, 0.5, 0.75}) {
        const std::string d = "D = " + sfsm::number_text(share) + " L";
        ways.push_back({"native motion", d, 4.1 + 0.4 * share, 0.004 + 0.01 * (1 - share), 2 - 2 * share, 0, 0, 4});
        ways.push_back(
            {"native mixture", d + ", S = 2", 0.6 + 0.1 * share, 0.03 - 0.006 * share, 2 - 2 * share, 2, 1.2, 4});
    }
    return ways;
}

void fill_errors(Row& row, double flip, double motion) {
    row.frame.flip = flip * (1 + 0.06 * chance(row, 1));
    row.frame.psnr = flip == 0 ? std::numeric_limits<double>::infinity() : 48 - 10 * std::log10(flip / 0.002);
    row.frame.ssim = 1 - 1.6 * row.frame.flip;
    row.frame.brightness = 0.01 * chance(row, 2);
    row.crowd = row.frame;
    row.crowd.flip = std::min(1.0, 2.6 * row.frame.flip);
    row.crowd_share = 0.31;
    row.change = 20 * row.frame.flip * (1 + 0.3 * chance(row, 3));
    row.motion_px = motion * 0.4;
    row.motion_worst_px = motion * 3;
    row.outline_px = 6 * row.frame.flip;
    row.outline_worst_px = 60 * row.frame.flip;
}

void fill_times(Row& row, double ms) {
    row.wall_ms = ms * (1 + 0.04 * chance(row, 4));
    row.wall_low_ms = 0.97 * row.wall_ms;
    row.wall_high_ms = 1.05 * row.wall_ms;
    row.process_ms = 1.9 * row.wall_ms;
}

Row setting_row(std::int64_t people, const View& view, const Way& way) {
    Row row;
    row.people = people;
    row.view = view.name;
    row.is_preset = view.is_preset;
    row.family = way.family;
    row.setting = way.setting;
    row.density = way.density;
    row.samples = way.samples;
    row.decision.splat_size = way.splat_size;
    row.decision.rate = way.rate;
    row.covering_px = way.splat_size / 2;
    const double seen = static_cast<double>(people) * view.seen;
    row.work[WorkKind::person] = std::llround(seen);
    row.work[way.density > 0 ? WorkKind::point : WorkKind::triangle] = std::llround(300 * seen);
    row.work[WorkKind::motion_update] = std::llround(seen);
    row.work[WorkKind::pixel] = 921'600;
    fill_times(row, 2.5 + seen * way.us_a_person * (0.4 + 0.6 * view.near) / 1000 * 0.6);
    fill_errors(row, way.flip * (0.5 + 0.5 * view.near), way.motion);
    if (way.samples == 4) row.expected_flip = row.frame.flip * (1 + 0.2 * chance(row, 5));
    return row;
}

// As a law would: the last of the points that is fast enough, not always the right one.
Row mark_row(std::int64_t people, const View& view, std::string_view law, double target_ms) {
    const double slack = law == "predictive" ? 1 : law == "safeguarded" ? 0.93 : 0.8;
    Row chosen;
    for (const double s : {16.0, 8.0, 5.6, 4.0, 3.3, 2.4, 1.7, 1.2, 0.8}) {
        const Way way{"native mixture",
                      "D = 120, S = " + sfsm::number_text(s),
                      0.3 + 1.2 / std::pow(s, 1.3),
                      0.009 + 0.013 * std::pow(s, 0.8),
                      0.1,
                      s,
                      1.2,
                      4};
        const Row row = setting_row(people, view, way);
        if (!chosen.family.empty() && row.wall_ms > slack * target_ms) break;
        chosen = row;
    }
    chosen.law = law;
    chosen.target_ms = target_ms;
    return chosen;
}

std::string png(std::uint64_t seed, int block) {
    render::Image image{120, 80, std::vector<std::uint8_t>(3 * 120 * 80)};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto where = static_cast<std::uint64_t>(1000 * (y / block) + x / block);
            for (int k = 0; k < 3; ++k) {
                const auto value = sfsm::hash(seed + static_cast<std::uint64_t>(k), where / 3) % 6 * 25 + 60;
                image.pixels[static_cast<std::size_t>(3 * (y * image.width + x) + k)] =
                    static_cast<std::uint8_t>(value);
            }
        }
    }
    const std::vector<std::uint8_t> bytes = render::encode_png(image);
    return {bytes.begin(), bytes.end()};
}

}  // namespace

Front made_up_front() {
    Front front{{"A processor at 2.6 GHz", 2, "llvmpipe (LLVM 15.0.6, 256 bits)", "2026-11-26"}, {}};
    for (const std::int64_t people : {1'000, 20'000, 200'000, 1'000'000}) {
        for (const View& view : made_up_views()) {
            for (const Way& way : made_up_ways()) {
                const bool is_rare = way.family.find("density") != way.family.npos;
                if (!is_rare || view.is_preset) front.rows.push_back(setting_row(people, view, way));
            }
            if (!view.is_preset) continue;
            for (const std::string_view law : sfsm::law_names())
                for (const double target : made_up_targets) front.rows.push_back(mark_row(people, view, law, target));
            for (const double target : made_up_targets)
                front.rows.push_back(mark_row(people, view, law_before_rates, target));
        }
    }
    return front;
}

Crops made_up_crops(const Front& front) {
    constexpr std::int64_t people = 20'000;
    Crops crops;
    for (std::size_t i = 0; i < front.rows.size(); ++i) {
        const Row& row = front.rows[i];
        if (row.people != people || !row.is_preset) continue;
        crops.of_rows.push_back({i, png(1, 1 + static_cast<int>(row.decision.splat_size))});
        crops.references[{row.people, row.view}] = png(1, 1);
    }
    return crops;
}

}  // namespace bench::front
