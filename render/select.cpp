#include "render/select.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {

namespace {

std::int16_t snorm16(float value) {
    return static_cast<std::int16_t>(std::lround(value * 32767.0f));
}

}  // namespace

Selector::Selector(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                   std::span<const figures::Figure> figures, SelectOptions options)
    : crowd_(crowd),
      cast_(cast),
      figures_(figures.begin(), figures.end()),
      options_(options),
      acts_(crowd),
      depth_(crowd.size()) {
    for (const figures::Figure& figure : figures_) {
        Kind& kind = kinds_.emplace_back(Kind{figures::Choices(figure, *options_.way)});
        const motion::Bounds& box = figure.poses->box;
        const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
        kind.first_batch = frame_.batch_numbers;
        kind.center = glm::vec3(0.0f, box.center().y, 0.0f);
        kind.radius = glm::length(glm::vec3(reach.x, 0.5f * box.size().y, reach.z));
        kind.overhang = options_.way->overhang * std::sqrt(0.25f * figure.poses->area);
        frame_.batch_numbers += static_cast<std::uint32_t>(kind.choices.all().size() * figure.poses->pose_count);
    }
    for (std::size_t person = 0; person < crowd_.size(); ++person)
        overhang_ = std::max(overhang_, scale_of(person) * kinds_[crowd_.character[person]].overhang);
    const auto staleness = measure_staleness(crowd_, cast_, figures_);
    std::vector<Forecaster::Kind> priced;
    for (std::size_t i = 0; i < kinds_.size(); ++i) priced.push_back({kinds_[i].choices, staleness[i]});
    forecaster_ = Forecaster(std::move(priced), *options_.way, options_.density);
}

