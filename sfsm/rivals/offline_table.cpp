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

double detail_at(int step) {
    return least_detail + (1 - least_detail) * step / offline_steps;
}

class OfflineTable final : public OneKnob {
public:
    explicit OfflineTable(std::vector<double> costs_ms) : costs_ms_(std::move(costs_ms)) {}

private:
    void forget() override { *this = OfflineTable(std::move(costs_ms_)); }

    void learn(const Measured& measured) override {
        log_gain_ += share_of_new * (std::log(measured.ms / cost_ms(measured.detail)) - log_gain_);
        const double budget_ms = measured.target_ms / std::exp(log_gain_);
        turn_to(finest_within(budget_ms), "the finest step that fits");
    }

    double cost_ms(double detail) const {
        const double place = (detail - least_detail) / (1 - least_detail) * offline_steps;
        return costs_ms_[static_cast<std::size_t>(std::clamp<double>(std::round(place), 0, offline_steps))];
    }

    double finest_within(double budget_ms) const {
        for (int step = offline_steps; step > 0; --step)
            if (costs_ms_[static_cast<std::size_t>(step)] <= budget_ms) return detail_at(step);
        return least_detail;
    }

    std::vector<double> costs_ms_;  // by step
    double log_gain_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_offline_table(const std::function<double(double detail)>& cost_ms) {
    std::vector<double> costs_ms;
    for (int step = 0; step <= offline_steps; ++step) costs_ms.push_back(cost_ms(detail_at(step)));
    return std::make_unique<OfflineTable>(std::move(costs_ms));
}

}  // namespace sfsm
