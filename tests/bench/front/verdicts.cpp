#include "tests/bench/front/verdicts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string_view>

#include "sfsm/controller.h"
#include "sfsm/report/markup.h"
#include "tests/bench/front/before_rates.h"
#include "tests/bench/times.h"

namespace bench::front {
namespace {

constexpr std::string_view rates_family = "native rates", rival_start = "rival: ";

const ErrorKind& flip() {
    return error_kinds().front();
}

// What the paper gives everybody alike, then all rivals that rows name.
std::vector<Contender> rivals_in(const std::vector<Scene>& scenes) {
    std::vector<Contender> rivals{{"one D and S for all", {"native points", "native mixture"}}};
    for (const Scene& scene : scenes)
        for (const Row& row : scene.rows) {
            const bool is_known =
                std::ranges::find(rivals, std::vector{row.family}, &Contender::families) != rivals.end();
            if (row.family.starts_with(rival_start) && !is_known)
                rivals.push_back({row.family.substr(rival_start.size()), {row.family}});
        }
    return rivals;
}

bool is_finite(const Row& row) {
    return std::isfinite(row.frame.flip) && std::isfinite(row.wall_ms) && row.wall_ms > 0;
}

bool is_native(const Row& row) {
    return !row.family.starts_with("OpenGL");
}

// The row with the least FLIP of all that are drawn natively; of several the fastest. Never null of a scene that has a
// finite row of these.
const Row* finest_of(const Scene& scene) {
    const Row* finest = nullptr;
    const auto rank = [](const Row& row) { return std::pair(row.frame.flip, row.wall_ms); };
    for (const Row& row : scene.rows)
        if (is_finite(row) && is_native(row) && (!finest || rank(row) < rank(*finest))) finest = &row;
    return finest;
}

const Row* before_rates(const Scene& scene, double target_ms) {
    const auto found = std::ranges::find_if(
        scene.rows, [&](const Row& row) { return row.law == law_before_rates && row.target_ms == target_ms; });
    return found == scene.rows.end() ? nullptr : &*found;
}

// Nothing of nothing is as good.
double ratio(double a, double b) {
    if (a == b) return 1;
    return b > 0 ? a / b : std::numeric_limits<double>::infinity();
}

std::optional<double> ratio(double a, std::optional<double> b) {
    return b ? std::optional(ratio(a, *b)) : std::nullopt;
}

Case case_of(const Scene& scene, const Row& mark, const Row& finest, const std::vector<Contender>& rivals) {
    Case one{scene.people, scene.view, mark.target_ms, mark.wall_ms, mark.frame.flip, {}, false, {}, {}};
    one.over_rates = ratio(one.flip, least_flip(scene.rows, {std::string(rates_family)}, one.ms));
    one.finest_fits = finest.wall_ms <= mark.target_ms;
    for (const Contender& rival : rivals) {
        const auto its = least_flip(scene.rows, rival.families, one.ms);
        const bool is_asked = its && !one.finest_fits;
        one.over_rivals.push_back(
            is_asked ? std::optional(ratio(one.flip - finest.frame.flip, *its - finest.frame.flip)) : std::nullopt);
    }
    if (const Row* before = before_rates(scene, mark.target_ms)) {
        // Both in the same time: along what rates have.
        const auto then = least_flip(scene.rows, {std::string(rates_family)}, before->wall_ms);
        const auto now = least_flip(scene.rows, {std::string(rates_family)}, one.ms);
        one.over_before = ratio(one.flip, before->frame.flip) * (then && now ? *then / *now : 1);
    }
    return one;
}

std::string row_name(const Scene& scene, const Row& row) {
    const std::string of = scene.name() + ", ";
    return row.is_mark() ? of + row.law + " at " + target_text(row.target_ms) + " ms" : of + setting_text(row);
}

Expectation expectation_of(const std::vector<Scene>& scenes) {
    Expectation found;
    std::vector<double> expected, measured;
    for (const Scene& scene : scenes)
        for (const Row& row : scene.rows) {
            const bool is_asked = row.is_mark() || row.family == rates_family;
            if (!is_asked || !(row.expected_flip > 0) || !(row.frame.flip > 0)) continue;
            expected.push_back(row.expected_flip);
            measured.push_back(row.frame.flip);
            const double off = std::abs(row.expected_flip / row.frame.flip - 1);
            if (off < found.worst) continue;
            found.worst = off;
            found.worst_of = row_name(scene, row);
        }
    found.rows = expected.size();
    found.rank_correlation = rank_correlation(expected, measured);
    return found;
}

Flicker flicker_of(const std::vector<Scene>& scenes) {
    Flicker all;
    for (const Scene& scene : scenes) {
        if (scene.is_preset) continue;
        for (const Row& row : scene.rows) {
            if (row.law != sfsm::law_names().front()) continue;
            const auto other = std::ranges::find_if(
                scene.rows, [&](const Row& one) { return one.law == law_by_knobs && one.target_ms == row.target_ms; });
            if (other == scene.rows.end()) continue;
            all.by_rates += row.change;
            all.by_knobs += other->change;
            ++all.pairs;
        }
    }
    return all;
}

// From 0; equal values have the mean of theirs.
std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> ranks(values.size());
    for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
        for (end = begin; end < order.size() && values[order[end]] == values[order[begin]];) ++end;
        for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
    }
    return ranks;
}

