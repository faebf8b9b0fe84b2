#include "model/warnings.h"

#include <algorithm>

#include "model/input_file.h"

namespace model {

void Warnings::add(std::string_view what, std::string_view first) {
    const auto found = std::ranges::find(all_, what, &Warning::what);
    if (found != all_.end())
        ++found->count;
    else
        all_.push_back({std::string(what), first.empty() ? std::string() : in_quotes(first)});
}

std::string text_of(const Warning& warning) {
    std::string text = warning.what;
    if (!warning.first.empty()) text += ": " + warning.first;
    if (warning.count > 1) text += ", and " + std::to_string(warning.count - 1) + " more";
    return text;
}

}  // namespace model
