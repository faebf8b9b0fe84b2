#include "tests/bench/loss/fit.h"

#include <array>
#include <cmath>
#include <span>

#include "tests/bench/loss/least_squares.h"

namespace bench::loss {

namespace {

using figures::ExpectedError;
using render::native::BackdropErrors;

// All but motion_most, which stays as far from motion_growth as it is: where surfaces are off by so much nobody looks.
constexpr std::array constants = {&ExpectedError::finest,     &ExpectedError::growth,       &ExpectedError::power,
                                  &ExpectedError::blur,       &ExpectedError::hole,         &ExpectedError::filling,
                                  &ExpectedError::mesh,       &ExpectedError::mesh_height,  &ExpectedError::mesh_power,
                                  &ExpectedError::splat,      &ExpectedError::splat_growth, &ExpectedError::splat_blur,
                                  &ExpectedError::splat_most, &ExpectedError::motion_growth};

constexpr std::array around_constants = {&BackdropErrors::all, &BackdropErrors::ground, &BackdropErrors::unrest};

// Of fewer pixels it is chance who is in front.
constexpr double fewest_pixels = 300;

// By classes: what their pixels lose, in the shares of a frame's error that they have.
void add_residuals(const Measured::One& one, const ExpectedError& error, std::vector<double>& out) {
    const double all = one.picture->of(What::frame).flip;
    for (Sum sum : one.picture->sums) {
        if (sum.what > What::splats || sum.pixels < fewest_pixels || sum.shown < fewest_pixels) continue;
        sum.shown = sum.pixels;
        out.push_back(std::sqrt(sum.flip / all) * std::log(expected(sum, error) / sum.flip));
    }
}

// All that people lose so many times as large: more pixels show somebody than their silhouettes have, as each that they
// touch does.
ExpectedError times(ExpectedError error, double factor) {
    for (const auto constant : {&ExpectedError::finest, &ExpectedError::growth, &ExpectedError::hole,
                                &ExpectedError::mesh, &ExpectedError::splat, &ExpectedError::splat_growth,
                                &ExpectedError::splat_most, &ExpectedError::motion_growth, &ExpectedError::motion_most})
        error.*constant *= factor;
    return error;
}

}  // namespace

BackdropErrors fit_backdrop(const std::vector<Picture>& pictures) {
    const auto errors_of = [](std::span<const double> at) {
        BackdropErrors errors;
        for (std::size_t i = 0; i < around_constants.size(); ++i)
            errors.*around_constants[i] = static_cast<float>(at[i]);
        return errors;
    };
    const auto residuals = [&](std::span<const double> at) {
        std::vector<double> out;
        for (const Picture& picture : pictures) {
            const Sum all = picture.of(What::all);
            if (!picture.is_fitted || !(all.pixels > 0)) continue;
            out.push_back(expected(picture, errors_of(at)) / (all.flip / all.pixels) - 1);
        }
        return out;
    };
    const BackdropErrors start;
    return errors_of(least_squares({start.all, start.ground, start.unrest}, residuals));
}

ExpectedError fit_people(const Measured& measured, const BackdropErrors& around, const ExpectedError& start,
                         Motion motion) {
    std::vector<double ExpectedError::*> free;
    std::vector<double> at;
    for (const auto constant : constants)
        if (start.*constant > 0 && (constant != &ExpectedError::motion_growth || motion == Motion::fitted))
            free.push_back(constant), at.push_back(start.*constant);
    const auto error_of = [&](std::span<const double> values) {
        ExpectedError error = start;
        for (std::size_t i = 0; i < free.size(); ++i) error.*free[i] = values[i];
        error.motion_most = start.motion_most / start.motion_growth * error.motion_growth;
        return error;
    };
    const auto residuals = [&](std::span<const double> values) {
        std::vector<double> out;
        for (const Measured::One& one : measured.all())
            if (one.picture->is_fitted) add_residuals(one, error_of(values), out);
        return out;
    };
    const ExpectedError shape = error_of(least_squares(at, residuals));
    const auto of_frames = [&](std::span<const double> factor) {
        std::vector<double> out;
        for (const Measured::One& one : measured.all())
            if (one.picture->is_fitted)
                out.push_back(std::log(expected(one, times(shape, factor[0]), around) / one.flip));
        return out;
    };
    return times(shape, least_squares({1.0}, of_frames)[0]);
}

}  // namespace bench::loss