// `asked`: whether a case might have had a ratio.
Summary summary_of(std::string what, const std::vector<Case>& cases,
                   const std::function<std::optional<double>(const Case&)>& ratio_of,
                   const std::function<bool(const Case&)>& asked) {
    Summary summary{.what = std::move(what), .worst_of = {}};
    std::vector<double> ratios;
    for (const Case& one : cases) {
        if (!asked(one)) continue;
        ++summary.of;
        const std::optional<double> found = ratio_of(one);
        if (!found) continue;
        if (ratios.empty() || *found > summary.worst) {
            summary.worst = *found;
            summary.worst_of = one.name();
        }
        ratios.push_back(*found);
    }
    summary.cases = ratios.size();
    if (!ratios.empty()) summary.median = median(std::move(ratios));
    return summary;
}

}  // namespace

std::string Case::name() const {
    return Scene{people, view, true, {}, {}}.name() + ", " + target_text(target_ms) + " ms";
}

std::optional<double> least_flip(const std::vector<Row>& rows, const std::vector<std::string>& families, double ms) {
    std::vector<Row> theirs;
    std::ranges::copy_if(rows, std::back_inserter(theirs), [&](const Row& row) {
        return std::ranges::find(families, row.family) != families.end() && is_finite(row);
    });
    const std::vector<std::size_t> front = front_of(theirs, flip());
    const Row* before = nullptr;
    for (const std::size_t i : front) {
        const Row& row = theirs[i];
        if (row.wall_ms <= ms)
            before = &row;
        else if (before) {
            const double share = std::log(ms / before->wall_ms) / std::log(row.wall_ms / before->wall_ms);
            return std::lerp(before->frame.flip, row.frame.flip, share);
        }
        if (!before) return {};
    }
    return before ? std::optional(before->frame.flip) : std::nullopt;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> ranks_a = ranks_of(a), ranks_b = ranks_of(b);
    const double middle = 0.5 * (static_cast<double>(a.size()) - 1);
    double both = 0, of_a = 0, of_b = 0;
    for (std::size_t i = 0; i < ranks_a.size(); ++i) {
        const double x = ranks_a[i] - middle, y = ranks_b[i] - middle;
        both += x * y;
        of_a += x * x;
        of_b += y * y;
    }
    return of_a > 0 && of_b > 0 ? both / std::sqrt(of_a * of_b) : 0;
}

Verdicts verdicts_of(const std::vector<Scene>& scenes) {
    Verdicts verdicts{rivals_in(scenes), {}, expectation_of(scenes), flicker_of(scenes)};
    for (const Scene& scene : scenes) {
        if (!scene.is_preset) continue;
        const Row* finest = finest_of(scene);
        for (const Row& row : scene.rows)
            if (row.law == sfsm::law_names().front() && is_finite(row))
                verdicts.cases.push_back(case_of(scene, row, *finest, verdicts.rivals));
    }
    return verdicts;
}

std::vector<Summary> summaries(const Verdicts& verdicts) {
    const auto always = [](const Case&) { return true; };
    const auto is_short = [](const Case& one) { return !one.finest_fits; };
    std::vector<Summary> all;
    all.push_back(summary_of(
        "FLIP over the least of any rate in its time", verdicts.cases, [](const Case& one) { return one.over_rates; },
        always));
    for (std::size_t i = 0; i < verdicts.rivals.size(); ++i)
        all.push_back(summary_of(
            "FLIP beyond the finest, over that in its time of: " + verdicts.rivals[i].name, verdicts.cases,
            [i](const Case& one) { return one.over_rivals[i]; }, is_short));
    all.push_back(summary_of(
        "FLIP over that before rates in its time", verdicts.cases, [](const Case& one) { return one.over_before; },
        always));
    return all;
}

std::string verdicts_text(const Verdicts& verdicts) {
    using sfsm::report::figure;
    constexpr int digits = 3;
    std::string out;
    for (const Summary& summary : summaries(verdicts)) {
        out += summary.what + ": " + std::to_string(summary.cases) + " of " + std::to_string(summary.of) + " choices";
        if (summary.cases > 0)
            out += ", median " + figure(summary.median, digits) + ", worst " + figure(summary.worst, digits) + " (" +
                   summary.worst_of + ")";
        out += '\n';
    }
    const Expectation& expectation = verdicts.expectation;
    out += "FLIP as expected and as measured: " + std::to_string(expectation.rows) + " rows";
    if (expectation.rows > 0)
        out += ", rank correlation " + figure(expectation.rank_correlation, digits) + ", off by " +
               figure(100 * expectation.worst, 0) + " % at worst (" + expectation.worst_of + ")";
    const Flicker& flicker = verdicts.flicker;
    if (flicker.pairs > 0)
        out += "\nChange from frame to frame along the path, over that by D and S: " +
               figure(flicker.by_rates / flicker.by_knobs, digits) + " (" + std::to_string(flicker.pairs) +
               " choices each)";
    return out + '\n';
}

}  // namespace bench::front
