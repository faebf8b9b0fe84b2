// The clairvoyant: it knows what every decision will cost in the frame about to be drawn, except for the noise, and
// takes the one of most detail that costs no more than the target. No law that doesn't know the noise can do better.
#pragma once

#include "sfsm/simulate/course.h"

namespace sfsm::simulate {

inline constexpr std::string_view oracle_name = "oracle";

// Knows frames by counting decide(). The course must outlive it.
class Oracle final : public Controller {
public:
    explicit Oracle(const Course& course) : course_(&course) {}

    void observe(const FrameSample& sample) override { status_.last_ms = sample.ms; }
    Decision decide(const FrameRequest& request) override;
    void reset() override {}  // it has learned nothing
    const Status& status() const override { return status_; }

private:
    const Course* course_;
    std::size_t frame_ = 0;
    Status status_;
};

}  // namespace sfsm::simulate
