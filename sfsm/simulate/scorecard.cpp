#include "sfsm/simulate/scorecard.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "sfsm/simulate/oracle.h"

namespace sfsm::simulate {
namespace {

constexpr int threads = 2;
constexpr int timed_runs = 10;
// Of the search for the factor: fewer seeds than the row has, or most of the time would go into it.
constexpr int search_seeds = 15;
constexpr int bisections = 11;
constexpr double least_factor = 0.4, most_factor = 2.5;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    const double upper = *middle, lower = *std::max_element(values.begin(), middle);
    return lower == upper ? upper : lower + (upper - lower) / 2;  // infinities have no difference
}

double median_of(std::span<const Metrics> runs, double Metrics::*figure) {
    std::vector<double> values;
    for (const Metrics& run : runs) values.push_back(run.*figure);
    return median(std::move(values));
}

std::optional<double> median_of(std::span<const Metrics> runs, std::optional<double> Metrics::*figure) {
    std::vector<double> values;
    for (const Metrics& run : runs) values.push_back((run.*figure).value_or(std::numeric_limits<double>::infinity()));
    const double middle = median(std::move(values));
    return std::isfinite(middle) ? std::optional(middle) : std::nullopt;
}

constexpr double Metrics::*shares[] = {
    &Metrics::judged_ms,        &Metrics::over_target,        &Metrics::over_5pct,
    &Metrics::within_5pct,      &Metrics::within_10pct,       &Metrics::control_rate,
    &Metrics::worst_second,     &Metrics::hitch_ms_per_s,     &Metrics::quality,
    &Metrics::overshoot_pct,    &Metrics::reversals_per_1000, &Metrics::variation_per_1000,
    &Metrics::changes_per_1000, &Metrics::is_stuck,           &Metrics::mean_ms,
    &Metrics::largest_step,     &Metrics::first_over,         &Metrics::first_coarse};
constexpr double Metrics::*to_be_large[] = {&Metrics::judged_ms, &Metrics::within_5pct, &Metrics::within_10pct,
                                            &Metrics::control_rate, &Metrics::quality};
constexpr std::optional<double> Metrics::*times[] = {&Metrics::settle_down,      &Metrics::settle_up,
                                                     &Metrics::cost_settle_down, &Metrics::cost_settle_up,
                                                     &Metrics::recovery,         &Metrics::regain};

Metrics median_of(std::span<const Metrics> runs) {
    Metrics middle;
    for (const auto figure : shares) middle.*figure = median_of(runs, figure);
    for (const auto figure : times) middle.*figure = median_of(runs, figure);
    return middle;
}

// A missing figure is worse than any number.
Metrics worst_of(std::span<const Metrics> runs) {
    Metrics worst = runs.front();
    for (const Metrics& run : runs.subspan(1)) {
        for (const auto figure : shares) {
            const bool is_large = std::ranges::find(to_be_large, figure) != std::end(to_be_large);
            worst.*figure = is_large ? std::min(worst.*figure, run.*figure) : std::max(worst.*figure, run.*figure);
        }
        for (const auto figure : times)
            worst.*figure = worst.*figure && run.*figure ? std::max(worst.*figure, run.*figure) : std::nullopt;
    }
    return worst;
}

std::vector<Metrics> run_seeds(const Course& course, const Contestant& law, double factor, int seeds) {
    std::vector<Metrics> runs;
    std::vector<Outcome> outcomes;
    for (int seed = 1; seed <= seeds; ++seed) {
        const std::unique_ptr<Controller> fresh = law.make(course);
        run(course, *fresh, {static_cast<std::uint64_t>(seed), factor, {}}, outcomes);
        runs.push_back(measure(course, outcomes));
    }
    return runs;
}

double misses(const Course& course, const Contestant& law, double factor, int seeds) {
    return median_of(run_seeds(course, law, factor, seeds), &Metrics::over_5pct);
}

struct Factor {
    double value = 1;
    bool is_equal = true;  // as often as asked, or as often as a step of the search allows
};

// The largest share of the target at which the law misses no more often than asked.
Factor equal_miss_factor(const Course& course, const Contestant& law, double asked, int seeds) {
    double low = std::log(least_factor), high = std::log(most_factor);
    const double least = low, most = high;
    for (int i = 0; i < bisections; ++i) {
        const double middle = (low + high) / 2;
        (misses(course, law, std::exp(middle), seeds) <= asked ? low : high) = middle;
    }
    return {std::exp(low), low > least && high < most};
}

// Of the fastest run: what else the machine does can only slow a run down.
double time_law(const Course& course, const Contestant& law, const std::function<double()>& now_us) {
    if (!now_us) return 0;
    double fastest = std::numeric_limits<double>::infinity();
    std::vector<Outcome> outcomes;
    for (int i = 0; i < timed_runs; ++i) {
        const std::unique_ptr<Controller> fresh = law.make(course);
        fastest = std::min(fastest, run(course, *fresh, {1, 1, now_us}, outcomes));
    }
    return fastest;
}

bool has_step(const Scenario& scenario, bool is_down) {
    return std::any_of(scenario.steps.begin(), scenario.steps.end(),
                       [=](const LoadStep& step) { return step.is_down == is_down; });
}

// What the rows of a scenario share.
struct Arena {
    Course course;
    double oracle_over_5pct = 0;
    double asked_over_5pct = 0;  // the reference's, of the seeds that the search goes through
    bool is_judged = true;       // some frames are; else nothing can be missed
};

int seeds_to_search(const ScorecardOptions& options) {
    return std::min(options.seeds, search_seeds);
}

Arena make_arena(const Scenario& scenario, const ScorecardOptions& options) {
    Arena arena;
    arena.course = make_course(scenario);
    const Contestant oracle{"", [](const Course& course) { return std::make_unique<Oracle>(course); }};
    const Metrics known = median_of(run_seeds(arena.course, oracle, 1, options.seeds));
    arena.oracle_over_5pct = known.over_5pct;
    arena.is_judged = known.judged_ms > 0;
    arena.asked_over_5pct = misses(arena.course, options.reference, 1, seeds_to_search(options));
    return arena;
}

Row make_row(const Arena& arena, const Contestant& law, Tuning tuning, double factor, int seeds) {
    const Scenario& scenario = arena.course.scenario;
    const std::vector<Metrics> runs = run_seeds(arena.course, law, factor, seeds);
    Row row;
    row.scenario = scenario.name;
    row.law = law.name;
    row.tuning = tuning;
    row.target_factor = factor;
    row.median = median_of(runs);
    row.worst = worst_of(runs);
    row.least_mean_ms = runs.front().mean_ms;
    for (const Metrics& run : runs) {
        row.stuck_seeds += run.is_stuck > 0 ? 1 : 0;
        row.least_mean_ms = std::min(row.least_mean_ms, run.mean_ms);
    }
    row.oracle_over_5pct = arena.oracle_over_5pct;
    row.has_step_down = has_step(scenario, true);
    row.has_step_up = has_step(scenario, false);
    row.has_interruption = !scenario.interruptions.empty();
    row.has_regain = !scenario.regained.empty();
    return row;
}

std::vector<Row> rows_of(const Arena& arena, const Contestant& law, const ScorecardOptions& options) {
    std::vector<Row> rows = {make_row(arena, law, Tuning::own, 1, options.seeds)};
    rows.front().us_per_frame = time_law(arena.course, law, options.now_us);
    if (!law.is_retuned) return rows;
    Factor factor;
    if (law.name != options.reference.name && arena.is_judged)
        factor = equal_miss_factor(arena.course, law, arena.asked_over_5pct, seeds_to_search(options));
    rows.push_back(make_row(arena, law, Tuning::equal_miss, factor.value, options.seeds));
    rows.back().is_equal = factor.is_equal;
    rows.back().us_per_frame = rows.front().us_per_frame;
    return rows;
}

// Calls job(0) ... job(jobs - 1), each once, from several threads. Throws what a job throws.
void in_parallel(std::size_t jobs, const std::function<void(std::size_t)>& job) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::future<void>> workers;
    for (int i = 0; i < threads; ++i) {
        workers.push_back(std::async(std::launch::async, [&] {
            for (std::size_t index = next++; index < jobs; index = next++) job(index);
        }));
    }
    for (std::future<void>& worker : workers) worker.get();
}

}  // namespace

const char* tuning_name(Tuning tuning) {
    return tuning == Tuning::own ? "own" : "equal-miss";
}

std::vector<Row> scorecard(const ScorecardOptions& options) {
    std::vector<Arena> arenas(options.scenarios.size());
    in_parallel(arenas.size(), [&](std::size_t i) { arenas[i] = make_arena(options.scenarios[i], options); });

    const std::size_t laws = options.laws.size(), jobs = arenas.size() * laws;
    std::vector<std::vector<Row>> found(jobs);
    std::mutex mutex;
    std::size_t done = 0;
    in_parallel(jobs, [&](std::size_t i) {
        found[i] = rows_of(arenas[i / laws], options.laws[i % laws], options);
        const std::lock_guard lock(mutex);
        ++done;
        if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(jobs));
    });

    std::vector<Row> rows;
    for (std::vector<Row>& some : found) {
        std::move(some.begin(), some.end(), std::back_inserter(rows));
    }
    return rows;
}

}  // namespace sfsm::simulate
