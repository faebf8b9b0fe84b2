#include "render/select.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "figures/points.h"
#include "render/contact_shade.h"
#include "render/room.h"

namespace render {

namespace {

std::int16_t snorm16(float value) {
    return static_cast<std::int16_t>(std::lround(value * 32767.0f));
}

// A block is surveyed as one where its people are lower than this and its depth is less than this share of its
// distance: every person then asks for what the middle one does, within a quarter, and few would be hidden alone.
constexpr float small_height_px = 9.0f;
constexpr float small_spread = 1.0f / 8;

}  // namespace

Selector::Selector(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                   std::span<const figures::Figure> figures, SelectOptions options)
    : crowd_(crowd),
      cast_(cast),
      figures_(figures.begin(), figures.end()),
      options_(options),
      acts_(crowd),
      depth_(std::make_unique_for_overwrite<float[]>(crowd.size())),
      far_keys_(crowd.size()) {
    for (const figures::Figure& figure : figures_) {
        Kind& kind = kinds_.emplace_back(Kind{.choices = figures::Choices(figure, *options_.way)});
        const motion::Bounds& box = figure.poses->box;
        const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
        kind.first_batch = frame_.batch_numbers;
        kind.keys = figures::splat_keys(*figure.poses);
        kind.center = glm::vec3(0.0f, box.center().y, 0.0f);
        kind.radius = glm::length(glm::vec3(reach.x, 0.5f * box.size().y, reach.z));
        kind.overhang = options_.way->overhang * std::sqrt(0.25f * figure.poses->area);
        frame_.batch_numbers += static_cast<std::uint32_t>(kind.choices.all().size() * figure.poses->pose_count);
    }
    know_blocks();
    const auto staleness = measure_staleness(crowd_, cast_, figures_);
    const auto spreads = find_spreads();
    std::vector<Forecaster::Kind> priced;
    std::vector<RateForecaster::Kind> exchanged;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        kinds_[i].staleness = staleness[i];
        priced.push_back({kinds_[i].choices, staleness[i], spreads[i]});
        const motion::PoseTable& poses = *figures_[i].poses;
        exchanged.push_back(
            {{&kinds_[i].choices, static_cast<double>(poses.area), static_cast<double>(poses.rest_height)},
             staleness[i]});
    }
    forecaster_ = Forecaster(std::move(priced), *options_.way, options_.density);
    rates_ = RateForecaster(std::move(exchanged), *options_.way);
    paces_ = Paces(kinds_.size());
}

void Selector::know_blocks() {
    turns_.resize(crowd_.size());
    tbb::parallel_for(std::size_t{0}, crowd_.size(), [&](std::size_t i) { turns_[i] = turn_of(crowd_.yaw[i]); });
    for (const scene::CrowdBlock& block : crowd_.blocks) {
        Block& known = blocks_.emplace_back();
        known.first_group = static_cast<std::uint32_t>(groups_.size());
        for (std::size_t person = block.first; person < block.first + block.count; ++person) {
            const std::size_t character = crowd_.character[person];
            const scene::Role role = crowd_.role[person];
            const Kind& kind = kinds_[character];
            const float scale = scale_of(person);
            overhang_ = std::max(overhang_, scale * kind.overhang);
            known.reach = std::max(known.reach, scale * kind.radius);
            known.tallest = std::max(known.tallest, crowd_.height[person]);
            known.stays &= !scene::follows_path(role);
            known.crowding.add(crowd_.position[person] + scale * kind.center, crowd_.height[person]);
            known.silhouette += 0.25f * figures_[character].poses->area * scale * scale;
            auto group = std::find_if(groups_.begin() + known.first_group, groups_.end(),
                                      [&](const Group& one) { return one.character == character && one.role == role; });
            if (group == groups_.end()) group = groups_.insert(group, {static_cast<std::uint32_t>(character), role});
            ++group->people;
            group->middle += crowd_.position[person] + scale * kind.center;
        }
        known.groups = static_cast<std::uint32_t>(groups_.size()) - known.first_group;
        known.silhouette /= static_cast<float>(block.count);
        for (Group& group : std::span(groups_).subspan(known.first_group))
            group.middle /= static_cast<float>(group.people);
    }
}

