#include "sfsm/simulate/scorecard_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "sfsm/number_text.h"

namespace sfsm::simulate {
namespace {

std::string json_number(double value) {
    constexpr double decimals = 1e6;
    return std::isfinite(value) ? number_text(std::round(value * decimals) / decimals) : "null";
}

std::string json_number(const std::optional<double>& value) {
    return value ? json_number(*value) : "null";
}

// Names of scenarios and laws are plain words.
std::string json_text(const std::string& value) {
    return '"' + value + '"';
}

std::string json_row(const Row& row) {
    const Metrics& m = row.median;
    const std::pair<const char*, std::string> fields[] = {
        {"scenario", json_text(row.scenario)},
        {"law", json_text(row.law)},
        {"tuning", json_text(tuning_name(row.tuning))},
        {"target_factor", json_number(row.target_factor)},
        {"is_equal", row.is_equal ? "true" : "false"},
        {"over_5pct", json_number(m.over_5pct)},
        {"oracle_over_5pct", json_number(row.oracle_over_5pct)},
        {"worst_over_5pct", json_number(row.worst.over_5pct)},
        {"over_target", json_number(m.over_target)},
        {"worst_second", json_number(m.worst_second)},
        {"within_5pct", json_number(m.within_5pct)},
        {"within_10pct", json_number(m.within_10pct)},
        {"control_rate", json_number(m.control_rate)},
        {"quality", json_number(m.quality)},
        {"worst_quality", json_number(row.worst.quality)},
        {"settle_down", json_number(m.settle_down)},
        {"worst_settle_down", json_number(row.worst.settle_down)},
        {"settle_up", json_number(m.settle_up)},
        {"worst_settle_up", json_number(row.worst.settle_up)},
        {"cost_settle_down", json_number(m.cost_settle_down)},
        {"worst_cost_settle_down", json_number(row.worst.cost_settle_down)},
        {"cost_settle_up", json_number(m.cost_settle_up)},
        {"worst_cost_settle_up", json_number(row.worst.cost_settle_up)},
        {"overshoot_pct", json_number(m.overshoot_pct)},
        {"hitch_ms_per_s", json_number(m.hitch_ms_per_s)},
        {"reversals_per_1000", json_number(m.reversals_per_1000)},
        {"worst_reversals_per_1000", json_number(row.worst.reversals_per_1000)},
        {"variation_per_1000", json_number(m.variation_per_1000)},
        {"changes_per_1000", json_number(m.changes_per_1000)},
        {"recovery", json_number(m.recovery)},
        {"regain", json_number(m.regain)},
        {"worst_regain", json_number(row.worst.regain)},
        {"stuck_seeds", json_number(row.stuck_seeds)},
        {"mean_ms", json_number(m.mean_ms)},
        {"least_mean_ms", json_number(row.least_mean_ms)},
        {"worst_mean_ms", json_number(row.worst.mean_ms)},
        {"largest_step", json_number(m.largest_step)},
        {"worst_largest_step", json_number(row.worst.largest_step)},
        {"first_over", json_number(m.first_over)},
        {"worst_first_over", json_number(row.worst.first_over)},
        {"first_coarse", json_number(m.first_coarse)},
        {"worst_first_coarse", json_number(row.worst.first_coarse)},
        {"us_per_frame", json_number(row.us_per_frame)},
    };
    std::string text = "{";
    for (const auto& [name, value] : fields) {
        if (text.size() > 1) text += ", ";
        text += json_text(name) + ": " + value;
    }
    return text + "}";
}

std::string fixed(double value, int decimals) {
    std::array<char, 64> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    return end.ec == std::errc() ? std::string(text.data(), end.ptr) : "?";
}

std::string percent(double share) {
    return fixed(100 * share, 1);
}

std::string frames(bool is_asked, const std::optional<double>& value) {
    if (!is_asked) return "-";
    return value ? fixed(*value, 0) : "never";
}

using Cells = std::vector<std::string>;

const Cells header = {"law",     "tuning",  "aim",   "over %",  "worst", "oracle", "in 5 %", "in 10 %",
                      "control", "quality", "worst", "settle",  "up",    "cost",   "up",     "peak %",
                      "turns",   "worst",   "moved", "changes", "back",  "regain", "worst",  "stuck",
                      "mean ms", "octaves", "first", "coarse",  "us"};
constexpr std::size_t left_columns = 2;  // words; the rest are numbers

Cells cells(const Row& row) {
    const Metrics& m = row.median;
    return {row.law,
            row.is_equal ? tuning_name(row.tuning) : "not equal",
            fixed(row.target_factor, 3),
            percent(m.over_5pct),
            percent(row.worst.over_5pct),
            percent(row.oracle_over_5pct),
            percent(m.within_5pct),
            percent(m.within_10pct),
            percent(m.control_rate),
            fixed(m.quality, 3),
            fixed(row.worst.quality, 3),
            frames(row.has_step_down, m.settle_down),
            frames(row.has_step_up, m.settle_up),
            frames(row.has_step_down, m.cost_settle_down),
            frames(row.has_step_up, m.cost_settle_up),
            fixed(m.overshoot_pct, 0),
            fixed(m.reversals_per_1000, 1),
            fixed(row.worst.reversals_per_1000, 1),
            fixed(m.variation_per_1000, 2),
            fixed(m.changes_per_1000, 1),
            frames(row.has_interruption, m.recovery),
            frames(row.has_regain, m.regain),
            frames(row.has_regain, row.worst.regain),
            fixed(row.stuck_seeds, 0),
            fixed(row.least_mean_ms, 1) + "-" + fixed(row.worst.mean_ms, 1),
            fixed(row.worst.largest_step, 1),
            fixed(row.worst.first_over, 2),
            fixed(row.worst.first_coarse, 2),
            fixed(row.us_per_frame, 2)};
}

void write_line(std::ostream& out, const Cells& line, std::span<const std::size_t> widths) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::string blanks(widths[i] - line[i].size(), ' ');
        text += i < left_columns ? line[i] + blanks : blanks + line[i];
        if (i + 1 < line.size()) text += "  ";
    }
    out << text << '\n';
}

}  // namespace

void write_scorecard_json(std::ostream& out, const ScorecardOptions& options, std::span<const Row> rows) {
    out << "{\"seeds\": " << options.seeds << ", \"reference\": " << json_text(options.reference.name)
        << ", \"rows\": [";
    const char* separator = "\n";
    for (const Row& row : rows) {
        out << separator << json_row(row);
        separator = ",\n";
    }
    out << "\n]}\n";
}

void write_scorecard_table(std::ostream& out, const ScorecardOptions& options, std::span<const Row> rows) {
    std::vector<std::size_t> widths;
    for (const std::string& name : header) widths.push_back(name.size());
    for (const Row& row : rows) {
        const Cells line = cells(row);
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    for (const Scenario& scenario : options.scenarios) {
        out << scenario.name << ": " << scenario.about << '\n';
        write_line(out, header, widths);
        for (const Row& row : rows) {
            if (row.scenario == scenario.name) write_line(out, cells(row), widths);
        }
        out << '\n';
    }
}

}  // namespace sfsm::simulate
