// A table of what each step of detail costs, learned once before the run, and one gain that follows the times. So
// published for Unreal in 2026, of tables of time and quality; how their gain follows is not known, and ours.
#include "sfsm/rivals/offline_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sfsm/rivals/one_knob.h"

namespace sfsm {
namespace {

constexpr double share_of_new = 0.125;  // of a time, in the gain

class OfflineTable final : public OneKnob {
public:
    explicit OfflineTable(std::vector<double> costs_ms) : costs_ms_(std::move(costs_ms)) {}

private:
    void learn(const Measured& measured) override {
        log_gain_ += share_of_new * (std::log(measured.ms / cost_ms(measured.detail)) - log_gain_);
        const double budget_ms = measured.target_ms / std::exp(log_gain_);
        turn_to(finest_within(budget_ms), "the finest step that fits");
    }

    std::size_t last() const { return costs_ms_.size() - 1; }

    double detail_at(std::size_t step) const {
        return least_detail + (1 - least_detail) * static_cast<double>(step) / static_cast<double>(last());
    }

    double cost_ms(double detail) const {
        const double place = (detail - least_detail) / (1 - least_detail) * static_cast<double>(last());
        return costs_ms_[static_cast<std::size_t>(std::clamp(std::round(place), 0.0, static_cast<double>(last())))];
    }

    double finest_within(double budget_ms) const {
        for (std::size_t step = last(); step > 0; --step)
            if (costs_ms_[step] <= budget_ms) return detail_at(step);
        return least_detail;
    }

    std::vector<double> costs_ms_;
    double log_gain_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_offline_table(const std::function<double(double detail)>& cost_ms) {
    std::vector<double> costs_ms;
    for (int step = 0; step <= offline_steps; ++step)
        costs_ms.push_back(cost_ms(least_detail + (1 - least_detail) * step / offline_steps));
    return std::make_unique<OfflineTable>(std::move(costs_ms));
}

}  // namespace sfsm
