#include "tests/bench/front/offsets.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "figures/splats.h"
#include "pointsample/point_model.h"
#include "tests/bench/front/posture.h"
#include "tests/render/drawn_people.h"

namespace bench::front {

namespace {

struct Mean {
    double sum = 0, worst = 0;
    std::int64_t count = 0;

    void add(double value) {
        sum += value;
        worst = std::max(worst, value);
        ++count;
    }
    double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

// [px] Of the vertex that is farthest off on the screen.
double farthest(const render::View& view, const motion::PoseTable& poses, const Posture& drawn, const Posture& exact) {
    if (drawn.is(exact)) return 0;
    const auto on_screen = [&](const glm::vec3& at) {
        return view.pixels_per_metre(view.depth(at)) * glm::vec2(glm::dot(view.right, at), glm::dot(view.up, at));
    };
    float square = 0;
    for (int vertex = 0; vertex < poses.vertex_count; ++vertex) {
        const glm::vec3 a = drawn.at(poses, vertex), b = exact.at(poses, vertex);
        if (view.depth(a) < render::near_plane || view.depth(b) < render::near_plane) continue;
        const glm::vec2 off = on_screen(a) - on_screen(b);
        square = std::max(square, glm::dot(off, off));
    }
    return std::sqrt(static_cast<double>(square));
}

// [model units] Between the numbers of points whose radius was measured it falls as a power.
double covering_radius(const pointsample::PointModel& model, std::uint32_t points) {
    const auto above = std::ranges::find_if(model.coverage, [&](const auto& at) { return at.points >= points; });
    if (above == model.coverage.end()) return static_cast<double>(model.coverage.back().radius);
    if (above == model.coverage.begin() || above->points == points) return static_cast<double>(above->radius);
    const auto log = [](auto number) { return std::log(static_cast<double>(number)); };
    const auto& below = *(above - 1);
    const double share = (log(points) - log(below.points)) / (log(above->points) - log(below.points));
    return std::exp(log(below.radius) + share * (log(above->radius) - log(below.radius)));
}

// One who is drawn in a block.
Posture as_splat(const render::FarPeople& far, std::uint32_t number, const Posture& exact,
                 const motion::PoseTable& poses) {
    const figures::SplatKeys keys = figures::splat_keys(poses);
    return {exact.position, exact.scale, far.turns[number], static_cast<std::uint32_t>(keys.poses[far.keys[number]])};
}

std::uint32_t representation_of_blocks(const figures::Way& way) {
    for (std::uint32_t i = 0; i < way.representations.size(); ++i)
        if (way.representations[i].is_by_block) return i;
    throw std::logic_error("a frame has far blocks, and its way no representation for them");
}

// Goes through those who are drawn one by one beside all who are present.
class Walk {
public:
    Walk(const render::Frame& frame, const Present& present, const apps::Stage& stage, const figures::Way& way)
        : frame_(frame),
          present_(present),
          stage_(stage),
          way_(way),
          stride_((present.people.size() + most_moving_people - 1) / most_moving_people) {}

    void go() {
        tests::for_each_drawn(frame_, present_.numbers, stage_.place.crowd,
                              [&](std::size_t i, std::uint32_t, const render::Person* alone) { meet(i, alone); });
    }

    Mean motion, outline, covering;

private:
    void meet(std::size_t index, const render::Person* alone) {
        const render::Person& exact = present_.people[index];
        const motion::PoseTable& poses = stage_.poses[exact.character];
        const double pixels = static_cast<double>(exact.instance.scale * frame_.view.pixels_per_metre(exact.depth));
        const double silhouette = std::sqrt(0.25 * static_cast<double>(poses.area)) * pixels;
        const auto& representation =
            way_.representations[alone ? alone->representation : representation_of_blocks(way_)];
        outline.add(representation.outline_px(frame_.splat_size, silhouette));
        if (alone && !representation.is_mesh)
            covering.add(pixels * covering_radius(stage_.points[exact.character], alone->count));
        if (index % stride_ != 0) return;
        const Posture right = Posture::of(exact);
        motion.add(farthest(
            frame_.view, poses,
            alone ? Posture::of(*alone) : as_splat(frame_.far_people, present_.numbers[index], right, poses), right));
    }

    const render::Frame& frame_;
    const Present& present_;
    const apps::Stage& stage_;
    const figures::Way& way_;
    std::size_t stride_;
};

}  // namespace

Present present_in(const render::Frame& exact, const apps::Stage& stage, std::int64_t tick) {
    return {exact.people, tests::numbers_of(exact, stage.place.crowd, stage.cast, tick)};
}

void fill_offsets(const render::Frame& drawn, const Present& present, const apps::Stage& stage, const figures::Way& way,
                  Row& row) {
    Walk walk(drawn, present, stage, way);
    walk.go();
    row.motion_px = walk.motion.mean();
    row.motion_worst_px = walk.motion.worst;
    row.outline_px = walk.outline.mean();
    row.outline_worst_px = walk.outline.worst;
    row.covering_px = walk.covering.mean();
}

}  // namespace bench::front
