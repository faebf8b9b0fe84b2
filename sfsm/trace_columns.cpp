#include "sfsm/trace_columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "sfsm/number_text.h"
#include "sfsm/same_bits.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

std::string is_not(std::string_view field, const char* expected) {
    return "is " + shown(field) + ", expected " + expected;
}

// --- How a field is written and read.

struct Count {
    static void write(std::string& line, std::int64_t count) { append_number(line, count); }
    static std::string read(std::string_view field, std::int64_t& count) {
        const std::optional<std::int64_t> value = parse_integer(field);
        if (!value || *value < 0) return is_not(field, "a whole number from 0");
        count = *value;
        return {};
    }
};

struct Number {
    static void write(std::string& line, double number) { append_number(line, number); }
    static std::string read(std::string_view field, double& number) {
        const std::optional<double> value = parse_double(field);
        if (!value) return is_not(field, "a number");
        number = *value;
        return {};
    }
};

// A number that may not have been measured: NaN, also read from an empty field.
struct MaybeNumber : Number {
    static std::string read(std::string_view field, double& number) {
        if (!field.empty()) return Number::read(field, number);
        number = std::numeric_limits<double>::quiet_NaN();
        return {};
    }
};

struct StateDigit {
    static void write(std::string& line, State state) { append_number(line, std::int64_t{static_cast<int>(state)}); }
    static std::string read(std::string_view field, State& state) {
        if (field != "0" && field != "1" && field != "2") return is_not(field, "0, 1 or 2");
        state = static_cast<State>(field[0] - '0');
        return {};
    }
};

// A state that nobody may have said: an empty field.
struct MaybeState {
    static void write(std::string& line, std::optional<State> state) {
        if (state) StateDigit::write(line, *state);
    }
    static std::string read(std::string_view field, std::optional<State>& state) {
        return field.empty() ? std::string() : StateDigit::read(field, state.emplace());
    }
};

struct Distance : Number {
    static std::string read(std::string_view field, double& metres) {
        std::string wrong = Number::read(field, metres);
        if (wrong.empty() && !(metres > 0)) return is_not(field, "metres over 0, or inf");
        return wrong;
    }
};

struct SplatSize : Number {
    static_assert(max_splat_size == 32, "the message says so");
    static std::string read(std::string_view field, double& pixels) {
        std::string wrong = Number::read(field, pixels);
        if (wrong.empty() && !(pixels >= 0 && pixels <= max_splat_size)) return is_not(field, "pixels in [0, 32]");
        return wrong;
    }
};

struct Rate : Number {
    static std::string read(std::string_view field, double& rate) {
        std::string wrong = Number::read(field, rate);
        if (wrong.empty() && !(rate >= 0 && std::isfinite(rate))) return is_not(field, "pixels a piece from 0");
        return wrong;
    }
};

// --- Kinds of work.

// Every trace has these; kinds that came later may be missing.
constexpr std::size_t first_kinds = index_of(WorkKind::motion_update) + 1;

template <WorkAxis axis>
constexpr std::size_t first_kinds_on = std::count_if(work_on<axis>.begin(), work_on<axis>.end(),
                                                     [](WorkKind kind) { return index_of(kind) < first_kinds; });

// The largest whole number that a double tells from its neighbours.
std::int64_t whole(double count) {
    constexpr double most = 0x1p53;
    return static_cast<std::int64_t>(std::min(count, most));
}

// --- Steps of a forecast: most of a trace's bytes.

// The numbers of a step, parted by colons.
class Numbers {
public:
    Numbers(const char* at, const char* end) : at_(at), end_(end) {}

    bool is_over() const { return at_ == end_ || *at_ == ' '; }
    const char* at() const { return at_; }

    bool read_colon() {
        if (at_ == end_ || *at_ != ':') return false;
        ++at_;
        return true;
    }

    bool read_number(double& number) {
        const std::from_chars_result result = std::from_chars(at_, end_, number);
        at_ = result.ptr;
        return result.ec == std::errc() && number >= 0;
    }

    bool read_count(double& count) { return read_digits(count) || read_number(count); }

    bool read_state(State& state) {
        if (at_ == end_ || *at_ < '0' || *at_ > '2') return false;
        state = static_cast<State>(*at_++ - '0');
        return true;
    }

private:
    // Up to fifteen digits and no more of a number: as counts are written, and several times as fast as any number.
    bool read_digits(double& number) {
        constexpr std::ptrdiff_t most_digits = 15;  // any such number is a double
        const char* digit = at_;
        std::int64_t value = 0;
        for (; digit != end_ && *digit >= '0' && *digit <= '9'; ++digit) {
            if (digit - at_ == most_digits) return false;
            value = 10 * value + (*digit - '0');
        }
        if (digit == at_ || digit == end_ || *digit != ':') return false;
        at_ = digit;
        number = static_cast<double>(value);
        return true;
    }

