// A progress bar for long steps: on a terminal only, and gone when the step is over.
#pragma once

#include <string>

namespace apps {

class ProgressBar {
public:
    // `what` says what goes on, in a few words.
    explicit ProgressBar(std::string what);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void operator()(double fraction);  // in [0, 1]

private:
    std::string what_;
    int shown_percent_ = -1;
    bool terminal_;
};

}  // namespace apps
