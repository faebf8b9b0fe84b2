// What a frame shows, in plain words and double precision: whom, where, how posed and drawn, under which light. Takes
// the product's plain data (Character, PointModel, StaticMesh, Crowd) and none of its code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "model/character.h"
#include "motion/pose_table.h"
#include "pointsample/point_model.h"
#include "scene/camera_path.h"
#include "scene/crowd.h"
#include "scene/places/stadium.h"
#include "sfsm/decision.h"
#include "tests/reference/surface.h"

namespace reference {

// A pinhole without a far plane; what is nearer than `near` is cut away.
struct Camera {
    glm::dvec3 position;            // [m] world
    glm::dvec3 right, up, forward;  // orthonormal; up leans towards +y
    double tan_x, tan_y;            // of half the fields of view
    int width, height;              // [px]

    static constexpr double near = 0.1;  // [m]

    Camera(const scene::CameraPose& pose, int width, int height);
    double pixels_per_metre(double depth) const { return height / (2 * tan_y * depth); }
    // Through pixel coordinates (x right, y down, centres at halves); its depth is 1.
    glm::dvec3 ray(double x, double y) const;
};

// A character as its file has it, and the clips that are played of it.
class Figure {
public:
    // Both must outlive the figure. `clips` index character.clips, in the order that people name them; none: the rest
    // pose is all there is. `points` may be null if nobody is drawn by them.
    Figure(const model::Character& character, std::vector<int> clips, const pointsample::PointModel* points);

    const model::Mesh& mesh() const { return *mesh_; }
    const pointsample::PointModel& points() const { return *points_; }
    const Surface& pose(int slot, std::int64_t tick) const;  // [1/60 s] of the clip's own time, within it
    double height() const { return height_; }                // [model units] in the first clip's first pose
    double middle() const { return middle_; }                // [model units] halfway up all poses
    double area() const { return area_; }                    // [model units^2] of the pose that has most

    // How one of the first `count` points looks when there are no others.
    struct Look {
        glm::dvec3 albedo;                    // linear
        double unlit;                         // [0, 1] the share of it that is seen in any light and shade
        glm::dvec3 emitted;                   // linear, besides
        double slots[1 + model::slot_count];  // shares by slot, sum 1
    };
    const std::vector<Look>& looks(std::size_t count) const;

private:
    Surface struck(int slot, std::int64_t tick) const;

    const model::Character& character_;
    const model::Mesh* mesh_;
    const pointsample::PointModel* points_;
    std::vector<int> clips_;
    double height_ = 0, middle_ = 0, area_ = 0;
    mutable std::map<std::pair<int, std::int64_t>, Surface> poses_;
    mutable std::map<std::size_t, std::vector<Look>> looks_;
};

struct Person {
    const Figure* figure = nullptr;
    int slot = 0;           // into the figure's clips
    std::int64_t tick = 0;  // of the clip's own time
    glm::dvec3 origin{0};   // [m] world, of the model's origin
    double yaw = 0;         // [rad] faces (sin yaw, 0, cos yaw)
    double scale = 1;       // [m / model unit]
    scene::Palette palette{};
    std::size_t points = 0;  // how many; 0: triangles
    double shade = 0;        // [m] around their origin what they stand on is darker; 0: they sit
};

struct Scene {
    Camera camera;
    std::vector<Person> people;
    const scene::StaticMesh* structure = nullptr;
    scene::Oval oval;
    double stand_offset = 0;  // [m] from the track's inner line to where the stands begin
    double splat_size = 0;    // [px]
    // Across a pixel, and down, that people have who are triangles. With more than one, structure and sky have four in
    // a pixel, whose light is that of its middle, and as a whole the depth of the second farthest; else one, in the
    // middle. Who is splats is drawn only with one.
    int samples = 1;
    // Who is small in the picture loses their shade; else it is whole however small it is.
    bool fades_shade = true;
};

// A frame's decision, told person by person: everybody at `tick`, seen or not. `figures` in the order of
// Crowd::character. Where people go and which clip they are in is asked of scene::place and scene::act, which have
// tests of their own; when they last moved, and by how many points they are drawn, is worked out here.
std::vector<Person> people_of(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                              std::span<const motion::PoseTable> tables, std::span<const Figure> figures,
                              const Camera& camera, const sfsm::Decision& decision, std::int64_t tick);

}  // namespace reference
