// What to draw, and how finely: the visible people, each with a pose and a level of one of the representations. No
// device, no clock.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "figures/choices.h"
#include "figures/figure.h"
#include "figures/splats.h"
#include "motion/schedule.h"
#include "render/crowding.h"
#include "render/error_bounds.h"
#include "render/error_limit.h"
#include "render/forecaster.h"
#include "render/frame.h"
#include "render/rate_forecaster.h"
#include "render/rules.h"
#include "render/surroundings.h"
#include "scene/crowd.h"
#include "scene/remembered_acts.h"
#include "sfsm/decision.h"

namespace render {

struct SelectOptions {
    float theta = motion::default_theta;  // eq. 1's constant [1/m]
    // Points per splat-sized square of the whole surface. A convex body shows a quarter of its surface by half of its
    // points: 1.2 puts more than two on every square that is to be covered, and leaves about one in fifty open. Fewer
    // leave more holes, more make people fatter.
    float density = 1.2f;
    // As what people can be drawn: of all levels that serve a person, the cheapest is. Must outlive the selector.
    const figures::Way* way = &figures::by_opengl();
    // [px] > 0: by rate, nobody's surface is drawn farther from where it is than that, moved too late or covered too
    // coarsely.
    double max_error = std::numeric_limits<double>::infinity();
};

// What a view shows, before anything is decided about it.
struct Survey {
    float range = 1;              // L [m]: the view depth of the farthest visible person, at least 1
    sfsm::Forecast forecast;      // valid until the next survey
    double background_error = 0;  // expected mean FLIP of the frame that is due to what shows beside people
    std::int64_t hidden = 0;      // people behind the structure: they aren't drawn
};

// Blocks that are far are surveyed as one: they are seen or hidden as a whole, and priced by how many people of each
// character they have where, so that a survey costs what is near and not what exists.
// A frame is surveyed, then selected from. Reuses its memory: after the first frames nothing is allocated.
class Selector {
public:
    // All must outlive the selector. `cast` and `figures` in the order of Crowd::character.
    Selector(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
             std::span<const figures::Figure> figures, SelectOptions options = {});
    Selector(const Selector&) = delete;  // parts of it refer to others

    // Finds the visible people at `tick`, and what drawing them would cost. `around`: of that view; its work is counted
    // into the forecast and into the frames.
    const Survey& survey(const View& view, std::int64_t tick, const Surroundings& around = {});

    // The surveyed people under `decision`; those whose motion was due since `last_tick` are counted as moved.
    const Frame& select(const sfsm::Decision& decision, std::int64_t last_tick);

    // The same by any rule.
    const Frame& select(const DrawingRule& rule, std::int64_t last_tick);

private:
    // What people are off.
    struct Errors {
        double expected = 0;                 // [px] FLIP, summed over pixels
        double motion_px = 0, splat_px = 0;  // at most: Frame's
    };
    // A block that may show.
    struct Seen {
        std::uint32_t block = 0;                        // into Crowd::blocks
        glm::dvec3 eye{0.0};                            // [m] where the camera is, from the block's origin
        bool inside = false;                            // no need to cull its people one by one
        bool small = false;                             // so small that its people are priced, and may be drawn, as one
        bool is_far = false;                            // they are drawn so
        float range = 0;                                // [m] view depth of its farthest visible person; 0: nobody is
        bool whole() const { return small && inside; }  // all of its people show
        std::uint32_t visible = 0;                      // people
        std::uint32_t hidden = 0;                       // by the structure
        float share = 1, place = 0;     // of each of its people that others leave to be seen, and Exchange::place_of it
        std::uint32_t first_drawn = 0;  // into Frame::people; of one that is far, into Frame::far_blocks
        // Of its visible people together, as they were chosen last.
        sfsm::Work work;
        Errors errors;
        bool slowed = false, simplified = false;
    };
    // What is known of a character beforehand.
    struct Kind {
        figures::Choices choices;
        std::uint32_t first_batch = 0;  // choice by choice, in each a number a pose
        figures::SplatKeys keys{};
        // A ball around the character in every pose, on the axis that it turns about [model units].
        glm::vec3 center{0.0f};
        float radius = 0;
        // How far from their middle anything of them may be drawn, who may have moved on since [model units].
        std::array<float, scene::role_count> reach{};
        float overhang = 0;     // of their splats [model units]
        float mean_square = 1;  // of people's scales [m^2 / model unit^2]
        std::array<Staleness, scene::role_count> staleness{};
    };
    // People of a block who are alike: all that is asked of one that is surveyed as a whole.
    struct Group {
        std::uint32_t character = 0;
        scene::Role role{};
        std::uint32_t people = 0;
        glm::vec3 middle{0.0f};  // [m] from the block's origin: mean of theirs
    };
    enum class Look : std::uint8_t { outside, hidden, partly, inside };
    static constexpr std::int64_t no_tick = std::numeric_limits<std::int64_t>::min();
    // Of one of Crowd::blocks.
    struct Block {
        std::uint32_t first_group = 0, groups = 0;
        float reach = 0, tallest = 0;  // [m] the largest radius, and height, of its people
        bool stays = true;             // nobody in it follows a path
        Crowding crowding;
        float silhouette = 0;  // [m^2] mean of its people's
        // In the view that is surveyed:
        Look look{};
        bool small = false;
        std::int64_t key_tick = no_tick;  // that its people's keys are of
    };
    struct Spot {
        glm::vec3 position;  // [m] camera-relative, of the model's origin
        Turn turn;
    };
    // Of one person in the view that is surveyed.
    struct Sight {
        float depth;      // [m] of the middle, at least the near plane; unseen: not in view; behind: hidden
        float surface;    // [px^2]
        float demand;     // points asked for at S = 1 px; infinite: too near to be drawn by points
        float on_screen;  // share of them in the picture
    };
    static constexpr float unseen = -1.0f, behind = -2.0f;

