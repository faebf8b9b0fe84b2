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
      sights_(std::make_unique_for_overwrite<Sight[]>(crowd.size())),
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
    bounds_ = measure_error_bounds(crowd_, cast_, figures_);
    const auto spreads = find_spreads();
    std::vector<Forecaster::Kind> priced;
    std::vector<RateForecaster::Kind> exchanged;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        kinds_[i].staleness = staleness[i];
        know_reach(i);
        priced.push_back({kinds_[i].choices, staleness[i], spreads[i]});
        const motion::PoseTable& poses = *figures_[i].poses;
        exchanged.push_back(
            {{&kinds_[i].choices, static_cast<double>(poses.area), static_cast<double>(poses.rest_height)},
             staleness[i],
             &bounds_[i],
             kinds_[i].radius});
    }
    forecaster_ = Forecaster(std::move(priced), *options_.way, options_.density);
    rates_ = RateForecaster(std::move(exchanged), *options_.way);
}

// In every pose people are within their ball, but who goes somewhere takes it along.
void Selector::know_reach(std::size_t kind) {
    for (std::size_t role = 0; role < scene::role_count; ++role) {
        const float way = scene::follows_path(static_cast<scene::Role>(role))
                              ? bounds_[kind].motion.single[role][motion::max_period]
                              : 0.0f;
        kinds_[kind].reach[role] = kinds_[kind].radius + way;
    }
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
        if (seen.whole())
            visit(person, sight_of(person, middle_of(seen, person)));
        else if (sights_[person].depth > 0)
            visit(person, sights_[person]);
    }
}

template <typename Work>
void Selector::for_each_seen(Work work) {
    tbb::parallel_for(std::size_t{0}, seen_.size(), [&](std::size_t i) { work(seen_[i]); });
}

const Survey& Selector::survey(const View& view, std::int64_t tick, const Surroundings& around) {
    view_ = view;
    tick_ = tick;
    around_ = around;
    limit_ = ErrorLimit(view, options_.max_error);
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
           depths.nearest >= exact_within(known.reach, known.reach) &&
           known.tallest * view.pixels_per_metre(depths.nearest) <= small_height_px;
}

void Selector::find_visible(Seen& seen) {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    for (std::size_t person = block.first; person < block.first + block.count; ++person) {
        const Kind& kind = kinds_[crowd_.character[person]];
        const float scale = scale_of(person), radius = scale * kind.radius;
        const glm::vec3 middle = middle_of(seen, person);
        Sight& sight = sights_[person];
        if ((!seen.inside && !sphere_visible(view_, middle, radius)) || !scene::has_arrived(crowd_, person, tick_))
            sight.depth = unseen;
        else if (around_.occlusion && around_.occlusion->hides_ball(view_, middle, radius + scale * kind.overhang))
            sight.depth = behind;
        else
            sight = sight_of(person, middle);
        seen.range = std::max(seen.range, sight.depth);
        seen.visible += sight.depth > 0;
        seen.hidden += sight.depth == behind;
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
        for_each_visible(
            seen, [&](std::size_t, const Sight& sight) { survey_.range = std::max(survey_.range, sight.depth); });
    }
}

