// Draws crowds in views by recipes, and sums up what each kind of person loses.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/front/measure.h"
#include "tests/bench/loss/recipe.h"
#include "tests/bench/loss/sums.h"

namespace bench::loss {

// What is measured of a crowd.
struct Part {
    std::int64_t people = 0;
    std::vector<std::string> views;      // none: all
    std::vector<std::string> opengl_in;  // views that OpenGL draws too
};

// One view of a crowd, drawn in one way: what of it serves every recipe.
class Subject {
public:
    // `sight` must outlive it.
    Subject(const front::Sight& sight, sfsm::Drawing drawing);

    // By each recipe of the way.
    std::vector<Picture> by_recipes() const;

private:
    Picture drawn_by(const Recipe& recipe, std::span<const figures::Choices> choices) const;
    std::vector<Sum> sums_of(const render::Frame& frame, double background_error, const std::vector<float>& flip) const;

    const front::Sight& sight_;
    sfsm::Drawing drawing_;
    const figures::Way& way_;
    render::View view_;
    FlipReference flip_;
    const front::Present& present_;
    std::vector<std::int32_t> in_front_;  // by pixel: into present_
    std::vector<std::size_t> block_of_;   // as present_
    std::vector<float> shares_;           // by block
};

// A view of nobody: What::all, ground and unrest.
Picture of_nobody(const front::Sight& sight);

// Crowd by crowd. `progress` gets shares of the work in [0, 1]. Throws apps::Interrupted between views.
std::vector<Picture> measure(const std::vector<Part>& parts, front::References& references, bool with_opengl,
                             const std::function<void(double)>& progress);

}  // namespace bench::loss
