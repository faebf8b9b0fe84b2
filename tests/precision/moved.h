// A stadium and the same stadium elsewhere, drawn alike.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

#include "figures/way.h"
#include "render/renderer.h"
#include "render/select.h"
#include "scene/places/stadium.h"
#include "tests/precision/people.h"

namespace precision {

inline constexpr int width = 384, height = 216;  // [px]

using MakeRenderer = std::function<std::unique_ptr<render::Renderer>(const scene::Place&)>;

// Everybody acts on and on, and athletes stay where they are: then there are ticks that are alike.
inline std::vector<scene::CastMember> steady_cast() {
    std::vector<scene::CastMember> cast = cast_of_one().cast;
    for (scene::CastMember& member : cast) {
        for (scene::Acts& acts : member.acts) acts.excited.clear();
        std::ranges::fill(member.gait_speed, 0.0f);
    }
    return cast;
}

// About thirty days after `tick`, where a steady cast is as it was then.
inline std::int64_t alike_after_thirty_days(std::int64_t tick) {
    std::int64_t period = 8;
    for (const motion::ClipPoses& clip : cast_of_one().poses[0].clips)
        period = std::lcm(period, static_cast<std::int64_t>(clip.ticks()));
    return tick + thirty_days / period * period;
}

// A stadium whose cameras are where float and double agree to the last bit wherever it is moved to; the last of them
// looks at the back of the stand that most sit in.
inline scene::Place make_place(std::span<const scene::CastMember> cast) {
    scene::Place place = scene::make_stadium({1500, cast, cast_of_one().poses, 3});
    const auto round = [](glm::dvec3& at) { at = glm::round(at * 0x1p20) * 0x1p-20; };
    scene::Cameras& cameras = place.cameras;
    cameras.roam = {{{0, {{10, 2, 150}, {0, 4, 0}, 0.6}}}};
    for (scene::CameraPath* path : {&cameras.still, &cameras.close, &cameras.medium, &cameras.remote})
        for (scene::CameraKey& key : path->keys) {
            round(key.pose.position);
            round(key.pose.target);
        }
    return place;
}

class Shooting {
public:
    Shooting(const scene::Place& place, std::span<const scene::CastMember> cast, const figures::Way& way,
             const MakeRenderer& make)
        : place_(place),
          figures_(cast_of_one().figures()),
          renderer_(make(place)),
          selector_(place.crowd, cast, figures_, {.way = &way}) {}

    // A picture; of how many people it was known beforehand, if that is asked, that the structure hides them; the blocks drawn as one; and
    // the depth of the farthest who is visible [m].
    struct Shot {
        render::Image image;
        bool is_hidden_known;
        std::int64_t hidden;
        std::size_t far_blocks;
        float range;
    };
    Shot shoot(std::string_view camera, double splat_size, std::int64_t tick) {
        const render::View view = render::make_view(place_.cameras.named(camera).at(0), width, height);
        sfsm::Decision decision;
        if (splat_size > 0) decision = {sfsm::State::points, 1e6, splat_size};
        const render::Surroundings surroundings = renderer_->begin(view);
        const bool is_hidden_known = surroundings.occlusion != nullptr;
        const render::Survey& survey = selector_.survey(view, tick, surroundings);
        const std::int64_t hidden = survey.hidden;
        const float range = survey.range;
        const render::Frame& frame = selector_.select(decision, tick - 1);
        renderer_->draw(frame);
        return {renderer_->read_image(), is_hidden_known, hidden, frame.far_blocks.size(), range};
    }

private:
    const scene::Place& place_;
    std::vector<figures::Figure> figures_;
    std::unique_ptr<render::Renderer> renderer_;
    render::Selector selector_;
};

// [pixels] that differ.
inline int difference(const render::Image& a, const render::Image& b) {
    int pixels = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 3)
        pixels += !std::equal(&a.pixels[i], &a.pixels[i] + 3, &b.pixels[i]);
    return pixels;
}

inline constexpr std::array presets{"still", "close", "medium", "remote", "roam"};
// The last: nobody is to be seen from there.
inline constexpr std::string_view behind_the_stand = presets.back();
inline constexpr std::array splat_sizes{0.0, 1.0, 4.0};  // [px]; 0: triangles

