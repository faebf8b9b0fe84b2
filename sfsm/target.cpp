#include "sfsm/target.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "sfsm/number_text.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double longest_target_ms = 1e6;

[[noreturn]] void fail(std::string_view text, std::string_view found, const char* expected) {
    throw std::invalid_argument("target '" + std::string(text) + "': found '" + std::string(found) + "', expected " +
                                expected);
}

bool is_target(double ms) {
    return ms > 0 && ms <= longest_target_ms;
}

double parse_ms(std::string_view text, std::string_view part) {
    const std::optional<double> ms = parse_double(part);
    if (!ms || !is_target(*ms)) {
        fail(text, part, "a time in ms, over 0 and up to 1e6, as in 16.6 or 1000,300@30,95@100");
    }
    return *ms;
}

std::int64_t parse_frame(std::string_view text, std::string_view part, std::int64_t previous) {
    const std::optional<std::int64_t> frame = parse_integer(part);
    if (!frame || *frame <= previous)
        fail(text, part, "a frame over 0 and after the one before, as in 1000,300@30,95@100");
    return *frame;
}

}  // namespace

TargetSchedule TargetSchedule::parse(std::string_view text) {
    TargetSchedule schedule;
    std::string_view rest = text;
    for (bool more = true; more;) {
        const std::size_t comma = rest.find(',');
        const std::string_view part = rest.substr(0, comma);
        more = comma != std::string_view::npos;
        rest.remove_prefix(more ? comma + 1 : rest.size());

        const bool first = schedule.steps_.empty();
        const std::size_t at = part.find('@');
        if (first != (at == std::string_view::npos)) {
            fail(text, part, first ? "the first time without a frame, as in 1000,300@30" : "MS@FRAME, as in 300@30");
        }
        const std::int64_t frame = first ? 0 : parse_frame(text, part.substr(at + 1), schedule.steps_.back().frame);
        schedule.steps_.push_back({frame, parse_ms(text, part.substr(0, at))});
    }
    return schedule;
}

TargetSchedule TargetSchedule::of_frames(std::span<const double> ms) {
    if (ms.empty()) throw std::invalid_argument("found no targets, expected one for each frame");
    TargetSchedule schedule;
    for (std::size_t i = 0; i < ms.size(); ++i) {
        if (!is_target(ms[i])) {
            throw std::invalid_argument("frame " + std::to_string(i) + ": found target " + number_text(ms[i]) +
                                        " ms, expected one over 0 and up to 1e6");
        }
        if (i == 0 || ms[i] != ms[i - 1]) schedule.steps_.push_back({static_cast<std::int64_t>(i), ms[i]});
    }
    return schedule;
}

double TargetSchedule::at(std::int64_t frame) const {
    assert(!steps_.empty());
    const auto after = std::upper_bound(steps_.begin() + 1, steps_.end(), frame,
                                        [](std::int64_t value, const Step& step) { return value < step.frame; });
    return (after - 1)->ms;
}

std::string TargetSchedule::text() const {
    std::string text;
    for (const Step& step : steps_) {
        if (!text.empty()) text += ',';
        append_number(text, step.ms);
        if (step.frame == 0) continue;
        text += '@';
        append_number(text, step.frame);
    }
    return text;
}

}  // namespace sfsm
