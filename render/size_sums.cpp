#include "render/size_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/size_sums.cpp"
#include <hwy/foreach_target.h>
// After it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, SizeSums::count> lanes;
constexpr hn::FixedTag<float, 4> four;
constexpr hn::RebindToSigned<decltype(four)> four_whole;

// Which of a bin's numbers a sum grows with.
constexpr SizeSums by_people{{1, 0, 0, 1, 1, 1}}, by_surface{{0, 1}},
    by_shown{{0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};

void SumUp(std::span<const SizeBin> bins, const SizeSums* weights, SizeSums* below) {
    for (std::size_t first = 0; first < SizeSums::count; first += hn::Lanes(lanes)) {
        const auto load = [&](const SizeSums& from) HWY_ATTR { return hn::Load(lanes, from.sums.data() + first); };
        const auto people = load(by_people), surface = load(by_surface), shown = load(by_shown);
        auto sums = hn::Zero(lanes);
        hn::Store(sums, lanes, below[0].sums.data() + first);
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const auto amount = hn::Add(hn::Add(hn::Mul(people, hn::Set(lanes, static_cast<float>(bins[i].people))),
                                                hn::Mul(surface, hn::Set(lanes, static_cast<float>(bins[i].surface)))),
                                        hn::Mul(shown, hn::Set(lanes, static_cast<float>(bins[i].shown))));
            sums = hn::Add(sums, hn::Mul(amount, load(weights[i])));
            hn::Store(sums, lanes, below[i + 1].sums.data() + first);
        }
    }
}

// Where a row's borders are: after an edge, by a share of the bin.
struct Places {
    alignas(16) std::array<std::int32_t, 4> edges;
    alignas(16) std::array<float, 4> shares;
};

Places places_of(const SizedRow& row, const SizeBorders& borders) {
    const auto after = hn::Sub(hn::Load(four, &borders.splats_to), hn::Set(four, row.first));
    const auto at = hn::Min(hn::Max(after, hn::Zero(four)), hn::Set(four, row.bins));
    const auto edges = hn::ConvertTo(four_whole, at);
    Places places;
    hn::Store(edges, four_whole, places.edges.data());
    hn::Store(hn::Sub(at, hn::ConvertTo(four, edges)), four, places.shares.data());
    return places;
}

void Divide(std::span<const SizedRow> rows, const SizeBorders* borders, SizeParts& parts) {
    std::array<Places, most_sized_rows> places;
    for (std::size_t i = 0; i < rows.size(); ++i) places[i] = places_of(rows[i], borders[rows[i].borders]);
    for (std::size_t first = 0; first < SizeSums::count; first += hn::Lanes(lanes)) {
        auto splats = hn::Zero(lanes), few = splats, spaced = splats, most = splats, meshes = splats;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const float* below = rows[i].below->sums.data() + first;
            const auto at = [&](std::size_t border) HWY_ATTR {
                const float* edge = below + SizeSums::count * static_cast<std::size_t>(places[i].edges[border]);
                const auto low = hn::Load(lanes, edge), high = hn::Load(lanes, edge + SizeSums::count);
                return hn::Add(low, hn::Mul(hn::Set(lanes, places[i].shares[border]), hn::Sub(high, low)));
            };
            const auto splats_to = at(0), few_to = at(1), most_from = at(2), meshes_from = at(3);
            const auto all = hn::Load(lanes, rows[i].all->sums.data() + first);
            splats = hn::Add(splats, splats_to);
            few = hn::Add(few, hn::Sub(few_to, splats_to));
            spaced = hn::Add(spaced, hn::Sub(most_from, few_to));
            most = hn::Add(most, hn::Sub(meshes_from, most_from));
            meshes = hn::Add(meshes, hn::Sub(all, meshes_from));
        }
        const auto store = [&](auto sums, SizeSums& to) HWY_ATTR { hn::Store(sums, lanes, to.sums.data() + first); };
        store(splats, parts.splats);
        store(few, parts.few);
        store(spaced, parts.spaced);
        store(most, parts.most);
        store(meshes, parts.meshes);
    }
}

}  // namespace
}  // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(SumUp);
HWY_EXPORT(Divide);

void sum_up(std::span<const SizeBin> bins, const SizeSums* weights, SizeSums* below) {
    HWY_DYNAMIC_DISPATCH(SumUp)(bins, weights, below);
}

SizeParts divide(std::span<const SizedRow> rows, const SizeBorders* borders) {
    SizeParts parts;
    HWY_DYNAMIC_DISPATCH(Divide)(rows, borders, parts);
    return parts;
}

}  // namespace render

#endif
