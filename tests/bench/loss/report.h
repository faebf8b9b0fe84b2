// How far what is expected of pictures is from what was measured, view by view.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/loss/model.h"

namespace bench::loss {

struct Residuals {
    std::int64_t people = 0;
    std::string view;
    bool is_fitted = false;
    double median = 1, worst = 1;  // expected / measured: of the view's pictures; worst: the farthest from 1
    std::string worst_recipe;
    double rank = 1;  // Spearman's correlation of expected and measured: 1 where they agree on the order
};

// In the pictures' order.
std::vector<Residuals> residuals_of(const Measured& measured, const figures::ExpectedError& error,
                                    const render::native::BackdropErrors& around);

// Spearman's, of as many values; equal ones share their ranks' mean. 1 for fewer than two different ones.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

// Tables as they stand in docs/measurements/loss.md.
std::string table_of(const std::vector<Residuals>& residuals);
// What of the views is fitted, and what judged: one line each.
std::string summary_of(const Measured& measured, const figures::ExpectedError& error,
                       const render::native::BackdropErrors& around);

// As it stands in figures/way.cpp; in render/native/backdrop.h.
std::string text_of(const figures::ExpectedError& error);
std::string text_of(const render::native::BackdropErrors& errors);

}  // namespace bench::loss
