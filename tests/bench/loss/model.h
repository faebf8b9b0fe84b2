// What is expected of a picture, by constants that are looked for; and how near that is to what was measured.
#pragma once

#include <string>
#include <vector>

#include "figures/expected_error.h"
#include "render/native/backdrop.h"
#include "tests/bench/loss/sums.h"

namespace bench::loss {

// Pictures of one way of drawing, each with what is expected of what lies around its people.
class Measured {
public:
    // `pictures` must outlive it. Throws std::runtime_error with one line: of views without a picture of nobody.
    Measured(const std::vector<Picture>& pictures, sfsm::Drawing drawing);

    struct One {
        const Picture* picture = nullptr;
        const Picture* nobody = nullptr;  // null: what lies around isn't expected, only people are
        double flip = 0;                  // mean of the frame; without `nobody` of the people's pixels alone
    };
    const std::vector<One>& all() const { return all_; }

private:
    std::vector<One> all_;
};

// Mean FLIP of a picture of nobody.
double expected(const Picture& nobody, const render::native::BackdropErrors& errors);
// Sum over a class's pixels.
double expected(const Sum& sum, const figures::ExpectedError& error);
// Mean FLIP: as Measured::One::flip.
double expected(const Measured::One& one, const figures::ExpectedError& error,
                const render::native::BackdropErrors& around);

}  // namespace bench::loss
