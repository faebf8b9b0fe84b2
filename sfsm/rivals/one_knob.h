// What all rivals are: laws of one knob. Theirs is a rendered area, a scale, a view range or a quality; here it is
// detail (sfsm/detail.h), number for number, so that 1 is all of it.
#pragma once

#include "sfsm/controller.h"
#include "sfsm/detail.h"

namespace sfsm {

inline constexpr double least_detail = 0.05;  // the coarsest a rival may go; their own limits lie between this and 0.35

// Takes care of all that is not the law: unusable numbers, limits, status, and the way from detail to decisions. Laws
// see each usable time once, in the order they arrive, with no regard to how late it is; so they do where they ship.
class OneKnob : public Controller {
public:
    void observe(const FrameSample& sample) final;
    Decision decide(const FrameRequest& request) final;
    void reset() final;
    const Status& status() const final { return status_; }

    double detail() const { return detail_; }  // [least_detail, 1]

protected:
    // What a law is told of one time.
    struct Measured {
        double ms = 0;         // T, within a factor of 1000 of the target
        double target_ms = 0;  // t, in [1e-6, 1e9]
        double load = 0;       // T / t
        double detail = 0;     // the frame was drawn with; in [0, 1]
    };

    explicit OneKnob(double detail = 1) : detail_(detail) {}

    virtual void learn(const Measured& measured) = 0;

    // The law becomes one that was just made, base and all.
    virtual void forget() = 0;

    // Limits to [least_detail, 1]. True when it could not go all the way.
    bool turn_to(double detail, const char* reason);
    void keep(const char* reason) { status_.reason = reason; }

private:
    double detail_;
    double target_ms_ = 0;          // 0: none yet
    double range_ = unknown_range;  // [m]
    Status status_;
};

}  // namespace sfsm
