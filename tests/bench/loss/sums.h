// What is measured of a picture, and what a prediction needs to know of it: a line each of docs/measurements/loss.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/drawing.h"

namespace bench::loss {

enum class What : int {
    mesh,        // people, class by class: as triangles,
    points,      //   as points of their own,
    splats,      //   with their block
    shade,       // pixels of the crowd in which nobody is in front: shade on the ground
    motion,      // shown: pixels times how far surfaces are off [px^2]
    background,  // pixels without people
    frame,       // all pixels
    all,         // of the same view of nobody: all pixels;
    ground,      //   shown: those of ground;
    unrest,      //   shown: how restless they are together (render::native::BackdropErrors)
};

struct Sum {
    What what{};
    double height = 0;   // [px] of people who stand: the middle of their class
    double spacing = 0;  // [px] of their points, mean
    double cell = 0;     // [px]
    double shown = 0;    // [px] that are expected to show this
    double pixels = 0;   // that do
    double flip = 0;     // summed over them
};

// One picture: a crowd in a view drawn by a recipe.
struct Picture {
    std::int64_t people = 0;
    std::string view;
    bool is_fitted = false;  // a preset; moments of the roaming path are judged
    sfsm::Drawing drawing{};
    std::string recipe;
    std::vector<Sum> sums;

    // The first of a kind; an empty one if there is none.
    Sum of(What what) const {
        for (const Sum& sum : sums)
            if (sum.what == what) return sum;
        return {};
    }
};

// A line of columns, then one a sum; numbers with six digits.
std::string to_csv(const std::vector<Picture>& pictures);
// Throws std::runtime_error with one line: `name`, the line, what was found and what was expected.
std::vector<Picture> from_csv(std::string_view text, const std::string& name);

}  // namespace bench::loss
