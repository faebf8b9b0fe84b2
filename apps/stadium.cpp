// The roaming stadium: one loop from a measured time to the next decision.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/canvas.h"
#include "apps/free_camera.h"
#include "apps/gallery.h"
#include "apps/interrupt.h"
#include "apps/memory.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/scene_clock.h"
#include "apps/stadium_options.h"
#include "apps/stadium_outputs.h"
#include "apps/stage.h"
#include "apps/warm_up.h"
#include "render/renderer.h"
#include "render/select.h"
#include "scene/cameras.h"
#include "sfsm/controller.h"
#include "sfsm/detail.h"
#include "sfsm/number_text.h"
#include "sfsm/paper.h"

namespace apps {

namespace {

constexpr std::int64_t headless_frames = 300;

// What --state asks for in place of a law's decision; the distances are those the paper's machine starts and leaves at.
sfsm::Decision fixed_decision(const StadiumOptions& options, sfsm::State state, double range) {
    constexpr double default_splat_size = 2;  // [px]
    sfsm::Decision decision;
    decision.state = state;
    if (state == sfsm::State::slowed)
        decision.motion_distance = options.motion_distance.value_or(sfsm::PaperConstants{}.first_share * range);
    if (state == sfsm::State::points) {
        decision.motion_distance = options.motion_distance.value_or(sfsm::detail_of_points * range);
        decision.splat_size = options.splat_size.value_or(default_splat_size);
    }
    return decision;
}

std::optional<scene::CameraPath> load_path(const std::string& camera) {
    if (scene::is_preset(camera)) return std::nullopt;
    return scene::load_camera_path(camera);
}

class Stadium {
public:
    explicit Stadium(const StadiumOptions& options)
        : options_(options),
          path_from_file_(load_path(options.camera)),
          canvas_(options),
          stage_(build_stage(options.characters, options.people, options.seed, PointCache(options.cache),
                             canvas_.models_way(), options.strict, options.verbose)),
          path_(path_from_file_ ? *path_from_file_ : stage_->place.cameras.named(options.camera)),
          clock_(options.fixed_step || !canvas_.window()),
          width_(options.width),
          height_(options.height) {
        canvas_.set_up(*stage_, options);
        controller_ = sfsm::make_controller(options.law, {canvas_.way().drawing});
        render::SelectOptions select;
        select.way = &canvas_.way();
        if (options_.max_error) select.max_error = *options_.max_error;
        selector_.emplace(stage_->place.crowd, stage_->cast, stage_->figures(), select);
        warm_up();
        stage_->place.crowd.filled_tick = std::llround(options.pour_in * motion::ticks_per_second);
    }

    void run(const StadiumOutputs& outputs) {
        const std::int64_t frames = options_.frames.value_or(canvas_.window() ? 0 : headless_frames);
        ProgressBar bar("Drawing");
        for (std::int64_t frame = 0; (frames == 0 || frame < frames) && !interrupted(); ++frame) {
            if (canvas_.window() && !follow_user()) break;
            if (const auto time = draw(frame)) learn(*time);
            if (outputs.wants_picture(frame)) outputs.write_picture(frame, canvas_.renderer().read_image());
            if (canvas_.window()) show(frame);
            if (frames > 0) bar(static_cast<double>(frame + 1) / static_cast<double>(frames));
            elapsed_ = clock_.advance();
        }
        while (const auto time = canvas_.timer().drain()) learn(*time);
    }

    render::Image picture() const { return canvas_.renderer().read_image(); }
    std::span<const sfsm::TraceRow> rows() const { return rows_; }
    std::span<const std::string> warnings() const { return stage_->warnings; }

