#include "tests/bench/front/before_rates.h"

#include <optional>
#include <stdexcept>
#include <vector>

#include "tests/bench/front/files.h"
#include "tests/bench/front/row.h"

namespace bench::front {

namespace {

constexpr std::string_view recorded_law = "predictive";

std::vector<Recorded> read_choices() {
    const std::string path = GRANDSTAND_BEFORE_RATES;
    const std::optional<std::string> text = contents_of(path);
    if (!text) throw std::runtime_error(path + ": found no such file, expected the front measured before rates");
    std::vector<Recorded> choices;
    for (const Row& row : from_csv(*text, path).rows)
        if (row.law == recorded_law) choices.push_back({row.people, row.view, row.target_ms, row.decision});
    return choices;
}

}  // namespace

std::span<const Recorded> choices_before_rates() {
    static const std::vector<Recorded> choices = read_choices();
    return choices;
}

}  // namespace bench::front