    void know_reach(std::size_t kind);
    void know_blocks();
    std::vector<std::vector<float>> find_spreads();
    void find_blocks();
    Look look_at(const View& view, std::size_t block) const;
    bool is_small(const View& view, std::size_t block) const;
    void find_visible(Seen& seen);
    void find_range();
    void forecast();
    void forecast_as_one(const Seen& seen);
    std::span<const Group> groups_of(const Seen& seen) const;
    float depth_of(const Seen& seen, const Group& group) const;        // [m] of its middle, at least the near plane
    float mean_demand_of(const Seen& seen, const Group& group) const;  // at S = 1 px
    void find_shares();
    float on_screen(std::size_t person, const glm::vec3& middle, float depth, float surface) const;
    Subject subject_of(std::size_t person, const Sight& sight, const Seen& seen) const;
    Subject subject_of(const Group& group, const Seen& seen) const;
    float nearest_of(const Seen& seen) const;  // [m] view depth that nobody of a block is nearer than
    float largest_of(const Seen& seen, const Group& group) const;  // [m / model unit] nobody of a block has more
    std::uint32_t pose_of(std::size_t person, std::int64_t tick);
    void find_far_blocks(const DrawingRule& rule);
    void make_room();
    void choose(Seen& seen, const DrawingRule& rule, std::int64_t last_tick);
    void choose_as_one(Seen& seen, const DrawingRule& rule, std::int64_t last_tick);
    Person choose(std::size_t person, const Sight& sight, const DrawingRule& rule, std::int64_t last_tick, Seen& seen);
    void add_errors(std::size_t number, const Sight& sight, const Person& person, const Subject& subject, int period,
                    Seen& seen) const;
    void add_errors(const Group& group, const Subject& subject, int period, double people, Seen& seen) const;
    double cell() const;
    float scale_of(std::size_t person) const;             // [m / model unit]
    float reach_of(std::size_t person) const;             // [m]
    float exact_within(float radius, float reach) const;  // [m] nearer than this view depth they are drawn exactly
    static Turn turn_of(float yaw);
    Spot spot_of(const Seen& seen, std::size_t person, std::int64_t tick) const;
    glm::vec3 middle_of(const Seen& seen, std::size_t person) const;  // [m] camera-relative, of their ball
    Sight sight_of(std::size_t person, const glm::vec3& middle) const;
    void sum_up();
    template <typename Visit>
    void for_each_visible(const Seen& seen, Visit visit) const;  // gets person and Sight
    template <typename Work>
    void for_each_seen(Work work);

    const scene::Crowd& crowd_;
    std::span<const scene::CastMember> cast_;
    std::vector<figures::Figure> figures_;
    SelectOptions options_;
    std::vector<Kind> kinds_;
    float overhang_ = 0;         // the largest of anybody [m]
    std::vector<Block> blocks_;  // as Crowd::blocks
    std::vector<Group> groups_;  // block by block
    std::vector<Turn> turns_;    // of people, for those who stay where they are

    View view_;
    std::int64_t tick_ = 0;
    Surroundings around_;
    ErrorLimit limit_;
    scene::RememberedActs acts_;
    std::vector<Seen> seen_;  // in the crowd's order
    // Per person of blocks that are not whole. Where nobody was ever asked, its memory isn't touched.
    std::unique_ptr<Sight[]> sights_;
    Forecaster forecaster_;
    RateForecaster rates_;
    RateRule rate_rule_{rates_};
    std::vector<ErrorBounds> bounds_;  // by character
    Survey survey_;

    figures::PointsErrors points_errors_;  // in the frame's cells
    std::vector<std::uint8_t> far_keys_;   // Frame::far_people's
    Frame frame_;
};

}  // namespace render