    // What a trace must say for the run to be repeated and its decisions verified.
    std::map<std::string, std::string> settings() const {
        return {
            {"version", GRANDSTAND_VERSION},
            {"draw", std::string(sfsm::name_of(canvas_.way().drawing))},
            {"draw_because", canvas_.choice()},
            {"device", canvas_.device()},
            {"driver", canvas_.driver()},
            {"law", options_.law},
            {"state", options_.state ? std::to_string(static_cast<int>(*options_.state)) : "auto"},
            {"delay", std::to_string(canvas_.timer().delay())},
            {"target_ms", options_.target.text()},
            {"people", std::to_string(options_.people)},
            {"pour_in_s", sfsm::number_text(options_.pour_in)},
            {"character", character_names()},
            {"camera", options_.camera + (was_steered_ ? " (then steered)" : "")},
            {"size", std::to_string(width_) + "x" + std::to_string(height_)},
            {"splat_px", options_.splat_size ? sfsm::number_text(*options_.splat_size) : "default"},
            {"motion_distance_m", options_.motion_distance ? sfsm::number_text(*options_.motion_distance) : "default"},
            {"max_error_px", options_.max_error ? sfsm::number_text(*options_.max_error) : "none"},
            {"step", options_.fixed_step || !canvas_.has_window() ? "1/60 s" : "wall clock"},
            {"seed", std::to_string(options_.seed)}};
    }

private:
    // Shaders and tables are made at the first draw that needs them: one person of each character, drawn as they may
    // be, and a far block, before any time is taken.
    void warm_up() {
        throw_if_interrupted();
        const render::View view = view_now();
        const float range = selector_->survey(view, 0).range;
        render::Frame frame = one_of_each(view, stage_->place.crowd, stage_->figures(), canvas_.way());
        if (options_.state.value_or(sfsm::State::points) == sfsm::State::points) {
            const render::Frame& points = selector_->select(fixed_decision(options_, sfsm::State::points, range), -1);
            frame.far_people = points.far_people;
            if (!points.far_blocks.empty()) frame.far_blocks = {points.far_blocks.front()};
        }
        canvas_.renderer().begin(view);
        canvas_.renderer().draw(frame);
        canvas_.renderer().read_image();  // waits for it
    }

    render::View view_now() const {
        const scene::CameraPose pose = flight_ ? flight_->pose() : path_.at(clock_.seconds());
        return render::make_view(pose, width_, height_);
    }

    std::optional<render::FrameTime> draw(std::int64_t frame) {
        const render::View view = view_now();
        sfsm::TraceRow row;
        row.frame = frame;
        row.target_ms = target_scale_ * options_.target.at(frame);
        render::Renderer& renderer = canvas_.renderer();
        render::FrameTimer& timer = canvas_.timer();
        timer.begin(frame);
        const render::Survey& survey = selector_->survey(view, clock_.tick(), renderer.begin(view));
        row.range = survey.range;
        row.hidden = survey.hidden;
        row.decision = options_.state ? fixed_decision(options_, *options_.state, row.range)
                                      : controller_->decide({row.target_ms, row.range, &survey.forecast});
        if (!options_.state) row.predicted_ms = controller_->status().predicted_ms;
        if (!options_.trace.empty()) {
            row.motion.assign(survey.forecast.motion.begin(), survey.forecast.motion.end());
            row.shapes.assign(survey.forecast.shapes.begin(), survey.forecast.shapes.end());
            row.rates.assign(survey.forecast.rates.begin(), survey.forecast.rates.end());
        }
        const render::Frame& drawn = selector_->select(row.decision, last_tick_);
        timer.submit();
        renderer.draw(drawn);
        const auto time = timer.end();
        row.work = drawn.work;
        row.drawn_state = drawn.state;
        row.max_motion_error_px = drawn.max_motion_px;
        row.max_splat_error_px = drawn.max_splat_px;
        row.predicted_flip = drawn.expected_flip;
        rows_.push_back(row);
        last_tick_ = clock_.tick();
        return time;
    }

    // A time has arrived: it belongs to the decision of its own frame, which may be some frames back.
    void learn(const render::FrameTime& time) {
        sfsm::TraceRow& row = rows_[static_cast<std::size_t>(time.frame)];
        row.frame_ms = last_ms_ = time.frame_ms;
        row.cpu_ms = time.cpu_ms;
        row.gpu_ms = time.gpu_ms;
        controller_->observe({time.frame, time.frame_ms, row.decision, row.work});
    }

    // False: the user has left.
    bool follow_user() {
        render::gl::Window& window = *canvas_.window();
        const render::Input input = window.poll();
        if (window.closed()) return false;
        if (!flight_ && FreeCamera::steers(input)) {
            flight_.emplace(path_.at(clock_.seconds()));
            was_steered_ = true;
        }
        if (flight_) flight_->move(input, elapsed_);
        for (const render::Command command : input.commands) obey(command);
        const bool resized = window.width() != width_ || window.height() != height_;
        if (resized && window.width() > 0 && window.height() > 0) {
            width_ = window.width();
            height_ = window.height();
            canvas_.renderer().resize(width_, height_);
        }
        return true;
    }

