#include "tests/bench/loss/model.h"

#include <algorithm>
#include <stdexcept>

namespace bench::loss {

namespace {

bool is_of_nobody(const Picture& picture) {
    return std::ranges::any_of(picture.sums, [](const Sum& sum) { return sum.what == What::all; });
}

const Picture& nobody_of(const std::vector<Picture>& pictures, const Picture& of) {
    for (const Picture& one : pictures)
        if (is_of_nobody(one) && one.people == of.people && one.view == of.view) return one;
    throw std::runtime_error("found no picture of nobody of " + std::to_string(of.people) + " in " + of.view +
                             ", expected one a view");
}

}  // namespace

Measured::Measured(const std::vector<Picture>& pictures, sfsm::Drawing drawing) {
    for (const Picture& picture : pictures) {
        if (picture.drawing != drawing || is_of_nobody(picture)) continue;
        const Sum frame = picture.of(What::frame), around = picture.of(What::background);
        const bool is_native = drawing == sfsm::Drawing::native;
        all_.push_back({&picture, is_native ? &nobody_of(pictures, picture) : nullptr,
                        (frame.flip - (is_native ? 0 : around.flip)) / frame.pixels});
    }
}

double expected(const Picture& nobody, const render::native::BackdropErrors& errors) {
    const double sum = static_cast<double>(errors.all) * nobody.of(What::all).shown +
                       static_cast<double>(errors.ground) * nobody.of(What::ground).shown +
                       static_cast<double>(errors.unrest) * nobody.of(What::unrest).shown;
    return sum / nobody.of(What::all).pixels;
}

double expected(const Sum& sum, const figures::ExpectedError& error) {
    switch (sum.what) {
        case What::mesh:
            return sum.shown * error.of_mesh(sum.height);
        case What::points:
            return sum.shown * error.of_points(sum.spacing, sum.cell);
        case What::splats:
            return sum.shown * error.of_splat(sum.height) * error.times_in_cells(sum.cell);
        case What::motion:
            return sum.shown * error.motion_growth;
        default:
            return 0;
    }
}

double expected(const Measured::One& one, const figures::ExpectedError& error,
                const render::native::BackdropErrors& around) {
    double sum = one.nobody ? one.picture->of(What::background).shown * expected(*one.nobody, around) : 0;
    for (const Sum& part : one.picture->sums) sum += expected(part, error);
    return sum / one.picture->of(What::frame).pixels;
}

}  // namespace bench::loss
