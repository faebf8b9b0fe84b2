#include "tests/bench/front/plan.h"

#include <algorithm>
#include <stdexcept>

#include "apps/program.h"
#include "sfsm/controller.h"
#include "tests/bench/front/before_rates.h"
#include "tests/bench/front/marks.h"

namespace bench::front {

namespace {

template <typename Value>
bool is_in(const std::vector<Value>& list, const Value& value) {
    return list.empty() || std::ranges::find(list, value) != list.end();
}

struct NamedView {
    std::string name;
    bool is_preset;
};

// Names don't depend on the place that cameras are aimed at.
const std::vector<NamedView>& all_views() {
    static const std::vector<NamedView> views = [] {
        scene::Cameras any;
        for (scene::CameraPath* path : {&any.still, &any.close, &any.medium, &any.remote}) path->keys = {{}};
        any.roam.keys = {{}, {tour_seconds, {}}};
        std::vector<NamedView> names;
        for (const Shot& shot : shots(any, 1)) names.push_back({shot.name, shot.is_preset});
        return names;
    }();
    return views;
}

void add_settings(std::vector<Step>& steps, const Part& part, std::int64_t people, const NamedView& view) {
    for (const Setting& setting : settings()) {
        if (!is_in(part.families, setting.family)) continue;
        if (!part.with_opengl && setting.drawing == sfsm::Drawing::opengl) continue;
        if (is_measured(setting, people, view.name, view.is_preset))
            steps.push_back({people, view.name, &setting, "", 0});
    }
}

void add_marks(std::vector<Step>& steps, const Part& part, std::int64_t people, const NamedView& view) {
    const bool wanted = part.with_marks && is_in(part.families, std::string(marks_family)) && is_marked(people);
    if (!wanted) return;
    if (!view.is_preset) {
        for (const std::string_view law : {sfsm::law_names().front(), law_by_knobs})
            for (const double target : path_targets)
                steps.push_back({people, view.name, nullptr, std::string(law), target});
        return;
    }
    for (const std::string_view law : sfsm::law_names())
        for (const double target : mark_targets)
            steps.push_back({people, view.name, nullptr, std::string(law), target});
    for (const Recorded& one : choices_before_rates())
        if (one.people == people && one.view == view.name)
            steps.push_back({people, view.name, nullptr, std::string(law_before_rates), one.target_ms, one.decision});
}

template <typename Names>
void require(const std::string& option, const std::vector<std::string>& asked, const Names& known) {
    for (const std::string& name : asked) {
        if (std::ranges::find(known, name) != std::end(known)) continue;
        std::string list;
        for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
        throw apps::wrong_argument(option, "'" + name + "'", "one of: " + list);
    }
}

}  // namespace

bool Step::is_of(const Row& row) const {
    if (row.people != people || row.view != view || row.law != law || row.target_ms != target_ms) return false;
    return setting == nullptr || (row.family == setting->family && row.setting == setting->name);
}

// Measured on two cores.
double Step::expected_s() const {
    constexpr double pictures = 0.7, mark = 1.5, triangles_by_opengl = 15;
    const double crowd = static_cast<double>(people) / 1'000'000;
    double seconds = pictures + crowd;
    if (!setting && !recorded) seconds += mark;
    if (setting && setting->state != sfsm::State::points) seconds += 10 * crowd;
    if (setting && setting->drawing == sfsm::Drawing::opengl)
        seconds += setting->state == sfsm::State::original ? triangles_by_opengl : 5 * crowd;
    return seconds;
}

std::vector<Step> plan(const Part& part) {
    std::vector<std::int64_t> people = part.people;
    if (people.empty()) people.assign(std::begin(crowds), std::end(crowds));
    std::vector<Step> steps;
    for (auto count = people.begin(); count != people.end(); ++count) {
        if (std::find(people.begin(), count, *count) != count) continue;  // asked for twice
        for (const NamedView& view : all_views()) {
            if (!is_in(part.views, view.name)) continue;
            add_settings(steps, part, *count, view);
            add_marks(steps, part, *count, view);
        }
    }
    return steps;
}

void check(const Part& part) {
    std::vector<std::string> views, families{marks_family};
    for (const NamedView& view : all_views()) views.push_back(view.name);
    for (const Setting& setting : settings())
        if (std::ranges::find(families, setting.family) == families.end()) families.push_back(setting.family);
    require("--views", part.views, views);
    require("--only", part.families, families);
}

}  // namespace bench::front
