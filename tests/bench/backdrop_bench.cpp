// The native background of 20,000 people's stadium, whole pictures at 1280x720, camera after camera.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/parallel_for.h>

#include "render/native/backdrop.h"
#include "scene/places/stadium.h"
#include "tests/native/painting.h"

namespace {

struct Stadium {
    scene::StadiumPlan plan = scene::plan_stadium(20000);
    scene::Cameras cameras = scene::aim_cameras(plan);
    render::native::Backdrop backdrop{scene::build_structure(plan), scene::paint_ground(plan), scene::Light{}};
};

Stadium& stadium() {
    static Stadium one;
    return one;
}

void paint(benchmark::State& state, scene::CameraPath scene::Cameras::*camera) {
    constexpr int width = 1280, height = 720;
    render::native::Backdrop& backdrop = stadium().backdrop;
    const scene::CameraPath& path = stadium().cameras.*camera;
    render::native::BackdropPicture picture = tests::empty_picture(width, height);
    const std::vector<render::native::Tile> tiles = tests::tiles_of(width, height, render::native::tile_side);
    double time = 0;  // [s]
    for (auto _ : state) {
        backdrop.aim(render::make_view(path.at(time), width, height));
        oneapi::tbb::parallel_for(std::size_t{0}, tiles.size(),
                                  [&](std::size_t i) { backdrop.paint(tiles[i], picture); });
        time += 0.37;
    }
    state.SetItemsProcessed(state.iterations() * width * height);
}

BENCHMARK_CAPTURE(paint, still, &scene::Cameras::still)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, close, &scene::Cameras::close)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, medium, &scene::Cameras::medium)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, remote, &scene::Cameras::remote)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, roam, &scene::Cameras::roam)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