    void obey(render::Command command) {
        constexpr double target_step = 1.1;
        switch (command) {
            case render::Command::raise_target:
                target_scale_ *= target_step;
                break;
            case render::Command::lower_target:
                target_scale_ /= target_step;
                break;
            case render::Command::pause:
                clock_.paused = !clock_.paused;
                break;
            case render::Command::screenshot:
                screenshot();
                break;
            default:
                flight_.reset();
                was_steered_ = true;
                path_ = stage_->place.cameras.named(scene::preset_names[static_cast<std::size_t>(command)]);
        }
    }

    // Under the first free name. A full disk must not end the run.
    void screenshot() const {
        std::string name;
        for (int number = 1; name.empty() || std::filesystem::exists(name); ++number)
            name = "stadium-" + std::to_string(number) + ".png";
        try {
            write_png(name, canvas_.renderer().read_image());
            std::fprintf(stderr, "stadium: saved %s\n", name.c_str());
        } catch (const std::exception& error) {
            std::fprintf(stderr, "stadium: %s\n", error.what());
        }
    }

    void show(std::int64_t frame) {
        constexpr std::int64_t title_period = 10;  // [frames]; faster can't be read
        if (frame % title_period == 0) canvas_.window()->set_title(title());
        canvas_.present();
    }

    std::string title() const {
        const sfsm::TraceRow& row = rows_.back();
        const sfsm::Decision& decision = row.decision;
        char text[200];
        int length =
            std::snprintf(text, sizeof text, "Grandstand  %s  %.1f / %.1f ms  %lld people  state %d",
                          sfsm::name_of(canvas_.way().drawing).data(), last_ms_, row.target_ms,
                          static_cast<long long>(row.work[sfsm::WorkKind::person]), static_cast<int>(*row.drawn_state));
        if (decision.state != sfsm::State::original)
            length += std::snprintf(text + length, sizeof text - length, "  D %.0f m", decision.motion_distance);
        if (decision.state == sfsm::State::points)
            length += std::snprintf(text + length, sizeof text - length, "  S %.1f px", decision.splat_size);
        if (clock_.paused) std::snprintf(text + length, sizeof text - length, "  paused");
        return text;
    }

    std::string character_names() const {
        if (options_.characters.empty()) return stage_->cast.front().name;
        return text_of(options_.characters);
    }

    const StadiumOptions& options_;
    std::unique_ptr<sfsm::Controller> controller_;
    std::optional<scene::CameraPath> path_from_file_;  // read first: a damaged one is known before any work is done
    Canvas canvas_;
    std::unique_ptr<Stage> stage_;
    scene::CameraPath path_;
    std::optional<render::Selector> selector_;
    SceneClock clock_;
    std::optional<FreeCamera> flight_;  // instead of the path once the user steers
    std::vector<sfsm::TraceRow> rows_;  // one a frame; the times come later
    std::int64_t last_tick_ = -1;
    double elapsed_ = 0;  // [s] since the last frame
    double last_ms_ = 0;
    double target_scale_ = 1;  // the user's + and -
    int width_, height_;       // [px]
    bool was_steered_ = false;
};

void show_gallery(const StadiumOptions& options) {
    constexpr std::size_t fine_points = 16384;  // one a pixel of a picture
    OutputFile file(options.png);
    const Gallery gallery = draw_gallery(options.characters, {.seed = options.seed,
                                                              .cache = PointCache(options.cache),
                                                              .way = figures::natively(),
                                                              .strict = options.strict,
                                                              .verbose = options.verbose,
                                                              .fewest_points = fine_points});
    write_png(file, gallery.sheet);
    if (gallery.failed > 0)
        throw std::runtime_error(std::to_string(gallery.failed) + " of " + std::to_string(options.characters.size()) +
                                 " files could not be drawn; " + options.png + " has the others");
}

void run(const StadiumOptions& options) {
    finish_on_signal();
    if (options.gallery) return show_gallery(options);
    require_memory(options.people, options.width, options.height, available_memory());
    StadiumOutputs outputs(options);
    Stadium stadium(options);
    stadium.run(outputs);
    if (stadium.rows().empty()) throw_if_interrupted();
    outputs.finish(stadium.rows(), stadium.settings(), stadium.warnings(),
                   outputs.wants_last_picture() ? stadium.picture() : render::Image{});
}

}  // namespace

}  // namespace apps

int main(int argc, char** argv) {
    CLI::App app("A stadium of animated people, drawn as finely as the frame time allows.", "stadium");
    apps::StadiumOptions options;
    apps::add_stadium_options(app, options);
    return apps::run_program(
        app, argc, argv, [&] { check(options); }, [&] { apps::run(options); });
}