// By character: the squares of people's scales in shares of their mean, which is kept, at some equally frequent ones.
std::vector<std::vector<float>> Selector::find_spreads() {
    constexpr std::size_t most_people = 4096, shares = 16;
    std::vector<std::vector<float>> spreads(kinds_.size()), squares(kinds_.size());
    const std::size_t step = std::max<std::size_t>(1, crowd_.size() / (most_people * kinds_.size()));
    for (std::size_t person = 0; person < crowd_.size(); person += step)
        squares[crowd_.character[person]].push_back(scale_of(person) * scale_of(person));
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        std::vector<float>& sorted = squares[i];
        if (sorted.empty()) sorted.push_back(1.0f);
        std::ranges::sort(sorted);
        double sum = 0;
        for (const float square : sorted) sum += static_cast<double>(square);
        kinds_[i].mean_square = static_cast<float>(sum / static_cast<double>(sorted.size()));
        for (std::size_t share = 0; share < shares; ++share)
            spreads[i].push_back(sorted[(2 * share + 1) * sorted.size() / (2 * shares)] / kinds_[i].mean_square);
    }
    return spreads;
}

Turn Selector::turn_of(float yaw) {
    return {snorm16(std::sin(yaw)), snorm16(std::cos(yaw))};
}

template <typename Visit>
void Selector::for_each_visible(const Seen& seen, Visit visit) const {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    for (std::size_t person = block.first; person < block.first + block.count; ++person) {
        const float depth = seen.whole() ? depth_of(seen, person) : depth_[person];
        if (depth > 0) visit(person, depth);
    }
}

template <typename Work>
void Selector::for_each_seen(Work work) {
    tbb::parallel_for(
        std::size_t{0}, seen_.size(), [&](std::size_t i) { work(seen_[i]); }, tbb::static_partitioner());
}

const Survey& Selector::survey(const View& view, std::int64_t tick, const Surroundings& around) {
    view_ = view;
    tick_ = tick;
    around_ = around;
    survey_.hidden = 0;
    find_blocks();
    for_each_seen([&](Seen& seen) {
        if (!seen.whole()) find_visible(seen);
    });
    find_range();
    forecast();
    return survey_;
}

void Selector::find_blocks() {
    tbb::parallel_for(
        std::size_t{0}, blocks_.size(),
        [&](std::size_t block) {
            const View view = view_.from(crowd_.blocks[block].origin);
            blocks_[block].look = look_at(view, block);
            blocks_[block].small = is_small(view, block);
        },
        tbb::static_partitioner());
    seen_.clear();
    for (std::uint32_t block = 0; block < blocks_.size(); ++block) {
        const Look look = blocks_[block].look;
        if (look == Look::hidden) survey_.hidden += crowd_.blocks[block].count;
        if (look == Look::hidden || look == Look::outside) continue;
        Seen& seen = seen_.emplace_back();
        seen.block = block;
        seen.eye = view_.position - crowd_.blocks[block].origin;
        seen.inside = look == Look::inside;
        seen.small = blocks_[block].small;
        if (seen.whole()) seen.visible = crowd_.blocks[block].count;
    }
}

Selector::Look Selector::look_at(const View& view, std::size_t block) const {
    const motion::Bounds& box = crowd_.blocks[block].box;
    const Overlap seen = overlap(view, box);
    if (seen == Overlap::outside) return Look::outside;
    if (around_.occlusion && around_.occlusion->hides_box(view, {box.min - overhang_, box.max + overhang_}))
        return Look::hidden;
    return seen == Overlap::partly ? Look::partly : Look::inside;
}

