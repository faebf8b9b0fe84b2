#include "sfsm/recordings/formats.h"

#include <algorithm>

#include "sfsm/line_reader.h"
#include "sfsm/recordings/row_splitter.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

// The first that fits is it.
const std::vector<Format>& formats() {
    static const std::vector<Format> table = {
        {"CapFrameX CSV", Rows::presents, "MsBetweenPresents", {}, true},
        {"FrameView", Rows::presents, "MsBetweenPresents", {"Resolution", "Render Queue Depth"}},
        {"OCAT", Rows::presents, "MsBetweenPresents", {"Motherboard", "Base Driver Version", "Driver Package"}},
        {"PresentMon current",
         Rows::presents,
         "MsBetweenPresents",
         {"PresentRuntime", "MsCPUBusy", "MsGPUBusy", "MsBetweenAppStart", "FrameType"}},
        {"PresentMon 1.x", Rows::presents, "MsBetweenPresents", {}},
        {"PresentMon 2.x", Rows::presents, "FrameTime", {"CPUBusy", "GPUBusy", "DisplayedTime", "Application"}},
        {"PresentMon 2.0", Rows::presents, "CPUBusy", {}, false, "CPUWait"},
        {"PresentMon 2.0", Rows::presents, "CPUDuration", {}, false, "CPUFramePacingStall"},
        {"PresentMon 2.0", Rows::presents, "MsCPUBusy", {}, false, "MsCPUWait"},
        {"MangoHud", Rows::samples, "frametime", {"fps"}},
        {"FRAPS", Rows::clock, "Time (ms)", {"Frame"}},
    };
    return table;
}

// Other names for the same; the first that a file has is read. The frame time's is the format's.
struct Names {
    Column column;
    std::vector<std::string_view> names;
};
const std::vector<Names>& other_columns() {
    static const std::vector<Names> table = {
        {Column::process, {"Application"}},
        {Column::process_id, {"ProcessID"}},
        {Column::swap_chain, {"SwapChainAddress"}},
        {Column::cpu, {"MsCPUBusy", "CPUBusy", "CpuActive"}},
        {Column::gpu, {"MsGPUBusy", "GPUBusy", "MsGPUActive", "GpuActive"}},
        {Column::dropped, {"Dropped"}},
        {Column::displayed, {"DisplayedTime", "MsUntilDisplayed", "MsBetweenDisplayChange"}},
        {Column::frame_type, {"FrameType"}},
        {Column::present_time,
         {"TimeInSeconds", "TimeInMs", "TimeInQPC", "TimeInDateTime", "QPCTime", "CPUStartTime", "CPUStartTimeInMs",
          "CPUStartQPC", "CPUStartQPCTime", "CPUStartQPCTimeInMs", "CPUStartDateTime"}},
        {Column::fps, {"fps"}},
        {Column::elapsed, {"elapsed"}},
    };
    return table;
}

bool contains(const std::vector<std::string>& fields, std::string_view name) {
    return std::any_of(fields.begin(), fields.end(), [&](const std::string& field) { return same_name(field, name); });
}

bool fits(const Format& format, const std::vector<std::string>& fields, bool after_preamble) {
    if (format.has_preamble && !after_preamble) return false;
    if (!contains(fields, format.frame_time)) return false;
    if (!format.frame_rest.empty() && !contains(fields, format.frame_rest)) return false;
    return format.marks.empty() || std::any_of(format.marks.begin(), format.marks.end(),
                                               [&](std::string_view mark) { return contains(fields, mark); });
}

void place_column(Header& header, Column column, std::string_view name, const std::vector<std::string>& fields,
                  const LineReader& place) {
    const std::size_t index = static_cast<std::size_t>(column);
    for (std::size_t i = 0; i < fields.size() && !name.empty(); ++i) {
        if (!same_name(fields[i], name)) continue;
        if (header.position[index]) {
            place.fail("found two columns '" + std::string(name) + "', expected one");
        }
        header.position[index] = i;
        header.names[index] = fields[i];
    }
}

void drop(Header& header, Column column) {
    header.position[static_cast<std::size_t>(column)].reset();
}

Header place_columns(const Format& format, char separator, const std::vector<std::string>& fields,
                     const LineReader& place) {
    Header header{&format, separator, fields.size(), {}, {}};
    place_column(header, Column::frame_time, format.frame_time, fields, place);
    place_column(header, Column::frame_rest, format.frame_rest, fields, place);
    for (const Names& other : other_columns()) {
        for (const std::string_view name : other.names) {
            if (!header.has(other.column)) place_column(header, other.column, name, fields, place);
        }
    }
    if (header.has(Column::dropped)) drop(header, Column::displayed);
    if (header.has(Column::frame_rest)) drop(header, Column::cpu);  // it is the frame time's first part
    return header;
}

}  // namespace

std::optional<Header> find_header(std::string_view line, bool after_preamble, const LineReader& place) {
    for (const char separator : {',', ';', '\t'}) {
        const std::vector<std::string> fields = split_fields(line, separator);
        for (const Format& format : formats()) {
            if (fits(format, fields, after_preamble)) return place_columns(format, separator, fields, place);
        }
    }
    return std::nullopt;
}

std::string readable_formats() {
    std::string names = "one of our own traces";
    std::string_view before;
    for (const Format& format : formats()) {
        if (format.name != before) names += ", " + std::string(format.name);
        before = format.name;
    }
    return names + " or CapFrameX JSON";
}

}  // namespace sfsm
