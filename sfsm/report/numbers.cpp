#include "sfsm/report/numbers.h"

#include <algorithm>
#include <cmath>

#include "sfsm/report/markup.h"

namespace sfsm::report {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double count(std::int64_t number) {
    return static_cast<double>(number);
}

// A group's rows, each a figure of all recordings.
class Group {
public:
    Group(std::span<const ReportedRecording> recordings, std::string name)
        : recordings_(recordings), group_{std::move(name), {}} {}

    // `figure(figures)` is the row's value of a recording.
    template <class Figure>
    void add(const std::string& name, const char* unit, int digits, const std::string& meaning, const Figure& figure) {
        NumberRow row{name, unit, meaning, {}, digits};
        for (const ReportedRecording& recording : recordings_) row.values.push_back(figure(recording.figures));
        add_row(std::move(row));
    }
    // A count that says nothing where it is 0 of all.
    template <class Figure>
    void add_if_any(const std::string& name, const std::string& meaning, const Figure& figure) {
        const bool is_any =
            std::any_of(recordings_.begin(), recordings_.end(),
                        [&](const ReportedRecording& recording) { return figure(recording.figures) > 0; });
        if (is_any) add(name, "", 0, meaning, figure);
    }
    void add_row(NumberRow row) {
        const bool says_something =
            std::any_of(row.values.begin(), row.values.end(), [](double value) { return std::isfinite(value); });
        if (says_something) group_.rows.push_back(std::move(row));
    }
    NumberGroup take() { return std::move(group_); }

private:
    std::span<const ReportedRecording> recordings_;
    NumberGroup group_;
};

NumberGroup rates(std::span<const ReportedRecording> recordings) {
    Group group(recordings, "Frame rate");
    group.add("average", "fps", 1, "frames over time", [](const Figures& f) { return f.average_fps; });
    group.add("median", "fps", 1, "half of the frames are as fast or faster",
              [](const Figures& f) { return f.median_fps; });
    group.add("P1", "fps", 1, "1 % low as a percentile: 99 % of the frames are as fast or faster",
              [](const Figures& f) { return f.p1_fps; });
    group.add("P0.1", "fps", 1, "0.1 % low as a percentile: 99.9 % of the frames are as fast or faster",
              [](const Figures& f) { return f.p01_fps; });
    group.add("minimum", "fps", 1, "of the longest frame", [](const Figures& f) { return f.least_fps; });
    group.add("maximum", "fps", 1, "of the shortest frame", [](const Figures& f) { return f.most_fps; });
    group.add("1 % low, mean", "fps", 1, "1000 over the mean time of the slowest 1 % of the frames",
              [](const Figures& f) { return f.low_1.mean; });
    group.add("0.1 % low, mean", "fps", 1, "1000 over the mean time of the slowest 0.1 % of the frames",
              [](const Figures& f) { return f.low_01.mean; });
    group.add("1 % low, integral", "fps", 1, "the slowest frames, up to this one, took 1 % of the time",
              [](const Figures& f) { return f.low_1.integral; });
    group.add("0.1 % low, integral", "fps", 1, "the slowest frames, up to this one, took 0.1 % of the time",
              [](const Figures& f) { return f.low_01.integral; });
    return group.take();
}

NumberGroup times(std::span<const ReportedRecording> recordings) {
    Group group(recordings, "Frame time");
    group.add("mean", "ms", 2, "", [](const Figures& f) { return f.mean_ms; });
    group.add("median", "ms", 2, "", [](const Figures& f) { return f.median_ms; });
    group.add("99 %", "ms", 2, "99 % of the frames don't take longer", [](const Figures& f) { return f.p99_ms; });
    group.add("99.9 %", "ms", 2, "99.9 % of the frames don't take longer", [](const Figures& f) { return f.p999_ms; });
    group.add("shortest", "ms", 2, "", [](const Figures& f) { return f.least_ms; });
    group.add("longest", "ms", 2, "", [](const Figures& f) { return f.most_ms; });
    group.add("frame to frame", "ms", 2, "how much a time differs from the one before, in the mean",
              [](const Figures& f) { return f.mean_step_ms; });
    group.add("animation error", "ms", 2, "how far the animation was from what the display showed, in the mean",
              [](const Figures& f) { return f.mean_animation_error_ms; });
    return group.take();
}

NumberGroup stutter(std::span<const ReportedRecording> recordings) {
    constexpr double percent = 100;
    Group group(recordings, "Smoothness");
    std::string meaning = "frames over " + figure(stutter_factor, 1) + " times the mean of the last ";
    for (const ReportedRecording& recording : recordings) {
        meaning += (&recording == &recordings.front() ? "" : ", ") + std::to_string(recording.figures.stutter_window);
    }
    meaning += " frames, as CapFrameX counts";
    const auto of_timed = [](const Figures& f, double value) { return f.timed > 0 ? value : unknown; };
    group.add("stutters", "", 0, meaning, [&](const Figures& f) { return of_timed(f, count(f.stutters)); });
    group.add("in stutter", "% of time", 2, "share of the time in such frames",
              [&](const Figures& f) { return of_timed(f, percent * f.stutter_share); });
    const std::vector<Over>& limits = recordings.front().figures.over;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        group.add("over " + figure(limits[i].limit_ms, 1) + " ms", "% of frames", 2, "", [&](const Figures& f) {
            return f.timed > 0 && i < f.over.size() ? percent * f.over[i].share : unknown;
        });
    }
    const double limit = common_target(recordings);
    NumberRow target{"over the target",
                     "% of frames",
                     std::isfinite(limit) ? "the target: " + figure(limit, 2) + " ms" : "of each frame",
                     {},
                     2};
    for (const ReportedRecording& recording : recordings)
        target.values.push_back(percent * recording.over_target.share);
    group.add_row(std::move(target));
    return group.take();
}

