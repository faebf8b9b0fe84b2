#include "tests/bench/million.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "render/native/renderer.h"
#include "scene/camera_path.h"
#include "tests/bench/fidelity.h"
#include "tests/bench/frame_errors.h"
#include "tests/bench/shooter.h"
#include "tests/bench/times.h"

namespace bench {

namespace {

constexpr std::int64_t few = 20'000, many = 1'000'000;

// The demo's stadium with so many people.
struct Place {
    std::unique_ptr<apps::Stage> stage;
    render::native::Renderer renderer;
    Shooter shooter;

    explicit Place(std::int64_t people)
        : stage(apps::build_stage({}, people, 1, apps::PointCache(apps::default_cache()), figures::natively())),
          renderer(stage->place.structure, stage->place.ground, stage->place.light, stage->figures(), frame_width,
                   frame_height),
          shooter(renderer, stage->place.crowd, *stage, figures::natively()) {}
};

Place& place_of(std::int64_t people) {
    static Place some(few);
    if (people == few) return some;
    static Place all(many);
    return all;
}

scene::CameraPose pose_of(Place& place, const std::string& camera) {
    if (camera == "wide") return scene::load_camera_path(GRANDSTAND_BENCH "/wide.json").at(0);
    return place.stage->place.cameras.named(camera).at(0);
}

// Frame after frame, of a camera that stands or that moves by a millimetre a frame, so that all is drawn anew.
class Shots {
public:
    Shots(Place& place, const scene::CameraPose& pose, double splat_size, bool moves)
        : place_(place), pose_(pose), splat_size_(splat_size), moves_(moves) {
        next();
    }
    void next() {
        ++tick_;
        scene::CameraPose pose = pose_;
        if (moves_) pose.position.y += 0.001 * static_cast<double>(tick_ % 2);
        place_.shooter.shoot(render::make_view(pose, frame_width, frame_height), points_of(splat_size_), tick_);
    }
    double timed() {
        const auto start = std::chrono::steady_clock::now();
        next();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }

private:
    Place& place_;
    scene::CameraPose pose_;
    double splat_size_;
    bool moves_;
    std::int64_t tick_ = 100;
};

void draw(benchmark::State& state, std::int64_t people, const std::string& camera, double splat_size, bool moves) {
    Place& place = place_of(people);
    Shots shots(place, pose_of(place, camera), splat_size, moves);
    for (auto _ : state) shots.next();
}

// Against everybody at full triangles, of 64 samples a pixel.
void show_errors(benchmark::State& state, const std::string& camera, double splat_size) {
    Place& place = place_of(many);
    const scene::CameraPose pose = pose_of(place, camera);
    constexpr std::int64_t tick = 100;
    const auto shoot = [&](int factor, const sfsm::Decision& decision) {
        return place.shooter.picture(render::make_view(pose, factor * frame_width, factor * frame_height), decision,
                                     tick);
    };
    Errors errors;
    double brightness = 0;
    for (auto _ : state) {
        const render::Image reference = box_filtered(shoot(reference_factor, triangles()), reference_factor);
        const render::Image drawn = shoot(1, points_of(splat_size));
        errors = errors_of(reference, drawn);
        const auto all = [](glm::dvec3 light) { return light.r + light.g + light.b; };
        brightness = all(mean_light(drawn)) / all(mean_light(reference)) - 1.0;
    }
    state.counters["flip"] = errors.flip;
    state.counters["psnr"] = errors.psnr;
    state.counters["ssim"] = errors.ssim;
    state.counters["brightness"] = brightness;
}

// Both crowds in turn, so that whatever else the machine does falls on both.
void compare(benchmark::State& state, const scene::CameraPose& pose_of_few, const scene::CameraPose& pose_of_many,
             double splat_size) {
    constexpr int frames = 60;
    Shots few_shots(place_of(few), pose_of_few, splat_size, true);
    Shots many_shots(place_of(many), pose_of_many, splat_size, true);
    std::vector<double> few_ms, many_ms;
    for (auto _ : state)
        for (int frame = 0; frame < frames; ++frame) {
            few_ms.push_back(few_shots.timed());
            many_ms.push_back(many_shots.timed());
        }
    state.counters["few_ms"] = median(few_ms);
    state.counters["many_ms"] = median(many_ms);
    state.counters["ratio"] = median(many_ms) / median(few_ms);
}

void compare_remote(benchmark::State& state) {
    compare(state, pose_of(place_of(few), "remote"), pose_of(place_of(many), "remote"), 2.0);
}

std::int64_t people_in_view(Place& place, const scene::CameraPose& pose) {
    const render::View view = render::make_view(pose, frame_width, frame_height);
    return place.shooter.choose(view, points_of(2), 100).work[sfsm::WorkKind::person];
}

// At the main stand, as narrow as shows so many.
scene::CameraPose view_of(Place& place, std::int64_t people) {
    scene::CameraPose pose = pose_of(place, "medium");
    double narrow = 0.001, wide = pose.fov_y;
    for (int i = 0; i < 30; ++i) {
        pose.fov_y = 0.5 * (narrow + wide);
        (people_in_view(place, pose) < people ? narrow : wide) = pose.fov_y;
    }
    return pose;
}

void compare_few_in_view(benchmark::State& state) {
    constexpr std::int64_t people = 500;
    const scene::CameraPose of_few = view_of(place_of(few), people), of_many = view_of(place_of(many), people);
    compare(state, of_few, of_many, 2.0);
    state.counters["few_in_view"] = static_cast<double>(people_in_view(place_of(few), of_few));
    state.counters["many_in_view"] = static_cast<double>(people_in_view(place_of(many), of_many));
}

}  // namespace

void register_million() {
    const auto timed = [](benchmark::internal::Benchmark* one) {
        one->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
    };
    for (const bool moves : {false, true}) {
        const std::string how = moves ? "moving" : "standing";
        timed(benchmark::RegisterBenchmark(("million/wide/S:1/" + how).c_str(), draw, many, "wide", 1.0, moves));
        for (const std::string camera : {"still", "close", "medium", "remote"})
            timed(benchmark::RegisterBenchmark(("million/" + camera + "/S:2/" + how).c_str(), draw, many, camera, 2.0,
                                               moves));
    }
    const auto once = [](benchmark::internal::Benchmark* one) { one->Iterations(1)->Unit(benchmark::kMillisecond); };
    once(benchmark::RegisterBenchmark("million/ratio/remote", compare_remote));
    once(benchmark::RegisterBenchmark("million/ratio/500_in_view", compare_few_in_view));
    once(benchmark::RegisterBenchmark("million/error/wide/S:1", show_errors, "wide", 1.0));
}

}  // namespace bench