// Whoever is as near as some radii may be drawn otherwise than their middle says.
bool Selector::is_small(const View& view, std::size_t block) const {
    const Block& known = blocks_[block];
    if (!known.stays || tick_ < crowd_.filled_tick || crowd_.size() < fewest_far_people) return false;
    const DepthRange depths = depth_range(view, crowd_.blocks[block].box);
    return depths.farthest - depths.nearest <= small_spread * depths.nearest &&
           depths.nearest >= options_.way->nearest * known.reach &&
           known.tallest * view.pixels_per_metre(depths.nearest) <= small_height_px;
}

void Selector::find_visible(Seen& seen) {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    for (std::size_t person = block.first; person < block.first + block.count; ++person) {
        const Kind& kind = kinds_[crowd_.character[person]];
        const float scale = scale_of(person), radius = scale * kind.radius;
        const glm::vec3 middle = middle_of(seen, person);
        float& depth = depth_[person];
        if ((!seen.inside && !sphere_visible(view_, middle, radius)) || !scene::has_arrived(crowd_, person, tick_))
            depth = unseen;
        else if (around_.occlusion && around_.occlusion->hides_ball(view_, middle, radius + scale * kind.overhang))
            depth = behind;
        else
            depth = std::max(view_.depth(middle), near_plane);
        seen.range = std::max(seen.range, depth);
        seen.visible += depth > 0;
        seen.hidden += depth == behind;
    }
}

// Of blocks of which all people show, only people of those are looked at that may reach beyond all others: no block's
// farthest is nearer than its middle.
void Selector::find_range() {
    survey_.range = 1.0f;
    float reached = 1.0f;
    for (const Seen& seen : seen_) {
        survey_.hidden += seen.hidden;
        survey_.range = std::max(survey_.range, seen.range);
        if (!seen.whole()) continue;
        for (const Group& group : groups_of(seen))
            reached = std::max(reached, view_.depth(relative(group.middle, seen.eye)));
    }
    reached = std::max(reached, survey_.range);
    for (const Seen& seen : seen_) {
        if (!seen.whole()) continue;
        const scene::CrowdBlock& block = crowd_.blocks[seen.block];
        if (depth_range(view_.from(block.origin), block.box).farthest < reached) continue;
        for_each_visible(seen, [&](std::size_t, float depth) { survey_.range = std::max(survey_.range, depth); });
    }
}

void Selector::forecast() {
    find_shares();
    forecaster_.begin(survey_.range);
    rates_.begin(static_cast<double>(view_.width) * view_.height, survey_.range);
    for (const Seen& seen : seen_) {
        if (seen.small) {
            forecast_as_one(seen);
            continue;
        }
        RateForecaster::Group one{.people = 1, .share = seen.share, .place = seen.place};
        for_each_visible(seen, [&](std::size_t person, float depth) {
            const float demand = demand_at_unit_splat(person, depth);
            one.kind = crowd_.character[person];
            one.role = crowd_.role[person];
            one.depth = depth;
            one.pixels_per_metre = view_.pixels_per_metre(depth);
            one.surface = surface_of(person, depth);
            one.on_screen = on_screen(seen, person, one.surface);
            forecaster_.add(one.kind, one.role, depth, demand, one.pixels_per_metre);
            rates_.add(one);
        });
    }
    survey_.forecast = forecaster_.finish(options_.theta);
    survey_.forecast.frame += around_.work;
    survey_.forecast.rates = rates_.finish();
    survey_.background_error = around_.background_error * (1 - rates_.covered());
}

void Selector::find_shares() {
    for_each_seen([&](Seen& seen) {
        const Block& known = blocks_[seen.block];
        const glm::vec3 away = relative(crowd_.blocks[seen.block].box.center(), seen.eye);
        seen.share = known.stays && glm::dot(away, away) > 0 ? known.crowding.visible_share(away, known.silhouette) : 1;
        seen.place = Exchange::place_of(seen.share);
    });
}