NumberGroup bottleneck(std::span<const ReportedRecording> recordings) {
    constexpr double percent = 100;
    Group group(recordings, "Held up by");
    const auto share = [](const Figures& f, double value) {
        return f.bottleneck.frames > 0 ? percent * value : unknown;
    };
    group.add("GPU", "% of time", 1, "busy for 90 % of the frame or more, and no less than the CPU",
              [&](const Figures& f) { return share(f, f.bottleneck.gpu); });
    group.add("CPU", "% of time", 1, "busy for 90 % of the frame or more",
              [&](const Figures& f) { return share(f, f.bottleneck.cpu); });
    group.add("neither", "% of time", 1, "a display, a cap or a lock",
              [&](const Figures& f) { return share(f, f.bottleneck.neither); });
    return group.take();
}

NumberGroup extent(std::span<const ReportedRecording> recordings) {
    Group group(recordings, "Recording");
    group.add("duration", "s", 1, "", [](const Figures& f) { return f.seconds; });
    group.add("frames", "", 0, "rendered by the application", [](const Figures& f) { return count(f.frames); });
    group.add_if_any("without a time", "", [](const Figures& f) { return count(f.frames - f.timed); });
    group.add_if_any("dropped", "rendered, never shown",
                     [](const Figures& f) { return f.dropped + f.shown > 0 ? count(f.dropped) : unknown; });
    group.add_if_any("generated", "presents besides, which the application didn't render",
                     [](const Figures& f) { return count(f.generated); });
    group.add("presented", "fps", 1, "with those that were generated", [](const Figures& f) {
        return f.generated > 0 && f.seconds > 0 ? count(f.timed + f.generated) / f.seconds : unknown;
    });
    return group.take();
}

const char* unit_of(const Difference& difference) {
    return difference.is_share ? " points" : " %";
}

// Of what is written as hundredths.
std::string signed_text(const Difference& difference, double change) {
    constexpr double nearly_nothing = 0.001;
    const bool is_fine =
        difference.is_share || std::abs(difference.low) < nearly_nothing || std::abs(difference.high) < nearly_nothing;
    const std::string text = figure(100 * std::abs(change), is_fine ? 2 : 1);
    const bool is_nothing = text.find_first_not_of("0.") == std::string::npos;
    return (change < 0 && !is_nothing ? "-" : "+") + text;
}

}  // namespace

bool has_stutters(const Report& report) {
    return std::any_of(report.recordings.begin(), report.recordings.end(),
                       [](const ReportedRecording& recording) { return !recording.stutters.empty(); });
}

std::string change_text(const Difference& difference, double change) {
    return std::isfinite(change) ? signed_text(difference, change) + unit_of(difference) : "\u2013";
}

std::string interval_text(const Difference& difference) {
    if (!std::isfinite(difference.low)) return "\u2013";
    return signed_text(difference, difference.low) + " to " + change_text(difference, difference.high);
}

double common_target(std::span<const ReportedRecording> recordings) {
    double common = unknown;
    for (const ReportedRecording& recording : recordings) {
        if (std::isnan(recording.over_target.share)) continue;
        const double limit = recording.over_target.limit_ms;
        if (std::isnan(limit) || (!std::isnan(common) && limit != common)) return unknown;
        common = limit;
    }
    return common;
}

std::vector<NumberGroup> numbers_of(std::span<const ReportedRecording> recordings) {
    std::vector<NumberGroup> groups;
    if (recordings.empty()) return groups;
    for (NumberGroup group :
         {rates(recordings), times(recordings), stutter(recordings), bottleneck(recordings), extent(recordings)}) {
        if (!group.rows.empty()) groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace sfsm::report
