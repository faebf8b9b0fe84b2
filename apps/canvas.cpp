#include "apps/canvas.h"

#include <hwy/targets.h>
#include <tbb/info.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "render/gl/renderer.h"
#include "render/gl/timer.h"
#include "render/select.h"
#include "scene/places/stadium.h"

namespace apps {

namespace {

// Median time of frames that a way takes to draw a crowd as points of a pixel [ms].
double trial_ms(render::Renderer& renderer, render::FrameTimer& timer, render::Selector& selector,
                const render::View& view) {
    constexpr double longest_ms = 100;
    constexpr std::int64_t fewest = 4, most = 30;
    constexpr sfsm::Decision decision{sfsm::State::points, 1e9, 1.0};
    std::vector<double> times;
    double spent = 0;
    for (std::int64_t frame = 0; frame < fewest || (frame < most && spent < longest_ms); ++frame) {
        timer.begin(frame);
        selector.survey(view, frame, renderer.begin(view));
        const render::Frame& chosen = selector.select(decision, frame - 1);
        timer.submit();
        renderer.draw(chosen);
        const auto time = timer.end();
        if (!time || time->frame == 0) continue;  // the first one makes shaders and tables
        times.push_back(time->frame_ms);
        spent += time->frame_ms;
    }
    while (const auto time = timer.drain()) times.push_back(time->frame_ms);
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    return times[times.size() / 2];
}

}  // namespace

Canvas::Canvas(const StadiumOptions& options) : drawing_(options.draw) {
    if (drawing_) why_ = "as asked for";
    open(options);
}

// With a context to draw by unless it is to be done natively. Without one that is done, if it may be.
void Canvas::open(const StadiumOptions& options) {
    std::string obstacle;
    const bool windowed = !options.headless && render::gl::Window::display_available(&obstacle);
    if (!obstacle.empty()) std::fprintf(stderr, "stadium: %s; drawing without a window\n", obstacle.c_str());
    const auto open_window = [&](render::gl::Window::Use use) {
        window_ = std::make_unique<render::gl::Window>("Grandstand", options.width, options.height, use);
    };
    if (drawing_ != sfsm::Drawing::native) {
        try {
            if (windowed)
                open_window(render::gl::Window::Use::draw);
            else
                headless_ = std::make_unique<render::gl::HeadlessContext>();
            device_ = render::gl::read_device();
        } catch (const std::runtime_error&) {
            if (drawing_ == sfsm::Drawing::opengl) throw;
            window_.reset();
            headless_.reset();
        }
        if (!drawing_ && (!device_ || device_->software)) {
            drawing_ = sfsm::Drawing::native;
            why_ = device_ ? "OpenGL is software" : "no OpenGL 4.5";
            headless_.reset();
        }
    }
    if (drawing_ == sfsm::Drawing::native) {
        device_.reset();
        if (windowed && !window_) open_window(render::gl::Window::Use::show);
    }
}

const figures::Way& Canvas::models_way() const {
    return drawing_ == sfsm::Drawing::opengl ? figures::by_opengl() : figures::natively();
}

const figures::Way& Canvas::way() const {
    return *drawing_ == sfsm::Drawing::opengl ? figures::by_opengl() : figures::natively();
}

void Canvas::set_up(const Stage& stage, const StadiumOptions& options) {
    if (drawing_) return use(*drawing_, stage, options);
    constexpr std::int64_t small_crowd = 1000;
    const scene::Place place = scene::make_stadium({small_crowd, stage.cast, stage.poses, options.seed});
    const std::vector<figures::Figure> figures = stage.figures();
    const render::View view = render::make_view(place.cameras.named("still").at(0), options.width, options.height);
    double ms[sfsm::drawings];
    for (const sfsm::Drawing drawing : {sfsm::Drawing::native, sfsm::Drawing::opengl}) {
        drawing_ = drawing;
        use(drawing, stage, options);
        render::SelectOptions select;
        select.way = &way();
        render::Selector selector(place.crowd, stage.cast, figures, select);
        ms[sfsm::index_of(drawing)] = trial_ms(*renderer_, *timer_, selector, view);
    }
    const double gl = ms[sfsm::index_of(sfsm::Drawing::opengl)], native = ms[sfsm::index_of(sfsm::Drawing::native)];
    char text[80];
    std::snprintf(text, sizeof text, "a small crowd took %.2f ms by gl and %.2f ms natively", gl, native);
    why_ = text;
    drawing_ = gl <= native ? sfsm::Drawing::opengl : sfsm::Drawing::native;
    use(*drawing_, stage, options);
}

void Canvas::use(sfsm::Drawing drawing, const Stage& stage, const StadiumOptions& options) {
    const scene::Place& place = stage.place;
    native_ = nullptr;
    if (drawing == sfsm::Drawing::opengl) {
        renderer_ = std::make_unique<render::gl::Renderer>(place.structure, place.ground, place.light, stage.figures(),
                                                           options.width, options.height);
        timer_ = std::make_unique<render::gl::FrameTimer>(*device_);
        return;
    }
    auto native = std::make_unique<render::native::Renderer>(place.structure, place.ground, place.light,
                                                             stage.figures(), options.width, options.height);
    native_ = native.get();
    renderer_ = std::move(native);
    timer_ = std::make_unique<render::FrameClock>();
}

std::string Canvas::device() const {
    if (*drawing_ == sfsm::Drawing::opengl) return device_->renderer;
    const int threads = tbb::info::default_concurrency();
    const std::int64_t sets = hwy::SupportedTargets() & HWY_TARGETS;  // the best has the lowest bit
    return "the processor (" + std::to_string(threads) + (threads == 1 ? " thread, " : " threads, ") +
           hwy::TargetName(sets & -sets) + ")";
}

std::string Canvas::driver() const {
    return *drawing_ == sfsm::Drawing::opengl ? device_->version : "none";
}

std::string Canvas::choice() const {
    return std::string(sfsm::name_of(*drawing_)) + " (" + why_ + ")";
}

void Canvas::present() {
    if (!native_) {
        static_cast<render::gl::Renderer&>(*renderer_).present(window_->width(), window_->height());
    } else {
        if (!presenter_) presenter_ = std::make_unique<render::gl::Presenter>();
        const auto& picture = native_->picture();
        presenter_->present(picture.row(0), picture.stride(), native_->width(), native_->height(), window_->width(),
                            window_->height());
    }
    window_->swap();
}

}  // namespace apps
