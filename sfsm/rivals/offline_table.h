// A rival that has measured the renderer before the run; the others know nothing of it.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "sfsm/controller.h"

namespace sfsm {

inline constexpr std::string_view offline_table_name = "offline-table";
inline constexpr int offline_steps = 64;  // of the table, even in detail

// `cost_ms`: what each detail in [0.05, 1] costs, free of noise [ms] > 0; asked once for each step, here.
std::unique_ptr<Controller> make_offline_table(const std::function<double(double detail)>& cost_ms);

}  // namespace sfsm
