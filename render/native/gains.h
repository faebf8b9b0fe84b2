// What the areas of points are multiplied by so that people cover as many pixels as their silhouettes do.
//
// Points add up to the silhouette's area, but a cell can't be covered more than once: where chance puts more than that
// on one, some is lost. How much depends on how many cells a silhouette has (on few, all are at its edge and none is
// full) and on how many points there are a cell that show alike much (many lie more evenly; what shows little evens out
// little). So it is measured, on the points themselves, by drawing them as they will be drawn.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace render::native {

class Gains {
public:
    // What a person is drawn as: the coverage of each cell that isn't open, 1 = all of it, and how large their
    // silhouette is [cells].
    struct Trial {
        std::vector<float> coverage;
        double silhouette = 0;
    };
    // `draw`: of about that silhouette [cells], by as many points as are as uneven as `alike` that show alike much, for
    // trial 0, 1 ...: poses and directions are its own choice. `alike` comes in (0, most_alike].
    void measure(const std::function<Trial(float cells, float alike, int trial)>& draw, float most_alike);

    // >= 1; 1 before it was measured.
    float at(float cells, float alike) const;

private:
    static constexpr int sizes = 14, densities = 7;  // octaves from these on
    static constexpr float first_size = 0.25f;       // [cells]
    static constexpr float first_density = 0.25f;    // points a cell that show alike much

    std::array<std::array<float, densities>, sizes> gains_{};
    bool is_measured_ = false;
};

}  // namespace render::native
