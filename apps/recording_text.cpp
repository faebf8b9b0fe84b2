#include "apps/recording_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "apps/table.h"
#include "sfsm/number_text.h"
#include "sfsm/report/numbers.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;
using sfsm::Figures;

Json low_json(const sfsm::Low& low) {
    return {{"percentile", number(low.percentile)}, {"mean", number(low.mean)}, {"integral", number(low.integral)}};
}

Json stutter_json(const Figures& figures, std::span<const sfsm::Stutter> stutters) {
    using sfsm::Cause;
    constexpr std::array<std::pair<const char*, Cause>, 6> causes = {{{"recorder", Cause::recorder},
                                                                      {"compilation", Cause::compilation},
                                                                      {"gpu", Cause::gpu},
                                                                      {"cpu", Cause::cpu},
                                                                      {"waiting", Cause::waiting},
                                                                      {"untold", Cause::untold}}};
    Json by_cause = Json::object();
    for (const auto& [key, cause] : causes) {
        by_cause[key] = std::count_if(stutters.begin(), stutters.end(),
                                      [&](const sfsm::Stutter& stutter) { return stutter.cause == cause; });
    }
    return {{"share", number(figures.stutter_share)},
            {"count", figures.stutters},
            {"factor", sfsm::stutter_factor},
            {"window_frames", figures.stutter_window},
            {"by_cause", by_cause}};
}

Json over_json(std::span<const sfsm::Over> limits) {
    Json json = Json::array();
    for (const sfsm::Over& over : limits) {
        json.push_back(
            Json{{"limit_ms", number(over.limit_ms)}, {"frames", over.frames}, {"share", number(over.share)}});
    }
    return json;
}

Json bottleneck_json(const sfsm::Bottleneck& bottleneck) {
    return {{"frames", bottleneck.frames},
            {"gpu", number(bottleneck.gpu)},
            {"cpu", number(bottleneck.cpu)},
            {"neither", number(bottleneck.neither)}};
}

// Of a long name the end, which tells files apart better than the beginning.
std::string column_name(std::string_view name) {
    constexpr std::size_t longest = 28;
    if (width_of(name) <= longest) return std::string(name);
    while (width_of(name) > longest - 3 || (name.front() & 0xC0) == 0x80) name.remove_prefix(1);
    return "..." + std::string(name);
}

std::string csv_field(std::string_view text) {
    std::string field;
    for (const char c : text) {
        const bool ends_line = c == '\n' || c == '\r';
        field += ends_line ? ' ' : c;
        if (c == '"') field += c;
    }
    return field.find_first_of(",;\t\"") == std::string::npos ? field : '"' + field + '"';
}

template <class Number>
void append_told(std::string& line, Number value) {
    line += ',';
    if (!std::isnan(value)) sfsm::append_number(line, value);
}

void append_frame(std::string& line, const sfsm::FrameRecord& frame) {
    using Fate = sfsm::FrameRecord::Fate;
    for (const double value : {frame.frame_ms, frame.cpu_ms, frame.gpu_ms}) append_told(line, value);
    for (const float value : {frame.display_ms, frame.animation_error_ms}) append_told(line, value);
    line += frame.fate == Fate::untold ? "," : frame.fate == Fate::dropped ? ",1" : ",0";
    append_told(line, frame.compilations);
    line += '\n';
}

}  // namespace

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json figures_json(const Figures& figures, std::span<const sfsm::Stutter> stutters) {
    Json json;
    json["average_fps"] = number(figures.average_fps);
    json["median_fps"] = number(figures.median_fps);
    json["p1_fps"] = number(figures.p1_fps);
    json["p0_1_fps"] = number(figures.p01_fps);
    json["low_1_percent_fps"] = low_json(figures.low_1);
    json["low_0_1_percent_fps"] = low_json(figures.low_01);
    json["min_fps"] = number(figures.least_fps);
    json["max_fps"] = number(figures.most_fps);
    json["mean_ms"] = number(figures.mean_ms);
    json["median_ms"] = number(figures.median_ms);
    json["p99_ms"] = number(figures.p99_ms);
    json["p99_9_ms"] = number(figures.p999_ms);
    json["min_ms"] = number(figures.least_ms);
    json["max_ms"] = number(figures.most_ms);
    json["mean_step_ms"] = number(figures.mean_step_ms);
    json["mean_animation_error_ms"] = number(figures.mean_animation_error_ms);
    json["stutter"] = stutter_json(figures, stutters);
    json["over_ms"] = over_json(figures.over);
    json["seconds"] = number(figures.seconds);
    json["frames"] = figures.frames;
    json["timed"] = figures.timed;
    json["dropped"] = figures.dropped;
    json["generated"] = figures.generated;
    json["displayed"] = figures.displayed;
    json["bottleneck"] = bottleneck_json(figures.bottleneck);
    return json;
}

Json differences_json(std::span<const sfsm::Difference> differences) {
    Json json = Json::array();
    for (const sfsm::Difference& difference : differences) {
        json.push_back(Json{{"name", difference.name},
                            {"unit", difference.unit},
                            {"first", number(difference.first)},
                            {"second", number(difference.second)},
                            {"change", number(difference.change)},
                            {"low", number(difference.low)},
                            {"high", number(difference.high)},
                            {"is_share", difference.is_share},
                            {"is_clear", difference.is_clear()}});
    }
    return json;
}

void write_figures(std::ostream& out, std::span<const sfsm::ReportedRecording> recordings) {
    std::vector<TableLine> lines(1);
    for (const sfsm::ReportedRecording& recording : recordings) lines[0].cells.push_back(column_name(recording.name));
    for (const sfsm::report::NumberGroup& group : sfsm::report::numbers_of(recordings)) {
        lines.push_back({group.name, {}});
        for (const sfsm::report::NumberRow& row : group.rows) {
            TableLine& line = lines.emplace_back();
            line.label = "  " + row.name + (row.unit.empty() ? "" : " [" + row.unit + "]");
            for (const double value : row.values) line.cells.push_back(fixed(value, row.digits));
        }
    }
    write_table(out, lines);
}

void write_differences(std::ostream& out, std::string_view first, std::string_view second,
                       std::span<const sfsm::Difference> differences) {
    std::vector<TableLine> lines = {{"", {column_name(first), column_name(second), "change", "95 % within"}}};
    for (const sfsm::Difference& difference : differences) {
        const double scale = difference.is_share ? 100 : 1;
        const int digits = difference.is_share ? 2 : 1;
        TableLine line{
            difference.name + " [" + difference.unit + "]",
            {fixed(scale * difference.first, digits), fixed(scale * difference.second, digits),
             sfsm::report::change_text(difference, difference.change), sfsm::report::interval_text(difference)}};
        if (difference.is_clear()) line.cells.push_back("clear");
        lines.push_back(std::move(line));
    }
    write_table(out, lines);
}

void write_frames_csv(std::ostream& out, std::string_view run, std::span<const sfsm::FrameRecord> frames, bool header) {
    constexpr double ms_per_s = 1000;
    if (header)
        out << "run,frame,time_s,frame_time_ms,cpu_ms,gpu_ms,display_ms,animation_error_ms,dropped,compilations\n";
    const std::string name = csv_field(run);
    double begins_ms = 0;
    std::string line;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        line = name + ',';
        sfsm::append_number(line, static_cast<std::int64_t>(i));
        append_told(line, begins_ms / ms_per_s);
        append_frame(line, frames[i]);
        out << line;
        if (sfsm::is_timed(frames[i])) begins_ms += frames[i].frame_ms;
    }
}

}  // namespace apps