    const char* at_;
    const char* end_;
};

// Steps parted by blanks; `Form` writes and reads one.
template <class Form>
struct Steps {
    template <class AnyStep>
    static void write(std::string& line, const std::vector<AnyStep>& steps) {
        const char* blank = "";
        for (const AnyStep& step : steps) {
            Form::write_step(line += blank, step);
            blank = " ";
        }
    }

    template <class AnyStep>
    static std::string read(std::string_view field, std::vector<AnyStep>& steps) {
        if (field.empty()) return {};
        steps.reserve(1 + static_cast<std::size_t>(std::count(field.begin(), field.end(), ' ')));
        const char* const end = field.data() + field.size();
        for (const char* at = field.data();; ++at) {
            Numbers numbers(at, end);
            if (!Form::read_step(numbers, steps.emplace_back()) || !numbers.is_over())
                return "has " + shown({at, std::find(at, end, ' ')}) + ", expected " + Form::expected();
            at = numbers.at();
            if (at == end) return {};
        }
    }
};

// A step is its setting, a count for each kind of the axis, and its loss. One with fewer counts is from before the
// later kinds: those are 0.
template <WorkAxis axis>
struct AxisStep {
    static constexpr std::size_t most_numbers = 2 + work_on<axis>.size();
    static constexpr std::size_t least_numbers = 2 + first_kinds_on<axis>;

    static void write_step(std::string& line, const Step& step) {
        append_number(line, step.setting);
        for (const WorkKind kind : work_on<axis>) append_number(line += ':', step.work[kind]);
        append_number(line += ':', step.loss_px);
    }

    static bool read_step(Numbers& numbers, Step& step) {
        if (!numbers.read_number(step.setting)) return false;
        double last = 0;  // which number it is shows what follows it
        std::size_t kinds = 0;
        for (; kinds < first_kinds_on<axis>; ++kinds) {
            if (!numbers.read_colon() || !numbers.read_count(last)) return false;
            step.work[work_on<axis>[kinds]] = whole(last);
        }
        if (!numbers.read_colon() || !numbers.read_number(last)) return false;
        for (; kinds < work_on<axis>.size() && numbers.read_colon(); ++kinds) {
            step.work[work_on<axis>[kinds]] = whole(last);
            if (!numbers.read_number(last)) return false;
        }
        step.loss_px = last;
        return true;
    }

    static std::string expected() {
        std::string numbers = std::to_string(most_numbers);
        if (least_numbers < most_numbers) numbers = std::to_string(least_numbers) + " to " + numbers;
        return numbers + " numbers from 0, parted by colons";
    }
};

// A step is its rate, what that comes to in state, D and S, a count for each kind of work that a decision changes, and
// its loss.
struct RateForm {
    static void write_step(std::string& line, const RateStep& step) {
        append_number(line, step.rate);
        StateDigit::write(line += ':', step.state);
        append_number(line += ':', step.motion_distance);
        append_number(line += ':', step.splat_size);
        for (const WorkKind kind : work_on<WorkAxis::shape>) append_number(line += ':', step.work[kind]);
        for (const WorkKind kind : work_on<WorkAxis::motion>) append_number(line += ':', step.work[kind]);
        append_number(line += ':', step.loss);
    }

    static bool read_step(Numbers& numbers, RateStep& step) {
        const auto read_count = [&](WorkKind kind) {
            double count = 0;
            if (!numbers.read_colon() || !numbers.read_count(count)) return false;
            step.work[kind] = whole(count);
            return true;
        };
        return numbers.read_number(step.rate) && numbers.read_colon() && numbers.read_state(step.state) &&
               numbers.read_colon() && numbers.read_number(step.motion_distance) && numbers.read_colon() &&
               numbers.read_number(step.splat_size) && std::ranges::all_of(work_on<WorkAxis::shape>, read_count) &&
               std::ranges::all_of(work_on<WorkAxis::motion>, read_count) && numbers.read_colon() &&
               numbers.read_number(step.loss);
    }

    static std::string expected() {
        constexpr std::size_t numbers = 5 + work_on<WorkAxis::shape>.size() + work_on<WorkAxis::motion>.size();
        return std::to_string(numbers) + " numbers from 0, the second a state, parted by colons";
    }
};

// --- The table.

enum Need : bool { optional, required };

// What `path` leads to, member by member: row.decision.state for &TraceRow::decision, &Decision::state.
template <auto... path>
constexpr auto& member_of(auto& row) {
    return (row.*....*path);
}

