// What every way of drawing does: a frame in two steps, as what lies around the people is known before they are chosen.
#pragma once

#include "render/frame.h"
#include "render/image.h"
#include "render/surroundings.h"
#include "render/view.h"

namespace render {

class Renderer {
public:
    virtual ~Renderer() = default;

    // Pictures are so large from now on [px], >= 1.
    virtual void resize(int width, int height) = 0;

    // The view of the next frame. What it returns is valid until the next call.
    virtual Surroundings begin(const View& view) = 0;

    // A frame of that view.
    virtual void draw(const Frame& frame) = 0;

    // What was drawn last. Waits for it.
    virtual Image read_image() const = 0;
};

}  // namespace render
