// Survey and selection of the demo's crowd at 1280x720, people moving, the camera still. Benchmarks are named by people
// and camera; `wide` has everybody in view. Counters: milliseconds of the process' threads together, a call.
#include <benchmark/benchmark.h>

#include <ctime>
#include <memory>
#include <string>

#include "apps/stage.h"
#include "render/native/renderer.h"
#include "render/select.h"

namespace {

constexpr int width = 1280, height = 720;  // [px]
constexpr double splat_size = 2;           // [px]

double process_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Scene {
    std::unique_ptr<apps::Stage> stage;
    render::native::Renderer renderer;
    render::Selector selector;

    explicit Scene(std::int64_t people)
        : stage(apps::build_stage({}, people, 1, apps::PointCache(apps::default_cache()), figures::natively())),
          renderer(stage->place.structure, stage->place.ground, stage->place.light, stage->figures(), width, height),
          selector(stage->place.crowd, stage->cast, stage->figures(), {.way = &figures::natively()}) {}
};

// One at a time: a million people are large.
Scene& scene_of(std::int64_t people) {
    static std::int64_t made = 0;
    static std::unique_ptr<Scene> scene;
    if (made != people) {
        scene.reset();
        scene = std::make_unique<Scene>(people);
        made = people;
    }
    return *scene;
}

scene::CameraPose pose_of(const Scene& scene, const std::string& camera) {
    if (camera == "wide") return scene::load_camera_path(GRANDSTAND_BENCH "/wide.json").at(0);
    return scene.stage->place.cameras.named(camera).at(0);
}

void choose(benchmark::State& state, std::int64_t people, const std::string& camera) {
    Scene& scene = scene_of(people);
    const render::View view = render::make_view(pose_of(scene, camera), width, height);
    const render::Surroundings around = scene.renderer.begin(view);
    const sfsm::Decision decision{sfsm::State::points, 1e9, splat_size};
    double survey_ms = 0, select_ms = 0;
    std::int64_t tick = 100;
    std::size_t listed = 0;
    scene.selector.survey(view, tick, around);
    scene.selector.select(decision, tick - 1);
    std::int64_t visible = 0, hidden = 0;
    for (auto _ : state) {
        ++tick;
        const double start = process_ms();
        const render::Survey& survey = scene.selector.survey(view, tick, around);
        const double surveyed = process_ms();
        listed = scene.selector.select(decision, tick - 1).people.size();
        visible = survey.forecast.frame[sfsm::WorkKind::person];
        hidden = survey.hidden;
        survey_ms += surveyed - start;
        select_ms += process_ms() - surveyed;
    }
    const auto calls = static_cast<double>(state.iterations());
    state.counters["survey_ms"] = survey_ms / calls;
    state.counters["select_ms"] = select_ms / calls;
    state.counters["visible"] = static_cast<double>(visible);
    state.counters["hidden"] = static_cast<double>(hidden);
    state.counters["listed"] = static_cast<double>(listed);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    for (const std::int64_t people : {20'000, 1'000'000})
        for (const std::string camera : {"still", "medium", "remote", "wide"})
            benchmark::RegisterBenchmark((std::to_string(people) + "/" + camera).c_str(),
                                         [=](benchmark::State& state) { choose(state, people, camera); })
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
