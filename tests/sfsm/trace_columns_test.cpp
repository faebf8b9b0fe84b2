#include "sfsm/trace_columns.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace sfsm {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// "`S:triangles:points:loss`", of the kinds that a step of S has.
template <WorkAxis axis>
std::string step_form(const std::string& setting) {
    std::string form = "`" + setting;
    for (const WorkKind kind : work_on<axis>) form.append(":").append(entry_of(kind).column);
    return form + ":loss`";
}

TEST(TraceColumns, AreThoseThatTheReadmeOfTheTracesTells) {
    const std::string readme = text_of(GRANDSTAND_DOCS "/../traces/README.md");
    std::ostringstream table;
    for (const TraceColumn& column : trace_columns()) {
        table << "| `" << column.name << "` | " << column.unit << (column.unit.empty() ? "| " : " | ") << column.meaning
              << " |" << (column.is_required ? "" : " yes") << " |\n";
    }
    EXPECT_NE(readme.find("---|\n" + table.str() + "\n"), std::string::npos)
        << "expected this table in traces/README.md:\n"
        << table.str();
    std::string rate = "`rate:state:D:S";
    for (const WorkKind kind : work_on<WorkAxis::shape>) rate.append(":").append(entry_of(kind).column);
    for (const WorkKind kind : work_on<WorkAxis::motion>) rate.append(":").append(entry_of(kind).column);
    for (const std::string& form : {step_form<WorkAxis::motion>("D"), step_form<WorkAxis::shape>("S"), rate + ":loss`"})
        EXPECT_NE(readme.find(form), std::string::npos) << "expected " << form << " in traces/README.md";
}

TEST(TraceColumns, HaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const TraceColumn& column : trace_columns()) names.insert(column.name);
    EXPECT_EQ(names.size(), trace_columns().size());
    for (const WorkEntry& entry : work_table) EXPECT_TRUE(names.contains(entry.column)) << entry.column;
}

TEST(TraceColumns, OfADecisionAreMarked) {
    std::set<std::string_view> decided;
    for (const TraceColumn& column : trace_columns())
        if (column.is_decided) decided.insert(column.name);
    EXPECT_EQ(decided, (std::set<std::string_view>{"state", "motion_distance_m", "splat_px", "rate"}));
}

// What a column writes of any row it reads back, and puts where it found it.
TEST(TraceColumns, ReadWhatTheyWrite) {
    TraceRow row;
    row.frame = 1;
    row.target_ms = 2.5, row.frame_ms = 3.5, row.cpu_ms = 4.5, row.gpu_ms = 5.5, row.predicted_ms = 6.5;
    row.decision = {State::points, 7.5, 8.5, 0.25};
    row.range = 9.5;
    row.hidden = 11;
    row.drawn_state = State::slowed;
    row.max_motion_error_px = 12.5, row.max_splat_error_px = 13.5, row.predicted_flip = 0.0625;
    for (std::size_t i = 0; i < work_kinds; ++i) row.work.counts[i] = 10 + static_cast<std::int64_t>(i);
    row.motion = {{20, only_on<WorkAxis::motion>(row.work), 0.5}};
    row.shapes = {{0, only_on<WorkAxis::shape>(row.work), 0}, {4, only_on<WorkAxis::shape>(row.work), 2}};
    row.rates = {{0.5, State::slowed, 20, 4, {}, 0.125}};
    for (const TraceColumn& column : trace_columns()) {
        std::string written, again, untouched;
        column.write(written, row);
        TraceRow read;
        column.write(untouched, read);
        EXPECT_EQ(column.read(read, written), "") << column.name;
        column.write(again, read);
        EXPECT_EQ(again, written) << column.name;
        EXPECT_NE(again, untouched) << column.name;
    }
}

}  // namespace
}  // namespace sfsm
