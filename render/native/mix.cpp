#include "render/native/mix.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/native/mix.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render::native::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void Mix(const std::array<const std::uint16_t*, mixed_rows>& rows, const std::array<float, mixed_rows>& weights,
         std::array<float, mixed_values>& out) {
    const hn::CappedTag<float, mixed_values> floats;
    const hn::Rebind<std::int32_t, decltype(floats)> ints;
    const hn::Rebind<std::uint16_t, decltype(floats)> shorts;
    for (int i = 0; i < mixed_values; i += static_cast<int>(hn::Lanes(floats))) {
        auto sum = hn::Zero(floats);
        for (int row = 0; row < mixed_rows; ++row) {
            const auto values = hn::ConvertTo(floats, hn::PromoteTo(ints, hn::LoadU(shorts, rows[row] + i)));
            sum = hn::Add(sum, hn::Mul(hn::Set(floats, weights[row]), values));
        }
        hn::StoreU(sum, floats, &out[i]);
    }
}

}  // namespace render::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render::native {

HWY_EXPORT(Mix);

void mix(const std::array<const std::uint16_t*, mixed_rows>& rows, const std::array<float, mixed_rows>& weights,
         std::array<float, mixed_values>& out) {
    HWY_DYNAMIC_DISPATCH(Mix)(rows, weights, out);
}

}  // namespace render::native

#endif
