#include "tests/bench/front/compare.h"

#include <algorithm>

#include "tests/bench/front/csv.h"

namespace bench::front {

namespace {

std::string name_of(const Row& row) {
    return row.view + ", " + row.family + " " + row.setting;
}

const Row* find(const std::vector<Row>& rows, const Row& like) {
    const auto at = std::ranges::find_if(rows, [&](const Row& row) {
        return row.people == like.people && row.view == like.view && row.family == like.family &&
               row.setting == like.setting && row.law == like.law && row.target_ms == like.target_ms;
    });
    return at == rows.end() ? nullptr : &*at;
}

bool is_by_opengl(const Row& row) {
    return row.family.starts_with("OpenGL");
}

}  // namespace

std::vector<std::string> moved(const Front& committed, const Front& found) {
    const bool same_driver = committed.machine.opengl == found.machine.opengl;
    const auto is_compared = [&](const Row& row) { return same_driver || !is_by_opengl(row); };
    std::vector<std::string> lines;
    for (const Row& row : committed.rows) {
        if (!is_compared(row)) continue;
        const Row* now = find(found.rows, row);
        if (!now) lines.push_back(name_of(row) + ": committed, not found");
        for (const Column& column : columns()) {
            if (!now || column.kind == Kind::time || column.text_of(*now) == column.text_of(row)) continue;
            lines.push_back(name_of(row) + ": " + column.name + " " + column.text_of(*now) + ", committed " +
                            column.text_of(row));
        }
    }
    for (const Row& row : found.rows)
        if (is_compared(row) && !find(committed.rows, row)) lines.push_back(name_of(row) + ": found, not committed");
    return lines;
}

}  // namespace bench::front
