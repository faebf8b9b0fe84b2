#include "apps/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace apps {

ProgressBar::ProgressBar(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) == 1) {
    (*this)(0.0);
}

ProgressBar::~ProgressBar() {
    if (!terminal_) return;
    std::fputs("\r\033[K", stderr);  // clears the line
    std::fflush(stderr);
}

void ProgressBar::operator()(double fraction) {
    const int percent = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
    if (!terminal_ || percent == shown_percent_) return;
    shown_percent_ = percent;
    constexpr int columns = 30;
    const int filled = percent * columns / 100;
    std::fprintf(stderr, "\r%-28s [%.*s%*s] %3d %%", what_.c_str(), filled, "##############################",
                 columns - filled, "", percent);
    std::fflush(stderr);
}

}  // namespace apps