void Selector::forecast() {
    find_shares();
    forecaster_.begin(survey_.range);
    rates_.begin(view_, limit_);
    for (const Seen& seen : seen_) {
        if (seen.small) {
            forecast_as_one(seen);
            continue;
        }
        RateForecaster::Group one{.people = 1, .share = seen.share, .place = seen.place};
        for_each_visible(seen, [&](std::size_t person, const Sight& sight) {
            one.kind = crowd_.character[person];
            one.role = crowd_.role[person];
            one.depth = sight.depth;
            one.pixels_per_metre = view_.pixels_per_metre(sight.depth);
            one.surface = sight.surface;
            one.on_screen = sight.on_screen;
            one.is_near = std::isinf(sight.demand);
            forecaster_.add(one.kind, one.role, sight.depth, sight.demand, one.pixels_per_metre);
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

// Of somebody large who is partly beside the picture; who is smaller counts as in it. Nobody shows on more than all of
// it.
float Selector::on_screen(std::size_t person, const glm::vec3& middle, float depth, float surface) const {
    constexpr float large = 4000;  // [px^2]
    const auto width = static_cast<float>(view_.width), height = static_cast<float>(view_.height);
    if (!(surface > std::min(large, width * height))) return 1;
    const float pixels = view_.pixels_per_metre(depth);
    const float high = crowd_.height[person] * pixels, wide = 0.4f * high;
    const auto overlap = [](float at, float side, float picture) {
        const float low = std::max(at - 0.5f * side, -0.5f * picture), end = std::min(at + 0.5f * side, 0.5f * picture);
        return std::max(end - low, 0.0f) / side;
    };
    constexpr float least = 0.05f;  // an arm may reach into it
    const float inside = overlap(pixels * glm::dot(view_.right, middle), wide, width) *
                         overlap(pixels * glm::dot(view_.up, middle), high, height);
    return std::min(std::max(inside, least), width * height / (0.25f * surface));
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
    if (!(decision.rate > 0)) return select(KnobRule(decision, forecaster_, options_.theta), last_tick);
    rate_rule_.decide(decision.rate, options_.density);
    return select(rate_rule_, last_tick);
}

const Frame& Selector::select(const DrawingRule& rule, std::int64_t last_tick) {
    find_far_blocks(rule);
    make_room();
    frame_.splat_size = rule.splat_size();
    points_errors_ = figures::PointsErrors(options_.way->error, cell());
    for_each_seen(
        [&](Seen& seen) { seen.is_far ? choose_as_one(seen, rule, last_tick) : choose(seen, rule, last_tick); });
    sum_up();
    frame_.far_people = {&crowd_, turns_.data(), far_keys_.data()};
    frame_.view = view_;
    return frame_;
}

// Where one splat serves people of mean size of each kind.
void Selector::find_far_blocks(const DrawingRule& rule) {
    for (Seen& seen : seen_)
        seen.is_far = seen.small && std::ranges::all_of(groups_of(seen), [&](const Group& group) {
                          return rule.is_splat(subject_of(group, seen));
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

void Selector::choose(Seen& seen, const DrawingRule& rule, std::int64_t last_tick) {
    seen.work = {};
    seen.errors = {};
    seen.slowed = seen.simplified = false;
    Person* drawn = frame_.people.data() + seen.first_drawn;
    for_each_visible(
        seen, [&](std::size_t person, const Sight& sight) { *drawn++ = choose(person, sight, rule, last_tick, seen); });
}

// All of them move in the same frames, and their keys, which are a good part of a second apart, are found every few
// ticks.
void Selector::choose_as_one(Seen& seen, const DrawingRule& rule, std::int64_t last_tick) {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    const float depth = std::max(view_.depth(relative(block.box.center(), seen.eye)), near_plane);
    int period = motion::max_period;
    for (const Group& group : groups_of(seen)) {
        Subject subject = subject_of(group, seen);
        subject.depth = depth;
        subject.pixels_per_metre = view_.pixels_per_metre(depth);
        period = std::min(period, rule.period_of(subject));
    }
    const std::int64_t due = motion::due_tick(tick_, period, crowd_.hash[block.first]);
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
    seen.work[sfsm::WorkKind::motion_update] = due > last_tick ? seen.visible : 0;
    seen.errors = {};
    for (const Group& group : groups_of(seen))
        add_errors(group, subject_of(group, seen), period,
                   static_cast<double>(group.people) * seen.visible / block.count, seen);
    seen.slowed = period > 1;
    seen.simplified = true;
    frame_.far_blocks[seen.first_drawn] = {seen.block, depth, key_tick};
}

void Selector::sum_up() {
    frame_.work = around_.work;
    Errors all;
    bool is_slowed = false, is_simplified = false;
    for (const Seen& seen : seen_) {
        frame_.work += seen.work;
        frame_.work[sfsm::WorkKind::person] += seen.visible;
        all.expected += seen.errors.expected;
        all.motion_px = std::max(all.motion_px, seen.errors.motion_px);
        all.splat_px = std::max(all.splat_px, seen.errors.splat_px);
        is_slowed |= seen.slowed;
        is_simplified |= seen.simplified;
    }
    frame_.state = is_simplified ? sfsm::State::points : is_slowed ? sfsm::State::slowed : sfsm::State::original;
    frame_.max_motion_px = all.motion_px;
    frame_.max_splat_px = all.splat_px;
    frame_.expected_flip = survey_.background_error + all.expected / rates_.canvas_px();
}

// [px] Of the frame.
double Selector::cell() const {
    return options_.way->has_cells ? std::max(1.0, figures::cell_share * frame_.splat_size) : 1;
}

void Selector::add_errors(std::size_t number, const Sight& sight, const Person& person, const Subject& subject,
                          int period, Seen& seen) const {
    const figures::Way& way = *options_.way;
    const ErrorBounds& bounds = bounds_[person.character];
    const float scale = person.instance.scale, reach = reach_of(number);
    double error = 0;
    if (way.representations[person.representation].is_mesh) {
        const float height = scale * figures_[person.character].poses->rest_height * subject.pixels_per_metre;
        error = way.error.of_mesh(static_cast<double>(height));
    } else {
        error = points_errors_.at(std::sqrt(sight.surface / static_cast<float>(person.count)));
        seen.errors.splat_px = std::max(
            seen.errors.splat_px, limit_.pixels(scale * bounds.covering.radius(person.count), reach, person.depth));
    }
    if (period > 1) {
        const auto role = static_cast<std::size_t>(subject.role), index = static_cast<std::size_t>(period);
        error += way.error.of_motion(
            static_cast<double>(kinds_[person.character].staleness[role][index] * subject.pixels_per_metre));
        seen.errors.motion_px = std::max(seen.errors.motion_px,
                                         limit_.pixels(scale * bounds.motion.single[role][index], reach, person.depth));
    }
    seen.errors.expected += error * static_cast<double>(0.25f * sight.surface * seen.share * sight.on_screen);
}

void Selector::add_errors(const Group& group, const Subject& subject, int period, double people, Seen& seen) const {
    const figures::Way& way = *options_.way;
    const Kind& kind = kinds_[group.character];
    const ErrorBounds& bounds = bounds_[group.character];
    const auto role = static_cast<std::size_t>(group.role), index = static_cast<std::size_t>(period);
    const double height = static_cast<double>(std::sqrt(kind.mean_square) *
                                              figures_[group.character].poses->rest_height * subject.pixels_per_metre);
    const double error =
        way.error.of_splat(height) * way.error.times_in_cells(cell()) +
        way.error.of_motion(static_cast<double>(kind.staleness[role][index] * subject.pixels_per_metre));
    seen.errors.expected += people * error * static_cast<double>(0.25f * subject.surface * seen.share);
    const float nearest = nearest_of(seen), scale = largest_of(seen, group);
    seen.errors.splat_px = std::max(seen.errors.splat_px, limit_.pixels(scale * bounds.size, 0.0f, nearest));
    seen.errors.motion_px =
        std::max(seen.errors.motion_px, limit_.pixels(scale * bounds.motion.far[role][index], 0.0f, nearest));
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

Selector::Sight Selector::sight_of(std::size_t person, const glm::vec3& middle) const {
    const std::size_t character = crowd_.character[person];
    const float scale = scale_of(person), area = figures_[character].poses->area;
    Sight sight;
    sight.depth = std::max(view_.depth(middle), near_plane);
    const float pixels = scale * view_.pixels_per_metre(sight.depth);
    sight.surface = area * pixels * pixels;
    sight.demand = sight.depth < exact_within(scale * kinds_[character].radius, reach_of(person))
                       ? std::numeric_limits<float>::infinity()
                       : options_.density * area * pixels * pixels;
    sight.on_screen = on_screen(person, middle, sight.depth, sight.surface);
    return sight;
}

float Selector::depth_of(const Seen& seen, const Group& group) const {
    return std::max(view_.depth(relative(group.middle, seen.eye)), near_plane);
}

float Selector::reach_of(std::size_t person) const {
    return scale_of(person) * kinds_[crowd_.character[person]].reach[static_cast<std::size_t>(crowd_.role[person])];
}

// Points before the near plane don't show: what they stand for would be far from any that does.
float Selector::exact_within(float radius, float reach) const {
    return std::max(options_.way->nearest * radius, near_plane + reach);
}

float Selector::mean_demand_of(const Seen& seen, const Group& group) const {
    const float pixels = view_.pixels_per_metre(depth_of(seen, group));
    return options_.density * figures_[group.character].poses->area * kinds_[group.character].mean_square * pixels *
           pixels;
}

Subject Selector::subject_of(std::size_t person, const Sight& sight, const Seen& seen) const {
    Subject subject{
        crowd_.character[person],        crowd_.role[person], sight.depth, view_.pixels_per_metre(sight.depth),
        sight.demand / options_.density, sight.demand,        seen.place};
    if (!limit_.is_set()) return subject;
    const float scale = scale_of(person);
    subject.allowed = limit_.off(reach_of(person), sight.depth) / scale;
    return subject;
}

Subject Selector::subject_of(const Group& group, const Seen& seen) const {
    const float depth = depth_of(seen, group), demand = mean_demand_of(seen, group);
    Subject subject{group.character,           group.role, depth,      view_.pixels_per_metre(depth),
                    demand / options_.density, demand,     seen.place, true};
    if (limit_.is_set()) subject.allowed = limit_.off(0, nearest_of(seen)) / largest_of(seen, group);
    return subject;
}

float Selector::nearest_of(const Seen& seen) const {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    return std::max(depth_range(view_.from(block.origin), block.box).nearest, near_plane);
}

float Selector::largest_of(const Seen& seen, const Group& group) const {
    return blocks_[seen.block].tallest / figures_[group.character].poses->rest_height;
}

std::uint32_t Selector::pose_of(std::size_t person, std::int64_t tick) {
    const std::size_t character = crowd_.character[person];
    const motion::PoseTable& poses = *figures_[character].poses;
    const scene::Action action = acts_.at(person, cast_[character], poses, tick);
    return static_cast<std::uint32_t>(poses.pose_at(action.clip, action.clip_tick));
}

// Where the person is now decides whether they are seen and how often they move; both change little in a period.
Person Selector::choose(std::size_t person, const Sight& sight, const DrawingRule& rule, std::int64_t last_tick,
                        Seen& seen) {
    const std::size_t character = crowd_.character[person];
    const scene::CastMember& member = cast_[character];
    const motion::PoseTable& poses = *figures_[character].poses;
    const Subject subject = subject_of(person, sight, seen);
    const int period = rule.period_of(subject);
    const std::int64_t due = motion::due_tick(tick_, period, crowd_.hash[person]);
    const auto [choice, samples] = rule.shape_of(subject);
    const auto& [representation, level] = kinds_[character].choices.all()[choice];
    const figures::Part part = figures::part_of(level, samples);
    const std::uint32_t pose = pose_of(person, due);
    const Spot spot = spot_of(seen, person, due);
    const bool stands = crowd_.role[person] != scene::Role::spectator || !member.sits;
    seen.work += part.work;
    seen.work[sfsm::WorkKind::motion_update] += due > last_tick;
    seen.slowed |= period > 1;
    seen.simplified |= !options_.way->representations[representation].is_mesh;
    const Person drawn{{spot.position, scale_of(person), spot.turn, crowd_.palette[person]},
                       static_cast<std::uint32_t>(character),
                       representation,
                       level.first,
                       part.count,
                       part.last_share,
                       pose,
                       kinds_[character].first_batch + choice * static_cast<std::uint32_t>(poses.pose_count) + pose,
                       sight.depth,
                       stands ? contact_reach * crowd_.height[person] : 0.0f};
    add_errors(person, sight, drawn, subject, period, seen);
    return drawn;
}

}  // namespace render
