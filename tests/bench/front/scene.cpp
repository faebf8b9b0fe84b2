#include "tests/bench/front/scene.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "sfsm/report/markup.h"

namespace bench::front {
namespace {

constexpr std::int64_t first_crowd = 20'000;

bool takes_part(const Row& row, const ErrorKind& error) {
    return !row.is_mark() && std::isfinite(row.wall_ms) && row.wall_ms > 0 && !std::isnan(error.loss(row));
}

bool comes_before(const Scene& a, const Scene& b) {
    const auto rank = [](const Scene& scene) {
        return std::tuple(scene.people != first_crowd, scene.people, !scene.is_preset);
    };
    return rank(a) < rank(b);
}

}  // namespace

std::string Scene::name() const {
    return count_text(people) + (people == 1 ? " person, " : " people, ") + view;
}

std::vector<Scene> scenes_of(const Front& front) {
    std::vector<Scene> scenes;
    for (std::size_t i = 0; i < front.rows.size(); ++i) {
        const Row& row = front.rows[i];
        const auto is_here = [&](const Scene& scene) { return scene.people == row.people && scene.view == row.view; };
        auto scene = std::find_if(scenes.begin(), scenes.end(), is_here);
        if (scene == scenes.end()) scene = scenes.insert(scene, {row.people, row.view, row.is_preset, {}, {}});
        scene->rows.push_back(row);
        scene->places.push_back(i);
    }
    std::stable_sort(scenes.begin(), scenes.end(), comes_before);
    return scenes;
}

std::vector<std::size_t> front_of(std::span<const Row> rows, const ErrorKind& error) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (takes_part(rows[i], error)) order.push_back(i);
    const auto rank = [&](std::size_t i) { return std::pair(rows[i].wall_ms, error.loss(rows[i])); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        const bool is_better = front.empty() || error.loss(rows[i]) < error.loss(rows[front.back()]);
        if (is_better || rank(i) == rank(front.back())) front.push_back(i);
    }
    return front;
}

std::string count_text(std::int64_t count) {
    std::string text = std::to_string(count);
    const std::ptrdiff_t digits_begin = count < 0 ? 1 : 0;
    for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > digits_begin; at -= 3)
        text.insert(static_cast<std::size_t>(at), ",");
    return text;
}

std::string time_text(double ms) {
    if (ms >= 1000 && ms < 1e7) return count_text(std::llround(ms));
    return sfsm::report::figure(ms, ms < 10 ? 2 : ms < 100 ? 1 : 0);
}

std::string target_text(double ms) {
    return sfsm::report::pixels(ms);
}

std::string setting_text(const Row& row) {
    std::string setting = row.setting;
    const std::string equals = "\u00A0=\u00A0";
    for (std::size_t at = 0; (at = setting.find(" = ", at)) != setting.npos; at += equals.size())
        setting.replace(at, 3, equals);
    return setting.empty() ? row.family : row.family + ", " + setting;
}

}  // namespace bench::front
