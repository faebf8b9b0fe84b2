// What is measured, in order: crowd by crowd, view by view.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/front/row.h"
#include "tests/bench/front/settings.h"
#include "tests/bench/front/views.h"

namespace bench::front {

// Which part of the whole. Empty lists: everything.
struct Part {
    std::vector<std::int64_t> people{};
    std::vector<std::string> views{};
    std::vector<std::string> families{};  // "laws" for the marks
    bool with_opengl = true, with_marks = true;
};

inline constexpr std::int64_t crowds[] = {1'000, 20'000, 200'000, 1'000'000};
inline constexpr const char* marks_family = "laws";

// A row to be measured: of a setting, or of a law at a target.
struct Step {
    std::int64_t people = 0;
    std::string view;
    const Setting* setting = nullptr;
    std::string law;
    double target_ms = 0;
    std::optional<sfsm::Decision> recorded{};  // that the law made once; else it decides now

    bool is_of(const Row& row) const;
    double expected_s() const;  // roughly, on two cores: for the time that is left
};

// Crowds that `part` names need not be among `crowds`. Of a crowd's steps those of a view stand together.
std::vector<Step> plan(const Part& part);

// Throws std::invalid_argument if the part names a view or a family that isn't there.
void check(const Part& part);

}  // namespace bench::front
