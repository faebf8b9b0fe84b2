// The rows of a run that hasn't ended, kept as they come: a run that is broken off goes on from them.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/front/row.h"

namespace bench::front {

class Unfinished {
public:
    // Opens the file, or makes it. `about`: of all that the rows depend on beside what they name, without a line end;
    // rows about anything else, or of other columns, are dropped, which is said on stderr. A last line without its end
    // is dropped: the run was broken off within it. Throws std::runtime_error with one line for a file that can't be
    // read or written, or is damaged.
    Unfinished(std::filesystem::path path, const std::string& about, const Machine& machine);

    const std::vector<Row>& rows() const { return rows_; }  // that were there, and came since

    // Is in the file when this returns.
    void add(const Row& row);

    // All is kept elsewhere.
    void remove();

private:
    void write(const std::string& text);

    std::filesystem::path path_;
    std::vector<Row> rows_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, std::fclose};
};

}  // namespace bench::front