// Of somebody large who is partly beside the picture; who is smaller counts as in it.
float Selector::on_screen(const Seen& seen, std::size_t person, float surface) const {
    constexpr float large = 4000;  // [px^2]
    if (!(surface > large)) return 1;
    const glm::vec3 middle = middle_of(seen, person);
    const float depth = std::max(view_.depth(middle), near_plane), pixels = view_.pixels_per_metre(depth);
    const float high = crowd_.height[person] * pixels, wide = 0.4f * high;
    const auto overlap = [](float at, float side, float picture) {
        const float low = std::max(at - 0.5f * side, -0.5f * picture), end = std::min(at + 0.5f * side, 0.5f * picture);
        return std::max(end - low, 0.0f) / side;
    };
    return overlap(pixels * glm::dot(view_.right, middle), wide, static_cast<float>(view_.width)) *
           overlap(pixels * glm::dot(view_.up, middle), high, static_cast<float>(view_.height));
}

// Those of its people who show are shared out over its groups as all of them are.
void Selector::forecast_as_one(const Seen& seen) {
    const std::uint64_t all = crowd_.blocks[seen.block].count;
    std::uint64_t before = 0;
    for (const Group& group : groups_of(seen)) {
        const std::uint64_t until = before + group.people;
        const std::uint64_t people = until * seen.visible / all - before * seen.visible / all;
        const float depth = depth_of(seen, group);
        const float demand = mean_demand_of(seen, group), pixels = view_.pixels_per_metre(depth);
        forecaster_.add_block(group.character, group.role, static_cast<std::int64_t>(people), depth, demand, pixels);
        rates_.add({.kind = group.character,
                    .role = group.role,
                    .people = static_cast<std::int64_t>(people),
                    .is_block = true,
                    .depth = depth,
                    .pixels_per_metre = pixels,
                    .surface = demand / options_.density,
                    .share = seen.share,
                    .place = seen.place});
        before = until;
    }
}

std::span<const Selector::Group> Selector::groups_of(const Seen& seen) const {
    return std::span(groups_).subspan(blocks_[seen.block].first_group, blocks_[seen.block].groups);
}

const Frame& Selector::select(const sfsm::Decision& decision, std::int64_t last_tick) {
    if (decision.rate > 0) {
        rates_.exchange().find_terms(decision.rate, rates_.cell_of(decision.rate), terms_);
        rates_.find_paces(decision.rate, paces_);
    }
    find_far_blocks(decision);
    make_room();
    const Rules rules{decision, last_tick};
    for_each_seen([&](Seen& seen) { seen.is_far ? choose_as_one(seen, rules) : choose(seen, rules); });
    frame_.far_people = {&crowd_, turns_.data(), far_keys_.data()};
    frame_.view = view_;
    frame_.splat_size = decision.rate > 0 ? splat_size_of(terms_) : decision.splat_size;
    sum_up();
    return frame_;
}

// S that makes cells as large as the terms have them or, where points have a size, as large as their spacing asks for.
double Selector::splat_size_of(const Exchange::Terms& terms) const {
    const double pixels = options_.way->has_cells ? static_cast<double>(terms.cell) / figures::cell_share
                                                  : std::sqrt(static_cast<double>(options_.density)) * terms.spacing;
    return std::min(pixels, sfsm::max_splat_size);
}

// Where one splat serves people of mean size of each kind.
void Selector::find_far_blocks(const sfsm::Decision& decision) {
    for (Seen& seen : seen_)
        seen.is_far = seen.small && (decision.rate > 0 || decision.splat_size > 0) &&
                      std::ranges::all_of(groups_of(seen), [&](const Group& group) {
                          const float demand = mean_demand_of(seen, group);
                          if (!(decision.rate > 0))
                              return forecaster_.serves_block(group.character, demand, decision.splat_size);
                          return demand / options_.density <= terms_.sizes(group.character, seen.place).splat_to;
                      });
}

