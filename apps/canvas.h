// By what a run draws, and where its pictures go: a window or nowhere.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/stadium_options.h"
#include "apps/stage.h"
#include "figures/way.h"
#include "render/frame_time.h"
#include "render/gl/device.h"
#include "render/gl/headless.h"
#include "render/gl/presenter.h"
#include "render/gl/window.h"
#include "render/native/renderer.h"
#include "render/renderer.h"

namespace apps {

class Canvas {
public:
    // Opens the window, and what OpenGL there is if it may be used. Throws std::runtime_error where --draw gl can't be
    // met; without a display there is no window.
    explicit Canvas(const StadiumOptions& options);

    // The one whose point models serve all that may be drawn by.
    const figures::Way& models_way() const;

    // Makes the renderer. Where OpenGL runs on a GPU and nothing was asked for, both ways draw a small crowd for a
    // moment and the faster is kept. `stage` must outlive this.
    void set_up(const Stage& stage, const StadiumOptions& options);

    // After set_up().
    const figures::Way& way() const;
    render::Renderer& renderer() { return *renderer_; }
    const render::Renderer& renderer() const { return *renderer_; }
    render::FrameTimer& timer() { return *timer_; }
    const render::FrameTimer& timer() const { return *timer_; }
    std::string device() const;  // for people
    std::string driver() const;
    std::string choice() const;  // the way, and why

    render::gl::Window* window() { return window_.get(); }
    bool has_window() const { return window_ != nullptr; }
    // Shows the last picture in the window.
    void present();

private:
    void open(const StadiumOptions& options);
    void use(sfsm::Drawing drawing, const Stage& stage, const StadiumOptions& options);

    std::unique_ptr<render::gl::Window> window_;
    std::unique_ptr<render::gl::HeadlessContext> headless_;
    std::optional<render::gl::Device> device_;  // of OpenGL 4.5, if there is one to draw by
    std::optional<sfsm::Drawing> drawing_;      // empty: both are worth a try
    std::string why_;
    std::unique_ptr<render::Renderer> renderer_;
    render::native::Renderer* native_ = nullptr;  // renderer_, if that is it
    std::unique_ptr<render::FrameTimer> timer_;
    std::unique_ptr<render::gl::Presenter> presenter_;
};

}  // namespace apps
