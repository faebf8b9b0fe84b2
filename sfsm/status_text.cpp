#include "sfsm/status_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double least_bias = 0.005;   // [ln] of forecasts: less isn't worth a word
constexpr double least_factor = 0.05;  // from 1
constexpr std::array state_names = {"original", "slowed", "points"};

void append_line(std::string& text, std::string_view name, const std::string& words) {
    text.append(name).append(": ").append(words).append("\n");
}

std::string reason_text(const Status& status) {
    std::string text = status.reason;
    if (status.is_probe) return text + "; to learn from";
    if (status.kept_for <= 0) return text;
    return text + "; kept since, for " + std::to_string(status.kept_for) +
           (status.kept_for == 1 ? " frame" : " frames");
}

// A display's refresh or a slower cap may be all that can be had, and detail can be too dear whatever is drawn.
std::string aim_text(const Status& status) {
    std::string text = duration_text(status.target_ms) + " asked";
    if (std::isfinite(status.due_ms) && status.due_ms != status.target_ms)
        text += ", " + duration_text(status.due_ms) + " can be had";
    if (std::isfinite(status.aim_ms)) text += ", " + duration_text(status.aim_ms) + " aimed at";
    if (status.least_ms > status.due_ms)
        text += "; out of reach, even the coarsest frame takes " + duration_text(status.least_ms);
    return text;
}

std::string prediction_text(const Status& status) {
    std::string text = duration_text(status.predicted_ms) + " +- " + percent_text(status.uncertainty);
    text += ", and a single frame's noise is " + percent_text(status.noise);
    if (status.least_ms <= status.due_ms) text += "; the coarsest frame takes " + duration_text(status.least_ms);
    return text;
}

std::string waiting_text(const Status& status) {
    if (std::isfinite(status.refresh_ms))
        return "frames wait for a display, " + duration_text(status.refresh_ms) + " a refresh";
    return "frames wait for something, as a cap on the frame rate, and take no less than " +
           duration_text(status.floor_ms);
}

std::string more_or_less(double log_ratio) {
    return percent_text(std::abs(std::expm1(log_ratio))) + (log_ratio > 0 ? " more" : " less");
}

// Empty where forecasts are believed as they are.
std::string foresight_text(const Status& status) {
    std::string text;
    for (const WorkEntry& entry : work_table) {
        const double factor = status.foreseen_factor[index_of(entry.kind)];
        if (!(std::abs(factor - 1) > least_factor)) continue;
        text += std::string(text.empty() ? "" : ", ") + std::string(entry.name) + " drawn " + short_number(factor, 3) +
                " times what is foreseen";
    }
    if (std::abs(status.foreseen_bias) > least_bias)
        text += std::string(text.empty() ? "" : ", ") + "frames take " + more_or_less(status.foreseen_bias) +
                " than foreseen";
    return text;
}

void append_price(std::string& text, std::string_view name, double ms, double sigma_ms) {
    if (!std::isfinite(ms)) return;
    append_line(text, "  " + std::string(name), estimate_text(ms, sigma_ms));
}

void append_prices(std::string& text, const Status& status) {
    if (!std::isfinite(status.price_ms.frame)) return;
    text += "prices, learned from times:\n";
    append_price(text, "what every frame has", status.price_ms.frame, status.price_sigma_ms.frame);
    for (const WorkEntry& entry : work_table)
        append_price(text, entry.name, status.price_ms[entry.kind], status.price_sigma_ms[entry.kind]);
    for (std::size_t i = 0; i < status.step_ms.size(); ++i) {
        const std::string name = "detail to " + short_number((static_cast<double>(i) + 1) / detail_steps, 3);
        append_price(text, name, status.step_ms[i], status.step_sigma_ms[i]);
    }
}

}  // namespace

std::string status_text(const Status& status) {
    std::string text;
    append_line(text, "decided", decision_text(status.decision));
    append_line(text, "why", reason_text(status));
    append_line(text, "target", aim_text(status));
    if (std::isfinite(status.predicted_ms)) append_line(text, "predicted", prediction_text(status));
    if (std::isfinite(status.floor_ms)) append_line(text, "waiting", waiting_text(status));
    if (std::isfinite(status.drift))
        append_line(text, "drift", "the load never rests, and takes " + more_or_less(status.drift) + " a frame now");
    if (std::isfinite(status.ceiling))
        append_line(text, "ceiling", "detail " + short_number(status.ceiling, 3) + " proved too dear");
    const std::string foresight = foresight_text(status);
    if (!foresight.empty()) append_line(text, "forecasts", foresight);
    append_prices(text, status);
    return text;
}

std::string decision_text(const Decision& decision) {
    const int state = static_cast<int>(decision.state);
    std::string text = "state " + std::to_string(state) + " (" + state_names[static_cast<std::size_t>(state)] + ")";
    if (decision.state != State::original) text += ", D " + short_number(decision.motion_distance, 4) + " m";
    if (decision.splat_size > 0) text += ", S " + short_number(decision.splat_size, 3) + " px";
    if (decision.rate > 0) text += ", rate " + short_number(decision.rate, 3) + " px";
    return text;
}

std::string short_number(double value, int digits) {
    std::array<char, 32> text{};
    const bool is_long = std::abs(value) >= std::pow(10, digits) && std::abs(value) < 1e15;
    const auto format = is_long ? std::chars_format::fixed : std::chars_format::general;
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, format, is_long ? 0 : digits);
    return {text.data(), error == std::errc() ? end : text.data()};
}

std::string duration_text(double ms) {
    constexpr double least_ms = 0.1, least_us = 1e-4;
    constexpr int shown = 4;
    if (ms < least_us && ms > 0) return short_number(1e6 * ms, shown) + " ns";
    if (ms < least_ms && ms > 0) return short_number(1e3 * ms, shown) + " us";
    return short_number(ms, shown) + " ms";
}

std::string percent_text(double share) {
    return short_number(100 * share, 2) + " %";
}

std::string estimate_text(double ms, double sigma_ms) {
    return duration_text(ms) + " +- " + (ms > 0 ? percent_text(sigma_ms / ms) : duration_text(sigma_ms));
}

}  // namespace sfsm
