// Holds pictures of a view against its reference.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/fidelity.h"
#include "tests/bench/flip.h"
#include "tests/bench/front/references.h"
#include "tests/bench/front/row.h"

namespace bench::front {

// The reference's half of FLIP and SSIM is done once. Numbers are the same bits on any number of threads.
class Judge {
public:
    explicit Judge(Reference reference);

    // What a picture of the shot's `now` is off, and how it changed since the frame before: the fields of a row.
    void judge(const render::Image& before, const render::Image& now, Row& row) const;

    const Reference& reference() const { return reference_; }
    const std::vector<std::uint8_t>& crowd() const { return crowd_; }

private:
    struct Maps {
        std::vector<float> flip;
        std::vector<double> ssim;
    };
    ImageErrors errors(const render::Image& now, const Maps& maps, Mask mask) const;

    Reference reference_;
    std::vector<std::uint8_t> crowd_;
    bool has_crowd_;
    FlipReference flip_;
    SsimReference ssim_;
};

}  // namespace bench::front
