// Constants that are over 0 and make residuals small: Levenberg and Marquardt's steps, over their logarithms.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace bench::loss {

// From `start`, all over 0. `residuals`: as many whatever it gets. The same bits in every run.
std::vector<double> least_squares(std::vector<double> start,
                                  const std::function<std::vector<double>(std::span<const double>)>& residuals);

}  // namespace bench::loss