// Each block's people have a place in the frame that is known beforehand: any thread may write them.
void Selector::make_room() {
    std::size_t people = 0, far_blocks = 0;
    for (Seen& seen : seen_) {
        seen.first_drawn = static_cast<std::uint32_t>(seen.is_far ? far_blocks : people);
        (seen.is_far ? far_blocks : people) += seen.is_far ? 1 : seen.visible;
    }
    resize_anew(frame_.people, people, crowd_.size());
    frame_.far_blocks.resize(far_blocks);
}

void Selector::choose(Seen& seen, const Rules& rules) {
    seen.work = {};
    seen.error = 0;
    seen.slowed = seen.simplified = false;
    Person* drawn = frame_.people.data() + seen.first_drawn;
    for_each_visible(seen, [&](std::size_t person, float depth) { *drawn++ = choose(person, depth, rules, seen); });
}

// All of them move in the same frames, and their keys, which are a good part of a second apart, are found every few
// ticks.
void Selector::choose_as_one(Seen& seen, const Rules& rules) {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    const float depth = std::max(view_.depth(relative(block.box.center(), seen.eye)), near_plane);
    const auto [period, due] = moves_of(block.first, depth, rules);
    constexpr int ticks_a_key = 8;
    const std::int64_t key_tick = motion::due_tick(due, ticks_a_key, crowd_.hash[block.first]);
    std::int64_t& known = blocks_[seen.block].key_tick;
    if (key_tick != known) {
        for (std::size_t person = block.first; person < block.first + block.count; ++person) {
            const figures::SplatKeys& keys = kinds_[crowd_.character[person]].keys;
            far_keys_[person] = keys.of_pose[pose_of(person, key_tick)];
        }
        known = key_tick;
    }
    seen.work = {};
    seen.work[sfsm::WorkKind::motion_update] = due > rules.last_tick ? seen.visible : 0;
    seen.slowed = period > 1;
    seen.simplified = true;
    frame_.far_blocks[seen.first_drawn] = {seen.block, depth, key_tick};
}

void Selector::sum_up() {
    frame_.work = around_.work;
    bool is_slowed = false, is_simplified = false;
    for (const Seen& seen : seen_) {
        frame_.work += seen.work;
        frame_.work[sfsm::WorkKind::person] += seen.visible;
        is_slowed |= seen.slowed;
        is_simplified |= seen.simplified;
    }
    frame_.state = is_simplified ? sfsm::State::points : is_slowed ? sfsm::State::slowed : sfsm::State::original;
}

float Selector::scale_of(std::size_t person) const {
    return crowd_.height[person] / figures_[crowd_.character[person]].poses->rest_height;
}

glm::vec3 Selector::middle_of(const Seen& seen, std::size_t person) const {
    return spot_of(seen, person, tick_).position + scale_of(person) * kinds_[crowd_.character[person]].center;
}

Selector::Spot Selector::spot_of(const Seen& seen, std::size_t person, std::int64_t tick) const {
    if (!scene::follows_path(crowd_.role[person])) return {relative(crowd_.position[person], seen.eye), turns_[person]};
    const scene::Placement placement = scene::place(crowd_, person, cast_[crowd_.character[person]], tick);
    return {relative(placement.position, seen.eye), turn_of(placement.yaw)};
}

float Selector::depth_of(const Seen& seen, std::size_t person) const {
    return std::max(view_.depth(middle_of(seen, person)), near_plane);
}

float Selector::depth_of(const Seen& seen, const Group& group) const {
    return std::max(view_.depth(relative(group.middle, seen.eye)), near_plane);
}

float Selector::demand_at_unit_splat(std::size_t person, float depth) const {
    const std::size_t character = crowd_.character[person];
    const float scale = scale_of(person);
    if (depth < options_.way->nearest * scale * kinds_[character].radius) return std::numeric_limits<float>::infinity();
    const float pixels = scale * view_.pixels_per_metre(depth);
    return options_.density * figures_[character].poses->area * pixels * pixels;
}

