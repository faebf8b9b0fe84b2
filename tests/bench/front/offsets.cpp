#include "tests/bench/front/offsets.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "figures/splats.h"
#include "pointsample/point_model.h"

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

// Where somebody's surface is drawn.
struct Posture {
    glm::vec3 position;  // [m] camera-relative
    float scale;
    render::Turn turn;
    std::uint32_t pose;

    static Posture of(const render::Person& person) {
        return {person.instance.position, person.instance.scale, person.instance.turn, person.pose};
    }
    bool is(const Posture& other) const {
        return position == other.position && scale == other.scale && turn.sin_yaw == other.turn.sin_yaw &&
               turn.cos_yaw == other.turn.cos_yaw && pose == other.pose;
    }
    glm::vec3 at(const motion::PoseTable& poses, int vertex) const {
        const std::size_t index = std::size_t{pose} * poses.vertex_count + vertex;
        const glm::vec3 model = motion::unpack_position(poses.vertices[index], poses.box);
        const float s = static_cast<float>(turn.sin_yaw) / 32767, c = static_cast<float>(turn.cos_yaw) / 32767;
        return position + scale * glm::vec3(c * model.x + s * model.z, model.y, c * model.z - s * model.x);
    }
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

// Whether each block of the crowd is drawn as one.
std::vector<bool> far_blocks_of(const render::Frame& frame, std::size_t blocks) {
    std::vector<bool> far(blocks);
    for (const render::FarBlock& block : frame.far_blocks) far[block.block] = true;
    return far;
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
          is_far_(far_blocks_of(frame, stage.place.crowd.blocks.size())),
          stride_((present.people.size() + most_moving_people - 1) / most_moving_people) {}

    void go() {
        const std::vector<scene::CrowdBlock>& blocks = stage_.place.crowd.blocks;
        std::size_t block = 0, next_drawn = 0;
        for (std::size_t i = 0; i < present_.people.size(); ++i) {
            const std::uint32_t number = present_.numbers[i];
            while (number >= blocks[block].first + blocks[block].count) ++block;
            const render::Person* alone = is_far_[block] ? nullptr : &frame_.people.at(next_drawn++);
            meet(i, alone);
        }
        if (next_drawn != frame_.people.size()) throw std::logic_error("a frame draws somebody who isn't visible");
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
    std::vector<bool> is_far_;
    std::size_t stride_;
};

}  // namespace

// Both are in the crowd's order, and nobody stands where another does.
Present present_in(const render::Frame& exact, const apps::Stage& stage, std::int64_t tick) {
    const scene::Crowd& crowd = stage.place.crowd;
    Present present{exact.people, {}};
    present.numbers.reserve(present.people.size());
    std::uint32_t number = 0;
    for (const render::Person& person : present.people) {
        const auto stands_there = [&] {
            const auto& member = stage.cast[crowd.character[number]];
            return exact.view.relative(scene::place(crowd, number, member, tick).position) == person.instance.position;
        };
        while (number < crowd.size() && !stands_there()) ++number;
        if (number == crowd.size()) throw std::logic_error("a frame draws somebody who isn't in the crowd");
        present.numbers.push_back(number++);
    }
    return present;
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
