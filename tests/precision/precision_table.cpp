// Prints the tables of docs/precision.md. --thirty-days: how far the law drifts in as many frames, which takes minutes.
#include <cstdio>
#include <string_view>

#include "tests/precision/control.h"
#include "tests/precision/table.h"

int main(int count, char** arguments) {
    if (count == 2 && std::string_view(arguments[1]) == "--thirty-days") {
        std::printf("%g px\n", precision::drift_of_control(precision::thirty_days));
        return 0;
    }
    if (count > 1) {
        std::fprintf(stderr, "precision_table: found '%s', expected --thirty-days or nothing\n", arguments[1]);
        return 2;
    }
    std::puts("| step | lens, picture | 1 m | 1 km | 100 km | 10,000 km |\n|---|---|---|---|---|---|");
    for (const precision::Line& line : precision::measure_lines()) std::puts(row_of(line).c_str());
    std::puts("\n| the law | S off, at most [px] |\n|---|---|");
    for (const precision::LawLine& line : precision::measure_law()) std::puts(row_of(line).c_str());
    std::puts("\n| what | breaks at | there |\n|---|---|---|");
    for (const precision::Limit& limit : precision::measure_limits()) std::puts(row_of(limit).c_str());
}