template <typename Visit>
void Selector::for_each_visible(Visit visit) const {
    for (const Seen& seen : seen_) {
        const scene::CrowdBlock& block = crowd_.blocks[seen.block];
        for (std::size_t person = block.first; person < block.first + block.count; ++person)
            if (depth_[person] > 0) visit(person);
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
    for_each_seen([&](Seen& seen) { find_visible(seen); });
    forecast();
    return survey_;
}

void Selector::find_blocks() {
    seen_.clear();
    for (std::uint32_t block = 0; block < crowd_.blocks.size(); ++block) {
        const scene::CrowdBlock& people = crowd_.blocks[block];
        const Overlap seen = overlap(view_, people.box);
        if (seen == Overlap::outside) continue;
        if (around_.occlusion &&
            around_.occlusion->hides_box(view_, {people.box.min - overhang_, people.box.max + overhang_})) {
            survey_.hidden += people.count;
            continue;
        }
        Seen& shown = seen_.emplace_back();
        shown.block = block;
        shown.inside = seen == Overlap::inside;
    }
}

void Selector::find_visible(Seen& seen) {
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    const bool cull = !seen.inside;
    for (std::size_t person = block.first; person < block.first + block.count; ++person) {
        const std::size_t character = crowd_.character[person];
        const Kind& kind = kinds_[character];
        const float scale = scale_of(person), radius = scale * kind.radius;
        const scene::Placement now = scene::place(crowd_, person, cast_[character], tick_);
        const glm::vec3 center = view_.relative(now.position) + scale * kind.center;
        float& depth = depth_[person];
        if ((cull && !sphere_visible(view_, center, radius)) || !scene::has_arrived(crowd_, person, tick_))
            depth = unseen;
        else if (around_.occlusion && around_.occlusion->hides_ball(view_, center, radius + scale * kind.overhang))
            depth = behind;
        else
            depth = std::max(view_.depth(center), near_plane);
        seen.range = std::max(seen.range, depth);
        seen.visible += depth > 0;
        seen.hidden += depth == behind;
    }
}

void Selector::forecast() {
    survey_.range = 1.0f;
    for (const Seen& seen : seen_) {
        survey_.range = std::max(survey_.range, seen.range);
        survey_.hidden += seen.hidden;
    }
    forecaster_.begin(survey_.range);
    for_each_visible([&](std::size_t person) {
        const std::size_t character = crowd_.character[person];
        forecaster_.add(character, crowd_.role[person], depth_[person], demand_at_unit_splat(person),
                        view_.pixels_per_metre(depth_[person]));
    });
    survey_.forecast = forecaster_.finish(options_.theta);
    survey_.forecast.frame += around_.work;
}

const Frame& Selector::select(const sfsm::Decision& decision, std::int64_t last_tick) {
    make_room();
    for_each_seen([&](Seen& seen) { choose(seen, decision, last_tick); });
    sum_up();
    frame_.view = view_;
    frame_.splat_size = decision.splat_size;
    return frame_;
}

// Each block's people have a place in the frame that is known beforehand: any thread may write them.
void Selector::make_room() {
    std::size_t people = 0;
    for (Seen& seen : seen_) {
        seen.first_drawn = static_cast<std::uint32_t>(people);
        people += seen.visible;
    }
    // Not twice as much as is needed, which a vector would take.
    if (people > frame_.people.capacity()) frame_.people.reserve(std::min(people + people / 4, crowd_.size()));
    frame_.people.resize(people);
}

void Selector::choose(Seen& seen, const sfsm::Decision& decision, std::int64_t last_tick) {
    seen.work = {};
    seen.slowed = seen.simplified = false;
    const scene::CrowdBlock& block = crowd_.blocks[seen.block];
    Person* drawn = frame_.people.data() + seen.first_drawn;
    for (std::size_t person = block.first; person < block.first + block.count; ++person)
        if (depth_[person] > 0) *drawn++ = choose(person, decision, last_tick, seen);
}

void Selector::sum_up() {
    frame_.work = around_.work;
    bool is_slowed = false, is_simplified = false;
    for (const Seen& seen : seen_) {
        frame_.work += seen.work;
        is_slowed |= seen.slowed;
        is_simplified |= seen.simplified;
    }
    frame_.work[sfsm::WorkKind::person] += static_cast<std::int64_t>(frame_.people.size());
    frame_.state = is_simplified ? sfsm::State::points : is_slowed ? sfsm::State::slowed : sfsm::State::original;
}

float Selector::scale_of(std::size_t person) const {
    return crowd_.height[person] / figures_[crowd_.character[person]].poses->rest_height;
}

float Selector::demand_at_unit_splat(std::size_t person) const {
    const std::size_t character = crowd_.character[person];
    const float scale = scale_of(person);
    if (depth_[person] < options_.way->nearest * scale * kinds_[character].radius)
        return std::numeric_limits<float>::infinity();
    const float pixels = scale * view_.pixels_per_metre(depth_[person]);
    return options_.density * figures_[character].poses->area * pixels * pixels;
}

// Where the person is now decides whether they are seen and how often they move; both change little in a period.
Person Selector::choose(std::size_t person, const sfsm::Decision& decision, std::int64_t last_tick, Seen& seen) {
    const std::size_t character = crowd_.character[person];
    const scene::CastMember& member = cast_[character];
    const motion::PoseTable& poses = *figures_[character].poses;
    int period = 1;
    if (decision.state != sfsm::State::original)
        period = motion::update_period(depth_[person], static_cast<float>(decision.motion_distance), options_.theta);
    const std::int64_t due = motion::due_tick(tick_, period, crowd_.hash[person]);
    const auto splat_area = static_cast<float>(decision.splat_size * decision.splat_size);
    const figures::Choices& choices = kinds_[character].choices;
    const float demand = splat_area > 0 ? demand_at_unit_splat(person) / splat_area : 0.0f;
    const std::uint32_t choice = splat_area > 0 ? choices.at(demand) : choices.exact();
    const auto& [representation, level] = choices.all()[choice];
    const figures::Part part = figures::part_of(level, demand);
    const scene::Action action = acts_.at(person, member, poses, due);
    const auto pose = static_cast<std::uint32_t>(poses.pose_at(action.clip, action.clip_tick));
    const scene::Placement placement = scene::place(crowd_, person, member, due);
    seen.work += part.work;
    seen.work[sfsm::WorkKind::motion_update] += due > last_tick;
    seen.slowed |= period > 1;
    seen.simplified |= !options_.way->representations[representation].is_mesh;
    return {{view_.relative(placement.position), scale_of(person), snorm16(std::sin(placement.yaw)),
             snorm16(std::cos(placement.yaw)), crowd_.palette[person]},
            static_cast<std::uint32_t>(character),
            representation,
            level.first,
            part.count,
            part.last_share,
            pose,
            kinds_[character].first_batch + choice * static_cast<std::uint32_t>(poses.pose_count) + pose,
            depth_[person]};
}

}  // namespace render