template <class Form, auto... path>
constexpr TraceColumn column(std::string_view name, std::string_view unit, std::string_view meaning,
                             Need need = required) {
    constexpr bool is_decided = (std::is_same_v<decltype(path), decltype(&TraceRow::decision)> || ...);
    return {name,
            unit,
            meaning,
            need == required,
            is_decided,
            [](std::string& line, const TraceRow& row) { Form::write(line, member_of<path...>(row)); },
            [](TraceRow& row, std::string_view field) { return Form::read(field, member_of<path...>(row)); }};
}

template <std::size_t kind>
constexpr TraceColumn count_column() {
    constexpr const WorkEntry& entry = work_table[kind];
    return {entry.column,
            "",
            entry.meaning,
            kind < first_kinds,
            false,
            [](std::string& line, const TraceRow& row) { Count::write(line, row.work.counts[kind]); },
            [](TraceRow& row, std::string_view field) { return Count::read(field, row.work.counts[kind]); }};
}

template <std::size_t... first, std::size_t... later>
constexpr auto columns_with(std::index_sequence<first...>, std::index_sequence<later...>) {
    using Row = TraceRow;
    return std::array{
        column<Count, &Row::frame>("frame", "", "counts from 0"),
        column<Number, &Row::target_ms>("target_ms", "ms", "the user's"),
        column<MaybeNumber, &Row::frame_ms>(
            "frame_ms", "ms",
            "what the law holds at the target: the slower of CPU and GPU, or all of it on a software driver"),
        column<MaybeNumber, &Row::cpu_ms>("cpu_ms", "ms", "to record the frame"),
        column<MaybeNumber, &Row::gpu_ms>("gpu_ms", "ms", "to draw it, where the driver can say"),
        column<StateDigit, &Row::decision, &Decision::state>("state", "", "0, 1 or 2: what was decided"),
        column<Distance, &Row::decision, &Decision::motion_distance>("motion_distance_m", "m",
                                                                     "D: people beyond it move less often"),
        column<SplatSize, &Row::decision, &Decision::splat_size>("splat_px", "px",
                                                                 "S: the size of the points in state 2"),
        count_column<first>()...,
        column<Number, &Row::range>("range_m", "m", "L: how far people are visible, as the law was told"),
        count_column<first_kinds + later>()...,
        column<Count, &Row::hidden>("hidden", "",
                                    "people not drawn as the structure hides them; all others who aren't "
                                    "drawn are out of view or haven't come yet",
                                    optional),
        column<MaybeState, &Row::drawn_state>(
            "drawn_state", "",
            "2: somebody was drawn by less than their triangles; 1: somebody moved less often; 0: neither", optional),
        column<MaybeNumber, &Row::predicted_ms>("predicted_ms", "ms", "what the law expected of this frame", optional),
        column<MaybeNumber, &Row::max_motion_error_px>(
            "max_motion_error_px", "px", "at most so far is anybody drawn from where they are, as they moved before",
            optional),
        column<MaybeNumber, &Row::max_splat_error_px>(
            "max_splat_error_px", "px", "at most so far is anybody's surface from the nearest that is drawn of it",
            optional),
        column<MaybeNumber, &Row::predicted_flip>("predicted_flip", "", "FLIP that was expected of the frame",
                                                  optional),
        column<Rate, &Row::decision, &Decision::rate>(
            "rate", "px/piece", "what the next piece of work had to save to be drawn; 0: D and S decided", optional),
        column<Steps<AxisStep<WorkAxis::motion>>, &Row::motion>("motion_steps", "", "the forecast: its steps of D",
                                                                optional),
        column<Steps<AxisStep<WorkAxis::shape>>, &Row::shapes>("splat_steps", "", "the forecast: its steps of S",
                                                               optional),
        column<Steps<RateForm>, &Row::rates>("rate_steps", "", "the forecast: its steps of the rate", optional),
    };
}

constexpr auto columns =
    columns_with(std::make_index_sequence<first_kinds>(), std::make_index_sequence<work_kinds - first_kinds>());

std::string names(bool is_wanted(const TraceColumn&)) {
    std::string list;
    for (const TraceColumn& column : columns) {
        if (!is_wanted(column)) continue;
        if (!list.empty()) list += ',';
        list += column.name;
    }
    return list;
}

}  // namespace

std::span<const TraceColumn> trace_columns() {
    return columns;
}

std::string all_column_names() {
    return names([](const TraceColumn&) { return true; });
}

std::string required_column_names() {
    return names([](const TraceColumn& column) { return column.is_required; });
}

}  // namespace sfsm
