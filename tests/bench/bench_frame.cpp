// Whole frames of the demo's stadium, 20,000 people at 1280x720: full triangles by OpenGL beside the native renderer,
// how good their pictures are, and what a piece of work costs; and of a million. docs/measurements/native.md says how
// to read it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/bench/frame_change.h"
#include "tests/bench/frame_errors.h"
#include "tests/bench/million.h"
#include "tests/bench/shooter.h"
#include "tests/bench/stand_light.h"
#include "tests/bench/times.h"

namespace {

using bench::median;
using bench::Shooter;
using bench::stadium;
using bench::Times;

constexpr const char* shot_presets[] = {"still", "close", "medium", "remote"};

// Frame after frame of a camera that stands still or is nudged by a millimetre a frame, so that the native background
// is painted anew.
class Film {
public:
    enum class Camera { stands, moves };

    struct Size {
        int width, height;  // [px]
    };
    static constexpr Size usual{bench::frame_width, bench::frame_height};

    Film(const std::string& preset, Camera camera, sfsm::Decision decision, Size size = usual)
        : pose_(bench::preset(preset)), camera_(camera), decision_(decision), size_(size) {}

    const render::Frame& shoot(Shooter& shooter) { return shooter.shoot(next_view(), decision_, tick_); }
    const render::Frame& choose(Shooter& shooter) { return shooter.choose(next_view(), decision_, tick_); }

    // Nobody is there to move: another S has the picture composed again all the same.
    const render::Frame& shoot_emptiness(Shooter& shooter) {
        const render::View view = next_view();
        return shooter.shoot(view, bench::points_of(tick_ % 2 == 0 ? 1.0 : 1.1), tick_);
    }

private:
    render::View next_view() {
        constexpr double nudge = 0.001;  // [m]
        ++tick_;
        scene::CameraPose pose = pose_;
        if (camera_ == Camera::moves) pose.position.y += nudge * static_cast<double>(tick_ % 2);
        return render::make_view(pose, size_.width, size_.height);
    }