// Ten thousand kilometres, and a number that has no bits below a metre's; then one that has.
inline const glm::dvec3 even_way(10'485'760, 0, -9'437'184), odd_way(8.1234567e6, 12.3, -5.7654321e6);

// Every block told from an origin of its own, on a grid of eight metres; paths stay where they are.
inline void tell_from_everywhere(scene::Crowd& crowd) {
    for (scene::CrowdBlock& block : crowd.blocks) {
        if (scene::follows_path(crowd.role[block.first])) continue;
        const glm::vec3 by = 8.0f * glm::round(block.box.center() / 8.0f);
        block.origin += glm::dvec3(by);
        block.box = {block.box.min - by, block.box.max - by};
        for (std::size_t i = block.first; i < block.first + block.count; ++i) crowd.position[i] -= by;
    }
}

// That two places show the same but for so many pixels of each picture.
inline void expect_alike(const scene::Place& here, const scene::Place& there, const figures::Way& way,
                         const MakeRenderer& make, int most) {
    Shooting one(here, cast_of_one().cast, way, make), other(there, cast_of_one().cast, way, make);
    for (const std::int64_t tick : ticks)
        for (const char* camera : presets)
            for (const double size : splat_sizes) {
                const Shooting::Shot a = one.shoot(camera, size, tick), b = other.shoot(camera, size, tick);
                EXPECT_LE(difference(a.image, b.image), most) << camera << ", S " << size << ", tick " << tick;
                EXPECT_NEAR(static_cast<double>(a.hidden), static_cast<double>(b.hidden), most) << camera;
                constexpr float hair = 1e-3f;  // [m]: the camera's doubles are rounded
                EXPECT_NEAR(a.range, b.range, most == 0 ? 0 : hair) << camera;
            }
}

// A rounding here and there: of a camera's double to two billionths of a metre at ten thousand kilometres.
inline constexpr int few_pixels = width * height / 1000;

inline void expect_alike_elsewhere(const glm::dvec3& by, const figures::Way& way, const MakeRenderer& make, int most) {
    const scene::Place here = make_place(cast_of_one().cast);
    scene::Place there = here;
    scene::move(there, by);
    expect_alike(here, there, way, make, most);
}

inline void expect_alike_from_everywhere(const figures::Way& way, const MakeRenderer& make) {
    const scene::Place here = make_place(cast_of_one().cast);
    scene::Place there = here;
    tell_from_everywhere(there.crowd);
    scene::move(there, even_way);
    expect_alike(here, there, way, make, few_pixels);
}

// So that these compare pictures with somebody in them, who moves, is hidden and is far in one or another.
inline void expect_people_in_pictures(const figures::Way& way, const MakeRenderer& make) {
    const scene::Place place = make_place(cast_of_one().cast);
    Shooting shooting(place, cast_of_one().cast, way, make);
    std::int64_t hidden = 0;
    std::size_t far_blocks = 0;
    bool is_hidden_known = false;
    for (const std::string_view camera : presets) {
        const Shooting::Shot now = shooting.shoot(camera, 4, 0), later = shooting.shoot(camera, 4, thirty_days);
        if (camera != behind_the_stand) {
            EXPECT_GT(difference(now.image, later.image), few_pixels) << camera;
        }
        hidden += now.hidden;
        far_blocks += now.far_blocks;
        is_hidden_known = now.is_hidden_known;
    }
    EXPECT_EQ(hidden > 0, is_hidden_known);
    EXPECT_GT(far_blocks, 1u);
}

inline void expect_alike_after_thirty_days(const figures::Way& way, const MakeRenderer& make) {
    const std::vector<scene::CastMember> cast = steady_cast();
    scene::Place place = make_place(cast);
    scene::move(place, even_way);
    Shooting shooting(place, cast, way, make);
    for (const std::int64_t tick : {0, 37})
        for (const char* camera : presets)
            for (const double size : splat_sizes)
                EXPECT_EQ(shooting.shoot(camera, size, tick).image.pixels,
                          shooting.shoot(camera, size, alike_after_thirty_days(tick)).image.pixels)
                    << camera << ", S " << size << ", tick " << tick;
}

}  // namespace precision
