#include "tests/bench/front/sentences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sfsm/controller.h"
#include "sfsm/report/markup.h"

namespace bench::front {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// With two figures: 0.00087, 0.31, 4.2, 17.
std::string two_figures(double value) {
    if (value == 0 || !std::isfinite(value)) return sfsm::report::figure(value, 0);
    constexpr int most_digits = 12;
    const int power = static_cast<int>(std::floor(std::log10(std::abs(value))));
    return sfsm::report::figure(value, std::clamp(1 - power, 0, most_digits));
}

std::string in_time(const Row& row, const ErrorKind& error) {
    return time_text(row.wall_ms) + " ms, " + error.told(error.value(row));
}

// What a millisecond between `a` and `b` gains; both are finite, b is better and slower.
std::string gain_a_millisecond(const Row& a, const Row& b, const ErrorKind& error) {
    const double gain = (error.loss(a) - error.loss(b)) / (b.wall_ms - a.wall_ms);
    const std::string unit = error.unit.empty() ? "" : " " + std::string(error.unit);
    const std::string name(error.name);
    if (error.more_is_better) return two_figures(gain) + unit + " more " + name;
    return two_figures(gain) + unit + " less " + name + ", " + two_figures(100 * gain / error.value(a)) + " % of it,";
}

// How much more error a mark has than the best: a ratio, or a difference where the error is in decibels. Of none and
// none: as if they were equal.
double excess(const Row& mark, const Row& best, const ErrorKind& error) {
    const double a = error.loss(mark), b = error.loss(best);
    if (a == b) return error.more_is_better ? 0 : 1;
    return error.more_is_better ? a - b : b > 0 ? a / b : infinity;
}

// What an error is like beside the front's, in bold, and how the front comes into it.
std::pair<std::string, std::string> excess_text(double loss, const ErrorKind& error) {
    const std::string name(error.name);
    if (std::isinf(loss)) return {"an error where none is needed", ""};
    if (error.more_is_better) return {two_figures(loss) + " dB less " + name, " than the front"};
    return {sfsm::report::figure(loss, loss < 10 ? 1 : 0) + " times the " + name, " of the front"};
}

Sentence loss_sentence(const Scene& scene, const Row& mark, const Row& best, const ErrorKind& error) {
    const auto [key, front] = excess_text(excess(mark, best, error), error);
    const auto has = [&](const Row& row) {
        return error.figure(error.value(row)) + " in " + time_text(row.wall_ms) + " ms";
    };
    return {"With " + scene.name() + ", at a target of " + target_text(mark.target_ms) + " ms, " + mark.law + " has ",
            key, front + ": " + has(mark) + "; " + setting_text(best) + " has " + has(best) + "."};
}

// The worst so far, and out of how many.
struct Search {
    Loss worst;
    double most = -infinity;
    int marks = 0, compared = 0;
};

void search_scene(Search& search, const std::vector<Scene>& scenes, std::size_t index, const ErrorKind& error) {
    const Scene& scene = scenes[index];
    const std::vector<std::size_t> front = front_of(scene.rows, error);
    for (std::size_t i = 0; i < scene.rows.size(); ++i) {
        const Row& mark = scene.rows[i];
        if (mark.law != sfsm::law_names().front()) continue;
        ++search.marks;
        const std::optional<std::size_t> best = best_within(scene, front, mark.wall_ms);
        if (!best || std::isnan(error.loss(mark))) continue;
        ++search.compared;
        const double loss = excess(mark, scene.rows[*best], error);
        if (loss <= search.most) continue;
        search.most = loss;
        search.worst = {loss_sentence(scene, mark, scene.rows[*best], error), index, i};
    }
}

}  // namespace

std::optional<std::size_t> best_within(const Scene& scene, const std::vector<std::size_t>& front, double ms) {
    std::optional<std::size_t> best;
    for (const std::size_t i : front)
        if (scene.rows[i].wall_ms <= ms) best = i;
    return best;
}

Sentence what_to_draw(const Scene& scene, const ErrorKind& error) {
    const std::vector<std::size_t> front = front_of(scene.rows, error);
    if (front.empty()) return {"Not known: of " + scene.name() + ", no setting was measured.", "", ""};
    const std::optional<std::size_t> best = best_within(scene, front, frame_ms);
    const Row& row = scene.rows[best.value_or(front.front())];
    const std::string cost = ": " + in_time(row, error) + ".";
    if (best) return {"For " + scene.name() + ", ", setting_text(row), cost};
    return {"Of " + scene.name() + ", ", "nothing is so fast", "; " + setting_text(row) + " comes nearest" + cost};
}

Sentence what_a_millisecond_buys(const Scene& scene, const ErrorKind& error) {
    const std::vector<std::size_t> front = front_of(scene.rows, error);
    if (front.empty()) return {"Not known: no setting was measured.", "", ""};
    const Row& from = scene.rows[best_within(scene, front, frame_ms).value_or(front.front())];
    std::vector<std::size_t> later;
    for (const std::size_t i : front)
        if (scene.rows[i].wall_ms > from.wall_ms) later.push_back(i);
    if (later.empty())
        return {"", "Nothing", ": no setting has a better " + std::string(error.name) + ", however slow."};
    const Row& next = scene.rows[later.front()];
    const std::string next_step = setting_text(next) + ": " + in_time(next, error) + ".";
    const double horizon = 2 * std::max(frame_ms, from.wall_ms);
    if (next.wall_ms > horizon) return {"", "Nothing yet", ". The next better setting is " + next_step};
    const Row* to = nullptr;
    for (const std::size_t i : later)
        if (scene.rows[i].wall_ms <= horizon && std::isfinite(error.loss(scene.rows[i]))) to = &scene.rows[i];
    if (to == nullptr) return {"", "The exact picture", ", by " + next_step};
    return {"", gain_a_millisecond(from, *to, error),
            " on the way from " + time_text(from.wall_ms) + " to " + time_text(to->wall_ms) + " ms. The next step is " +
                next_step};
}

Loss where_the_law_loses(const std::vector<Scene>& scenes, const ErrorKind& error) {
    Search search;
    for (std::size_t i = 0; i < scenes.size(); ++i) search_scene(search, scenes, i, error);
    const std::string law(sfsm::law_names().front());
    constexpr double nothing = 0.05;  // wouldn't show
    const double none = error.more_is_better ? 0 : 1;
    if (search.marks == 0) return {{"Not known: what " + law + " chooses was not measured.", "", ""}, {}, {}};
    if (search.compared == 0) return {{"Not known: no setting was as fast as what " + law + " chose.", "", ""}, {}, {}};
    if (search.most >= none + nothing) return search.worst;
    return {{"", "Nowhere",
             ": all " + std::to_string(search.compared) + " choices of " + law + " are on the front or beyond."},
            {},
            {}};
}

}  // namespace bench::front
