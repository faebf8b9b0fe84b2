// What to draw, and how finely: the visible people, each with a pose and either triangles or the first n of its points,
// gathered so that every batch reads one pose. No GL, no clock.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/pose_table.h"
#include "motion/schedule.h"
#include "render/figure.h"
#include "render/forecaster.h"
#include "render/view.h"
#include "scene/crowd.h"
#include "sfsm/decision.h"

namespace render {

// One person as the vertex shader takes it.
struct Instance {
    glm::vec3 position;             // [m] feet, camera-relative
    float scale;                    // [m / model unit]
    std::int16_t sin_yaw, cos_yaw;  // snorm
    scene::Palette palette;
};
static_assert(sizeof(Instance) == 36);

// People of one character in one pose, drawn alike.
struct Batch {
    std::uint32_t character;
    std::uint32_t pose;
    std::uint32_t points;  // how many of the character's points each gets; 0 = triangles
    std::uint32_t first_instance;
    std::uint32_t instance_count;
};

struct SelectOptions {
    float theta = motion::default_theta;  // eq. 1's constant [1/m]
    // Points per splat-sized square of the whole surface. A quarter of a convex body's surface is its silhouette and
    // half its points face away: 1.2 puts more than two facing points on every square that is to be covered, and leaves
    // about one in fifty open. Fewer leave more holes, more make people fatter.
    float density = 1.2f;
    // A person becomes points only where that is the cheaper way: what a point is believed to cost, in triangles.
    float triangles_per_point = static_cast<float>(sfsm::entry_of(sfsm::WorkKind::point).prior.pieces /
                                                   sfsm::entry_of(sfsm::WorkKind::triangle).prior.pieces);
};

struct Selection {
    std::vector<Instance> instances;
    std::vector<Batch> batches;  // by character, then triangles before points, pose by pose
    sfsm::Work work;
};

// What a view shows, before anything is decided about it.
struct Survey {
    float range = 1;          // L [m]: the view depth of the farthest visible person, at least 1
    sfsm::Forecast forecast;  // valid until the next survey
};

// A frame is surveyed, then selected from. Reuses its memory: after the first frames nothing is allocated.
class Selector {
public:
    // All must outlive the selector. `figures` in the order of Crowd::character.
    Selector(const scene::Crowd& crowd, std::span<const Figure> figures, SelectOptions options = {});

    // Finds the visible people at `tick`, and what drawing them would cost.
    const Survey& survey(const View& view, std::int64_t tick);

    // The surveyed people under `decision`; those whose motion was due since `last_tick` are counted as moved.
    const Selection& select(const sfsm::Decision& decision, std::int64_t last_tick);

private:
    struct Candidate {
        std::uint32_t bucket;  // of its batch
        bool moved;
        Instance instance;
    };
    // A character as people of it are judged: its buckets, level by level (0 = triangles), in each a bucket a pose.
    struct Kind {
        std::uint32_t first_bucket = 0;
        std::uint32_t levels = 0;
        glm::vec3 center{
            0.0f};  // of a ball around the character in every pose, on the axis it turns about [model units]
        float radius = 0;
    };
    static constexpr float unseen = -1.0f;

    void find_visible(std::size_t block_index);
    void forecast();
    Candidate consider(std::size_t person, const sfsm::Decision& decision, std::int64_t last_tick) const;
    std::uint32_t level_of(std::size_t character, float points) const;
    float scale_of(std::size_t person) const;  // [m / model unit]
    float points_at_unit_splat(std::size_t person) const;
    void gather();
    void batch(std::uint32_t character);
    template <typename Visit>
    void for_each_visible(Visit visit) const;

    const scene::Crowd& crowd_;
    std::vector<Figure> figures_;
    SelectOptions options_;
    std::vector<Kind> kinds_;

    View view_;
    std::int64_t tick_ = 0;
    std::vector<std::uint32_t> visible_blocks_;
    std::vector<std::uint8_t> block_inside_;  // per visible block: no need to cull its people one by one
    std::vector<float> depth_;                // [m] per person of visible blocks; unseen: not in view
    Forecaster forecaster_;
    Survey survey_;

    std::vector<Candidate> candidates_;        // one a person; only visible people's are of this frame
    std::vector<std::uint32_t> bucket_begin_;  // per bucket, then the total
    Selection selection_;
};

// The numbers of points that are drawn: powers of two and their halfway marks. Level 0 stands
// for triangles.
std::uint32_t level_points(std::uint32_t level);  // 1, 2, 3, 4, 6, 8, 12, 16, 24 ... for levels 1 to 32
// The lowest level with at least `points` points; 33 if that is beyond level 32.
std::uint32_t level_for(float points);

// Prefixes of up to this many points are drawn with looks of their own (pointsample::prefix_looks).
inline constexpr std::uint32_t longest_averaged_prefix = 32;

}  // namespace render
