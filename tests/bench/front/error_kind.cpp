#include "tests/bench/front/error_kind.h"

#include <array>
#include <cmath>

#include "sfsm/report/markup.h"

namespace bench::front {
namespace {

constexpr std::array kinds = {
    ErrorKind{"flip", "FLIP", "", "how different the whole frame looks to an eye, 0 to 1", 4, false,
              [](const Row& row) { return row.frame.flip; }},
    ErrorKind{"crowd", "Crowd FLIP", "", "FLIP of the crowd's pixels alone", 4, false,
              [](const Row& row) { return row.crowd.flip; }},
    ErrorKind{"ssim", "1\u2212SSIM", "", "structure of the luma that is lost", 4, false,
              [](const Row& row) { return 1 - row.frame.ssim; }},
    ErrorKind{"psnr", "PSNR", "dB", "mean square difference; more is better, so it grows downwards", 2, true,
              [](const Row& row) { return row.frame.psnr; }},
    ErrorKind{"change", "Change", "of 255", "flicker: what changes from frame to frame and should not", 3, false,
              [](const Row& row) { return row.change; }},
    ErrorKind{"motion", "Motion", "px", "people's surfaces from where they should be by now, mean over people", 3,
              false, [](const Row& row) { return row.motion_px; }},
    ErrorKind{"outline", "Outline", "px", "people's outlines from where they should be, mean over people", 3, false,
              [](const Row& row) { return row.outline_px; }},
};

}  // namespace

double ErrorKind::height(const Row& row) const {
    return more_is_better ? -value(row) : std::log10(value(row) < 0 ? 0 : value(row));
}

std::string ErrorKind::figure(double of) const {
    return sfsm::report::figure(of, digits);
}

std::string ErrorKind::told(double of) const {
    return std::string(name) + " " + figure(of) + (unit.empty() ? "" : " " + std::string(unit));
}

std::span<const ErrorKind> error_kinds() {
    return kinds;
}

}  // namespace bench::front
