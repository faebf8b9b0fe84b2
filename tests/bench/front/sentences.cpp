#include "tests/bench/front/sentences.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sfsm/controller.h"
#include "sfsm/report/markup.h"

namespace bench::front {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// With two figures: 0.00087, 0.31, 4.2, 17.
std::string two_figures(double value) {
    if (value == 0 || !std::isfinite(value)) return sfsm::report::figure(value, 0);
    const int power = static_cast<int>(std::floor(std::log10(std::abs(value))));
    return sfsm::report::figure(value, std::max(0, 1 - power));
}

std::string told(const Row& row, const ErrorKind& error) {
    return error.told(error.value(row));
}

// How far `b` is better than `a`, in words; both finite, b is better and slower.
std::string gain_a_millisecond(const Row& a, const Row& b, const ErrorKind& error) {
    const double gain = (error.loss(a) - error.loss(b)) / (b.wall_ms - a.wall_ms);
    const std::string unit = error.unit.empty() ? "" : " " + std::string(error.unit);
    const std::string name(error.name);
    if (error.more_is_better) return "adds " + two_figures(gain) + unit + " to " + name;
    return "takes " + two_figures(gain) + unit + " off " + name + ", " + two_figures(100 * gain / error.value(a)) +
           " % of it";
}

std::string next_step(const Row& row, const ErrorKind& error) {
    return setting_text(row) + ", at " + time_text(row.wall_ms) + " ms (" + told(row, error) + ")";
}

// The mark's error for the front's: a ratio, or a difference where the error is in decibels. 0 / 0 is no loss.
double excess(const Row& mark, const Row& best, const ErrorKind& error) {
    const double a = error.loss(mark), b = error.loss(best);
    if (a == b) return error.more_is_better ? 0 : 1;
    return error.more_is_better ? a - b : b > 0 ? a / b : infinity;
}

std::string loss_sentence(const Scene& scene, const Row& mark, const Row& best, const ErrorKind& error) {
    const double loss = excess(mark, best, error);
    const std::string how = error.more_is_better ? two_figures(loss) + " dB less than "
                            : std::isinf(loss)   ? "without need: "
                                                 : sfsm::report::figure(loss, loss < 10 ? 2 : 0) + " times that of ";
    const std::string front =
        setting_text(best) + " (" + error.figure(error.value(best)) + " in " + time_text(best.wall_ms) + " ms)";
    return "The law of today, " + mark.law + ", loses most with " + scene.name() + ", at a target of " +
           time_text(mark.target_ms) + " ms: " + told(mark, error) + " in " + time_text(mark.wall_ms) + " ms, " + how +
           front + (std::isinf(loss) ? " is exact." : ".");
}

}  // namespace

std::optional<std::size_t> best_within(const Scene& scene, const std::vector<std::size_t>& front, double ms) {
    std::optional<std::size_t> best;
    for (const std::size_t i : front)
        if (scene.rows[i].wall_ms <= ms) best = i;
    return best;
}

std::string what_to_draw(const Scene& scene, const ErrorKind& error) {
    const std::vector<std::size_t> front = front_of(scene.rows, error);
    if (front.empty()) return "Of " + scene.name() + ", no setting was measured.";
    const std::optional<std::size_t> best = best_within(scene, front, frame_ms);
    const Row& row = scene.rows[best.value_or(front.front())];
    const std::string cost = time_text(row.wall_ms) + " ms at " + told(row, error) + ".";
    if (best) return "For " + scene.name() + ": " + setting_text(row) + ". It takes " + cost;
    return "Nothing draws " + scene.name() + ", in " + time_text(frame_ms) + " ms. The fastest is " +
           setting_text(row) + ": " + cost;
}

std::string what_a_millisecond_buys(const Scene& scene, const ErrorKind& error) {
    const std::vector<std::size_t> front = front_of(scene.rows, error);
    if (front.empty()) return "Not known: no setting was measured.";
    const std::size_t start = best_within(scene, front, frame_ms).value_or(front.front());
    const Row& from = scene.rows[start];
    std::vector<std::size_t> later;
    for (const std::size_t i : front)
        if (scene.rows[i].wall_ms > from.wall_ms) later.push_back(i);
    if (later.empty())
        return "More time buys nothing: of all settings this has the best " + std::string(error.name) + ".";
    const Row& next = scene.rows[later.front()];
    const double horizon = 2 * std::max(frame_ms, from.wall_ms);
    if (next.wall_ms > horizon) return "Nothing yet: the next better setting is " + next_step(next, error) + ".";
    const Row* to = nullptr;
    for (const std::size_t i : later)
        if (scene.rows[i].wall_ms <= horizon && std::isfinite(error.loss(scene.rows[i]))) to = &scene.rows[i];
    if (to == nullptr) return "The exact picture: " + next_step(next, error) + ".";
    return "From " + time_text(from.wall_ms) + " to " + time_text(to->wall_ms) + " ms each further millisecond " +
           gain_a_millisecond(from, *to, error) + ". The next step is " + next_step(next, error) + ".";
}

Loss where_the_law_loses(const std::vector<Scene>& scenes, const ErrorKind& error) {
    const std::string_view law = sfsm::law_names().front();
    Loss worst;
    int marks = 0, compared = 0;
    double most = -infinity;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
        const Scene& scene = scenes[s];
        const std::vector<std::size_t> front = front_of(scene.rows, error);
        for (std::size_t i = 0; i < scene.rows.size(); ++i) {
            const Row& mark = scene.rows[i];
            if (mark.law != law) continue;
            ++marks;
            const std::optional<std::size_t> best = best_within(scene, front, mark.wall_ms);
            if (!best || std::isnan(error.loss(mark))) continue;
            ++compared;
            const double loss = excess(mark, scene.rows[*best], error);
            if (loss <= most) continue;
            most = loss;
            worst = {loss_sentence(scene, mark, scene.rows[*best], error), s, i};
        }
    }
    constexpr double nothing = 0.005;  // wouldn't show
    const double none = error.more_is_better ? 0 : 1;
    if (marks == 0) return {"What the law of today, " + std::string(law) + ", chooses was not measured.", {}, {}};
    if (compared == 0) return {"Not known: no setting was as fast as what the law of today chose.", {}, {}};
    if (most < none + nothing) {
        return {"Nowhere: each of the " + std::to_string(compared) + " choices of the law of today, " +
                    std::string(law) + ", is on the front or beyond.",
                {},
                {}};
    }
    return worst;
}

}  // namespace bench::front