    scene::CameraPose pose_;
    Camera camera_;
    sfsm::Decision decision_;
    Size size_;
    std::int64_t tick_ = 100;
};

void set_sizes() {
    stadium().native_renderer.resize(bench::frame_width, bench::frame_height);
    stadium().gl_renderer.resize(bench::frame_width, bench::frame_height);
}

// --- whole frames ----------------------------------------------------------------------------------------------------

void report_decision(benchmark::State& state, const std::string& preset) {
    const bench::PresetErrors& errors = bench::errors_of_preset(preset);
    const bench::Errors& native = errors.native[errors.chosen()];
    state.counters["S_px"] = errors.splat_size();
    state.counters["no_more_error"] = errors.met();
    state.counters["flip_native"] = native.flip;
    state.counters["flip_triangles"] = errors.triangles.flip;
    state.counters["psnr_native"] = native.psnr;
    state.counters["psnr_triangles"] = errors.triangles.psnr;
    state.counters["ssim_native"] = native.ssim;
    state.counters["ssim_triangles"] = errors.triangles.ssim;
    char text[80];
    std::snprintf(text, sizeof text, "S = %.3g px%s%s", errors.splat_size(),
                  errors.splat_size() > 0 ? "" : " (triangles)", errors.met() ? "" : ", more error than triangles");
    state.SetLabel(text);
}

void draw_natively(benchmark::State& state, const std::string& preset, Film::Camera camera) {
    Film film(preset, camera, bench::points_of(bench::errors_of_preset(preset).splat_size()));
    set_sizes();
    film.shoot(stadium().native);
    for (auto _ : state) film.shoot(stadium().native);
    report_decision(state, preset);
}

void draw_triangles(benchmark::State& state, const std::string& preset) {
    Film film(preset, Film::Camera::stands, bench::triangles());
    set_sizes();
    film.shoot(stadium().gl);
    for (auto _ : state) film.shoot(stadium().gl);
}

void draw_nobody(benchmark::State& state, Film::Camera camera) {
    Film film("still", camera, {});
    set_sizes();
    film.shoot_emptiness(stadium().native_nobody);
    for (auto _ : state) film.shoot_emptiness(stadium().native_nobody);
}

// 8K, where pixels are the trouble. `preset` empty: nobody in view.
void draw_8k(benchmark::State& state, const std::string& preset, Film::Camera camera) {
    constexpr Film::Size size{7680, 4320};
    constexpr double splat_size = 4;  // [px]
    Film film(preset.empty() ? "still" : preset, camera, bench::points_of(splat_size), size);
    stadium().native_renderer.resize(size.width, size.height);
    const auto shoot = [&] {
        if (preset.empty())
            film.shoot_emptiness(stadium().native_nobody);
        else
            film.shoot(stadium().native);
    };
    shoot();
    for (auto _ : state) shoot();
    state.SetItemsProcessed(state.iterations() * size.width * size.height);
    set_sizes();
}

// Both sides in turn, so that whatever else the machine does falls on both. The crowd: a frame with everybody less one
// with nobody, whose picture is composed each time, too.
void compare(benchmark::State& state, const std::string& preset) {
    constexpr int rounds = 4, native_frames = 15;
    Film triangles(preset, Film::Camera::stands, bench::triangles());
    Film points(preset, Film::Camera::stands, bench::points_of(bench::errors_of_preset(preset).splat_size()));
    bench::Shooting& here = stadium();
    set_sizes();
    triangles.shoot(here.gl);
    triangles.shoot(here.gl_nobody);
    points.shoot(here.native);
    Times gl, gl_nobody, native, native_nobody;
    for (auto _ : state) {
        for (int round = 0; round < rounds; ++round) {
            gl.take([&] { triangles.shoot(here.gl); });
            for (int frame = 0; frame < native_frames; ++frame) {
                native.take([&] { points.shoot(here.native); });
                native_nobody.take([&] { points.shoot_emptiness(here.native_nobody); });
            }
            for (int frame = 0; frame < 3; ++frame) gl_nobody.take([&] { triangles.shoot(here.gl_nobody); });
        }
    }
    const double gl_crowd = median(gl.process) - median(gl_nobody.process);
    const double native_crowd = median(native.process) - median(native_nobody.process);
    state.counters["crowd_ratio_process"] = gl_crowd / native_crowd;
    state.counters["crowd_ratio_process_kept"] = gl_crowd / median(native.process);  // nobody costs nothing
    state.counters["frame_ratio_wall"] = median(gl.wall) / median(native.wall);
    state.counters["gl_wall_ms"] = median(gl.wall);
    state.counters["gl_process_ms"] = median(gl.process);
    state.counters["gl_nobody_wall_ms"] = median(gl_nobody.wall);
    state.counters["gl_nobody_process_ms"] = median(gl_nobody.process);
    state.counters["native_wall_ms"] = median(native.wall);
    state.counters["native_process_ms"] = median(native.process);
    state.counters["native_nobody_wall_ms"] = median(native_nobody.wall);
    state.counters["native_nobody_process_ms"] = median(native_nobody.process);
    report_decision(state, preset);
}

// How much a frame's time varies though its work doesn't: two frames, drawn in turn, each against its own median. The
// bound on how many frames any law can hold.
void vary(benchmark::State& state, const std::string& preset) {
    constexpr std::size_t rounds = 600, kinds = 2;
    constexpr double near_enough = 1.05, percentile = 0.97;
    bench::Shooting& here = stadium();
    set_sizes();
    Film film(preset, Film::Camera::moves, bench::points_of(1));
    const render::Frame frames[kinds] = {film.choose(here.native), film.choose(here.native)};
    Times times[kinds];
    for (auto _ : state)
        for (std::size_t i = 0; i < kinds * rounds; ++i)
            times[i % kinds].take([&] {
                here.native_renderer.begin(frames[i % kinds].view);
                here.native.draw(frames[i % kinds]);
            });
    std::vector<double> ratios;
    for (const Times& of : times)
        for (const double ms : of.wall) ratios.push_back(ms / median(of.wall));
    std::sort(ratios.begin(), ratios.end());
    const auto over = std::upper_bound(ratios.begin(), ratios.end(), near_enough);
    const auto count = static_cast<double>(ratios.size());
    state.counters["median_ms"] = median(times[0].wall);
    state.counters["over_by_5_percent"] = static_cast<double>(ratios.end() - over) / count;
    state.counters["percentile_97"] = ratios[static_cast<std::size_t>(percentile * count)];
    state.counters["worst"] = ratios.back();
}

// --- the price of a piece --------------------------------------------------------------------------------------------

// Draws again and again the people of one representation that `decision` shows, or all of them, less the time of a
// frame without them. A piece: of what is counted as `kind`.
void price(benchmark::State& state, const std::string& preset, const sfsm::Decision& decision, sfsm::WorkKind kind,
           bool meshes) {
    constexpr int poses = 8, rounds = 12;
    bench::Shooting& here = stadium();
    set_sizes();
    Film film(preset, Film::Camera::stands, decision);
    std::vector<render::Frame> frames;
    double pieces = 0;
    const auto& way = figures::natively();
    for (int i = 0; i < poses; ++i) {
        render::Frame frame = film.choose(here.native);
        std::erase_if(frame.people, [&](const render::Person& person) {
            return way.representations[person.representation].is_mesh != meshes;
        });
        for (const render::Person& person : frame.people)
            pieces += meshes ? person.count / 3.0 / poses : static_cast<double>(person.count) / poses;
        frames.push_back(std::move(frame));
    }
    render::Frame nobody = frames[0];
    nobody.people.clear();
    Times with, without;
    for (auto _ : state)
        for (int round = 0; round < rounds; ++round)
            for (const render::Frame& frame : frames) {
                with.take([&] { here.native.draw(frame); });
                without.take([&] { here.native.draw(nobody); });
            }
    constexpr double ns_a_ms = 1e6;
    state.counters["people"] = static_cast<double>(frames[0].people.size());
    state.counters["pieces"] = pieces;
    state.counters["wall_ns"] = ns_a_ms * (median(with.wall) - median(without.wall)) / pieces;
    state.counters["process_ns"] = ns_a_ms * (median(with.process) - median(without.process)) / pieces;
    state.SetLabel(std::string("a ") + std::string(sfsm::entry_of(kind).name));
}

// --- accuracy --------------------------------------------------------------------------------------------------------

void show_errors(benchmark::State& state, const std::string& preset,
                 const std::function<bench::Errors(const bench::PresetErrors&)>& part) {
    bench::Errors errors;
    for (auto _ : state) errors = part(bench::errors_of_preset(preset));
    state.counters["flip"] = errors.flip;
    state.counters["psnr"] = errors.psnr;
    state.counters["ssim"] = errors.ssim;
}

void show_light(benchmark::State& state, std::size_t elevation, std::size_t height, std::size_t splat_size) {
    const bench::LightError& error = bench::light_error(elevation, height, splat_size);
    for (auto _ : state) benchmark::DoNotOptimize(error);
    state.counters["brightness"] = error.brightness;
    state.counters["red"] = error.channels.r;
    state.counters["green"] = error.channels.g;
    state.counters["blue"] = error.channels.b;
    state.counters["coverage"] = error.coverage;
    state.counters["triangles"] = bench::share_of_triangles(elevation, height, splat_size);
}

void sum_up_light(benchmark::State& state) {
    std::vector<double> brightness, channels, coverage;
    for (auto _ : state)
        for (std::size_t e = 0; e < std::size(bench::stand_elevations); ++e)
            for (std::size_t h = 0; h < std::size(bench::stand_heights); ++h)
                for (std::size_t s = 1; s < std::size(bench::stand_splat_sizes); ++s) {
                    const bench::LightError& error = bench::light_error(e, h, s);
                    brightness.push_back(std::abs(error.brightness));
                    for (int c = 0; c < 3; ++c) channels.push_back(std::abs(error.channels[c]));
                    coverage.push_back(std::abs(error.coverage));
                }
    state.counters["brightness_worst"] = *std::ranges::max_element(brightness);
    state.counters["brightness_median"] = median(brightness);
    state.counters["channel_worst"] = *std::ranges::max_element(channels);
    state.counters["channel_median"] = median(channels);
    state.counters["coverage_worst"] = *std::ranges::max_element(coverage);
    state.counters["coverage_median"] = median(coverage);
}

template <typename Follow>
void show_change(benchmark::State& state, Follow follow) {
    bench::Change change;
    for (auto _ : state) change = follow();
    state.counters["reference"] = change.reference;
    state.counters["triangles"] = change.triangles;
    state.counters["triangles_worst"] = change.worst_triangles;
    for (std::size_t i = 0; i < std::size(bench::change_splat_sizes); ++i) {
        char size[16];
        std::snprintf(size, sizeof size, "S%.3g", bench::change_splat_sizes[i]);
        state.counters[std::string("native_") + size] = change.native[i];
        state.counters[std::string("worst_") + size] = change.worst[i];
        state.counters[std::string("worst_frame_") + size] = change.worst_frame[i];
        state.counters[std::string("ratio_") + size] = change.native[i] / change.triangles;
    }
}

// --- the list --------------------------------------------------------------------------------------------------------

std::string with_size(const char* text, double value) {
    char out[64];
    std::snprintf(out, sizeof out, "%s%.3g", text, value);
    return out;
}

void register_frames() {
    constexpr int gl_frames = 3;
    const auto timed = [](benchmark::internal::Benchmark* one) {
        return one->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
    };
    for (const std::string preset : shot_presets) {
        timed(benchmark::RegisterBenchmark(("frame/" + preset + "/gl_triangles").c_str(), draw_triangles, preset))
            ->Iterations(gl_frames);
        timed(benchmark::RegisterBenchmark(("frame/" + preset + "/native_standing").c_str(), draw_natively, preset,
                                           Film::Camera::stands));
        timed(benchmark::RegisterBenchmark(("frame/" + preset + "/native_moving").c_str(), draw_natively, preset,
                                           Film::Camera::moves));
        timed(benchmark::RegisterBenchmark(("ratio/" + preset).c_str(), compare, preset))->Iterations(1);
    }
    for (const char* preset : {"still", "medium"})
        timed(benchmark::RegisterBenchmark((std::string("noise/") + preset).c_str(), vary, preset))->Iterations(1);
    timed(benchmark::RegisterBenchmark("nobody/standing", draw_nobody, Film::Camera::stands));
    timed(benchmark::RegisterBenchmark("nobody/moving", draw_nobody, Film::Camera::moves));
    timed(benchmark::RegisterBenchmark("8k/nobody_standing", draw_8k, "", Film::Camera::stands));
    timed(benchmark::RegisterBenchmark("8k/nobody_moving", draw_8k, "", Film::Camera::moves));
    for (const std::string preset : shot_presets)
        timed(benchmark::RegisterBenchmark(("8k/" + preset + "_moving").c_str(), draw_8k, preset, Film::Camera::moves));
}

void register_prices() {
    const auto add = [](const char* name, const char* preset, const sfsm::Decision& decision, sfsm::WorkKind kind) {
        benchmark::RegisterBenchmark(name, price, preset, decision, kind, kind == sfsm::WorkKind::triangle)
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    };
    add("price/triangle/close/near_people", "close", bench::points_of(1), sfsm::WorkKind::triangle);
    add("price/triangle/close/everybody", "close", bench::triangles(), sfsm::WorkKind::triangle);
    add("price/point/medium", "medium", bench::points_of(1), sfsm::WorkKind::point);
}

void register_accuracy() {
    const auto once = [](benchmark::internal::Benchmark* one) { one->Iterations(1)->Unit(benchmark::kMillisecond); };
    for (const std::string preset : shot_presets) {
        const auto add = [&](const std::string& name, std::function<bench::Errors(const bench::PresetErrors&)> part) {
            once(benchmark::RegisterBenchmark(("error/" + preset + "/" + name).c_str(), show_errors, preset, part));
        };
        add("gl_triangles", [](const bench::PresetErrors& errors) { return errors.triangles; });
        for (std::size_t i = 0; i < std::size(bench::tried_splat_sizes); ++i)
            add(with_size("native/S:", bench::tried_splat_sizes[i]),
                [i](const bench::PresetErrors& errors) { return errors.native[i]; });
        add("nobody/gl", [](const bench::PresetErrors& errors) { return errors.triangles_nobody; });
        add("nobody/native", [](const bench::PresetErrors& errors) { return errors.native_nobody; });
    }
    constexpr const char* angles[] = {"front", "above"};
    static_assert(std::size(angles) == std::size(bench::stand_elevations));
    for (std::size_t e = 0; e < std::size(angles); ++e)
        for (std::size_t h = 0; h < std::size(bench::stand_heights); ++h)
            for (std::size_t s = 0; s < std::size(bench::stand_splat_sizes); ++s) {
                const std::string height = with_size("/px:", bench::stand_heights[h]);
                const std::string name = with_size("/S:", bench::stand_splat_sizes[s]);
                once(benchmark::RegisterBenchmark((std::string("light/") + angles[e] + height + name).c_str(),
                                                  show_light, e, h, s));
            }
    once(benchmark::RegisterBenchmark("light/all", sum_up_light));
    for (const std::string preset : {"still", "medium"}) {
        const auto add = [&](const std::string& move, bench::Change (*change)(const std::string&, bench::Present)) {
            for (const bench::Present present : {bench::Present::everybody, bench::Present::nobody}) {
                const char* who = present == bench::Present::nobody ? "/nobody" : "";
                once(benchmark::RegisterBenchmark(
                    ("change/" + preset + "/" + move + who).c_str(),
                    [=](benchmark::State& state) { show_change(state, [&] { return change(preset, present); }); }));
            }
        };
        add("backing", bench::change_backing);
        add("panning", bench::change_panning);
    }
    once(benchmark::RegisterBenchmark("change/group/backing", [](benchmark::State& state) {
        show_change(state, [] { return bench::change_of_group(); });
    }));
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    register_frames();
    register_prices();
    register_accuracy();
    bench::register_million();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
