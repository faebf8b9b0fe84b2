// What it takes to solve for all rates, by number of characters: a million people in view, the nearest of them one by
// one and the others in blocks that may be drawn as one.
#include <benchmark/benchmark.h>

#include <vector>

#include "sfsm/random.h"
#include "tests/render/troupe.h"

namespace {

using render::Exchange;
using render::RateForecaster;

constexpr std::int64_t people = 1'000'000, block = 250, alone = 20'000;

struct Crowd : tests::Troupe {
    std::vector<RateForecaster::Group> groups;

    explicit Crowd(std::size_t count) : Troupe(count, 1300, 4096) {
        for (std::int64_t i = 0; i < alone; ++i) groups.push_back(group(static_cast<std::uint64_t>(i), 1, 5, 120));
        for (std::int64_t i = 0; i < (people - alone) / block; ++i)
            for (std::size_t kind = 0; kind < count; ++kind)
                groups.push_back(
                    group(static_cast<std::uint64_t>(i), block / static_cast<std::int64_t>(count), 120, 500));
    }

    // At some depth [m] between two.
    RateForecaster::Group group(std::uint64_t number, std::int64_t size, float nearest, float farthest) const {
        const std::uint64_t bits = sfsm::hash(number, static_cast<std::uint64_t>(size));
        const float depth = nearest + (farthest - nearest) * sfsm::upper_unit(bits);
        const float pixels = view.pixels_per_metre(depth), share = 0.25f + 0.5f * sfsm::lower_unit(bits);
        return {.kind = groups.size() % characters.size(),
                .people = size,
                .is_block = size > 1,
                .depth = depth,
                .pixels_per_metre = pixels,
                .surface = 1.9f * pixels * pixels,
                .share = share,
                .place = Exchange::place_of(share)};
    }
    void add() {
        forecaster.begin(view, {});
        for (const RateForecaster::Group& one : groups) forecaster.add(one);
    }
};

// As items: groups.
void add(benchmark::State& state) {
    Crowd crowd(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) crowd.add();
    state.SetItemsProcessed(state.iterations() * std::ssize(crowd.groups));
}

void finish(benchmark::State& state) {
    Crowd crowd(static_cast<std::size_t>(state.range(0)));
    crowd.add();
    for (auto _ : state) benchmark::DoNotOptimize(crowd.forecaster.finish());
}

void find_paces(benchmark::State& state) {
    Crowd crowd(static_cast<std::size_t>(state.range(0)));
    crowd.add();
    crowd.forecaster.finish();
    render::Paces paces;
    for (auto _ : state) crowd.forecaster.find_paces(0.3, paces);
}

BENCHMARK(add)->Arg(1)->Arg(64)->Unit(benchmark::kMicrosecond);
BENCHMARK(finish)->Arg(1)->Arg(64)->Unit(benchmark::kMicrosecond);
BENCHMARK(find_paces)->Arg(1)->Arg(64)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