float Selector::mean_demand_of(const Seen& seen, const Group& group) const {
    const float pixels = view_.pixels_per_metre(depth_of(seen, group));
    return options_.density * figures_[group.character].poses->area * kinds_[group.character].mean_square * pixels *
           pixels;
}

float Selector::surface_of(std::size_t person, float depth) const {
    const float pixels = scale_of(person) * view_.pixels_per_metre(depth);
    return figures_[crowd_.character[person]].poses->area * pixels * pixels;
}

Selector::Moves Selector::moves_of(std::size_t person, float depth, const Rules& rules) const {
    const sfsm::Decision& decision = rules.decision;
    int period = 1;
    if (rules.by_rate())
        period = paces_.period(crowd_.character[person], crowd_.role[person], view_.pixels_per_metre(depth));
    else if (decision.state != sfsm::State::original)
        period = motion::update_period(depth, static_cast<float>(decision.motion_distance), options_.theta);
    return {period, motion::due_tick(tick_, period, crowd_.hash[person])};
}

std::uint32_t Selector::pose_of(std::size_t person, std::int64_t tick) {
    const std::size_t character = crowd_.character[person];
    const motion::PoseTable& poses = *figures_[character].poses;
    const scene::Action action = acts_.at(person, cast_[character], poses, tick);
    return static_cast<std::uint32_t>(poses.pose_at(action.clip, action.clip_tick));
}

// Which choice, and how many samples are asked of it.
std::pair<std::uint32_t, float> Selector::shape_of(std::size_t person, float demand, const Rules& rules,
                                                   const Seen& seen) const {
    const figures::Choices& choices = kinds_[crowd_.character[person]].choices;
    if (rules.by_rate()) {
        const Exchange::Terms::Sizes sizes = terms_.sizes(crowd_.character[person], seen.place);
        const float surface = demand / options_.density;
        const float samples = surface / (sizes.spacing * sizes.spacing);
        return {surface < sizes.mesh_from ? choices.samples_at(samples) : choices.exact(), samples};
    }
    const auto splat_area = static_cast<float>(rules.decision.splat_size * rules.decision.splat_size);
    if (!(splat_area > 0)) return {choices.exact(), 0.0f};
    return {choices.at(demand / splat_area), demand / splat_area};
}

// Where the person is now decides whether they are seen and how often they move; both change little in a period.
Person Selector::choose(std::size_t person, float depth, const Rules& rules, Seen& seen) {
    const std::size_t character = crowd_.character[person];
    const scene::CastMember& member = cast_[character];
    const motion::PoseTable& poses = *figures_[character].poses;
    const auto [period, due] = moves_of(person, depth, rules);
    const auto [choice, samples] = shape_of(person, demand_at_unit_splat(person, depth), rules, seen);
    const auto& [representation, level] = kinds_[character].choices.all()[choice];
    const figures::Part part = figures::part_of(level, samples);
    const std::uint32_t pose = pose_of(person, due);
    const Spot spot = spot_of(seen, person, due);
    const bool stands = crowd_.role[person] != scene::Role::spectator || !member.sits;
    seen.work += part.work;
    seen.work[sfsm::WorkKind::motion_update] += due > rules.last_tick;
    seen.slowed |= period > 1;
    seen.simplified |= !options_.way->representations[representation].is_mesh;
    return {{spot.position, scale_of(person), spot.turn, crowd_.palette[person]},
            static_cast<std::uint32_t>(character),
            representation,
            level.first,
            part.count,
            part.last_share,
            pose,
            kinds_[character].first_batch + choice * static_cast<std::uint32_t>(poses.pose_count) + pose,
            depth,
            stands ? contact_reach * crowd_.height[person] : 0.0f};
}

}  // namespace render
