// What making a point model costs: the scan of 87,120 triangles unless it says otherwise. All but the hidden test on
// one thread. peak_mb is of the whole process so far, so it means something for a benchmark that is run alone.
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include "pointsample/candidates.h"
#include "pointsample/hidden.h"
#include "pointsample/sample.h"
#include "pointsample/surface_line.h"
#include "pointsample/uniform.h"
#include "tests/pointsample/surfaces.h"

namespace {

using pointsample::Order;

const model::Mesh& scan() {
    static const model::Mesh mesh = tests::make_scan();
    return mesh;
}

const pointsample::PosedMesh& scan_at_rest() {
    static const pointsample::PosedMesh pose{scan().positions, scan().normals};
    return pose;
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts KiB
}

void report(benchmark::State& state, std::size_t items) {
    state.SetItemsProcessed(static_cast<std::int64_t>(items) * state.iterations());
    state.counters["peak_mb"] = peak_megabytes();
}

void sample(benchmark::State& state, Order order, bool visible_only) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const std::size_t count = static_cast<std::size_t>(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(
            pointsample::sample(scan(), {&scan_at_rest(), 1}, {count, 1, order, visible_only}).positions.data());
    report(state, count);
}

void Progressive(benchmark::State& state) {
    sample(state, Order::progressive, false);
}
void ProgressiveVisible(benchmark::State& state) {
    sample(state, Order::progressive, true);
}
void Even(benchmark::State& state) {
    sample(state, Order::even, false);
}
void Uniform(benchmark::State& state) {
    sample(state, Order::uniform, false);
}
BENCHMARK(Progressive)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(ProgressiveVisible)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(Even)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(Uniform)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

// Independent points' places alone, as others' samplers are timed.
void UniformPlaces(benchmark::State& state) {
    const pointsample::Surface surface(scan().indices, {&scan_at_rest(), 1});
    const pointsample::AliasTable table(surface);
    const std::size_t count = static_cast<std::size_t>(state.range(0));
    std::vector<glm::vec3> places(count);
    for (auto _ : state) {
        for (std::size_t i = 0; i < count; ++i) {
            const motion::SurfacePoint point = table.draw(1, i);
            const std::uint32_t* corner = &scan().indices[std::size_t{3} * point.triangle];
            const glm::vec3 a = scan().positions[corner[0]];
            places[i] = a + point.u * (scan().positions[corner[1]] - a) + point.v * (scan().positions[corner[2]] - a);
        }
        benchmark::ClobberMemory();
    }
    report(state, count);
}
BENCHMARK(UniformPlaces)->Arg(1000000)->Unit(benchmark::kMillisecond);

pointsample::Candidates candidates_of(const pointsample::Surface& surface, std::size_t count) {
    const std::vector<std::uint32_t> line = pointsample::order_along_line(surface);
    pointsample::Candidates candidates;
    pointsample::Stratifier(surface, line, count, 1).append(count, candidates);
    candidates.pad();
    return candidates;
}

void CandidatesAlone(benchmark::State& state) {
    const pointsample::Surface surface(scan().indices, {&scan_at_rest(), 1});
    const std::size_t count = static_cast<std::size_t>(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(candidates_of(surface, count).leaves.data());
    report(state, count);
}
BENCHMARK(CandidatesAlone)->Arg(1600000)->Unit(benchmark::kMillisecond);

// Without the build of the ray-tracing scene. Nothing of the scan is hidden; of nested balls a fifth is.
void look(benchmark::State& state, const model::Mesh& mesh) {
    const tbb::global_control two_threads(tbb::global_control::max_allowed_parallelism, 2);
    const pointsample::PosedMesh pose{mesh.positions, mesh.normals};
    const pointsample::Surface surface(mesh.indices, {&pose, 1});
    constexpr std::size_t count = 100000;
    const pointsample::Candidates candidates = candidates_of(surface, count);
    const pointsample::Visibility visibility(mesh.positions, mesh.indices);
    std::vector<pointsample::Place> places;
    for (std::size_t i = 0; i < count; ++i)
        places.push_back(pointsample::place_of(candidates.surface[i], mesh.indices, pose));
    for (auto _ : state) benchmark::DoNotOptimize(visibility.look(places, false).data());
    report(state, count);
}

void HiddenTestOfScan(benchmark::State& state) {
    look(state, scan());
}
void HiddenTestOfNestedBalls(benchmark::State& state) {
    model::Mesh nested = tests::make_ball(), inner = tests::make_ball();
    const std::uint32_t first = static_cast<std::uint32_t>(nested.positions.size());
    for (const glm::vec3& p : inner.positions) nested.positions.push_back(0.5f * p);
    nested.normals.insert(nested.normals.end(), inner.normals.begin(), inner.normals.end());
    for (const std::uint32_t i : inner.indices) nested.indices.push_back(first + i);
    look(state, nested);
}
BENCHMARK(HiddenTestOfScan)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(HiddenTestOfNestedBalls)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
