#include "tests/bench/front/measure.h"

#include <memory>
#include <numeric>

#include "tests/bench/fidelity.h"
#include "tests/bench/front/rivals/roll.h"
#include "tests/bench/times.h"

namespace bench::front {

namespace {

// Draws in one setting, from whatever camera.
class Sitting {
public:
    Sitting(const Sight& sight, const Setting& setting, const std::optional<sfsm::Decision>& decision)
        : setting_(setting),
          decision_(decision),
          size_{setting.factor * sight.venue().size().width, setting.factor * sight.venue().size().height},
          renderer_(sight.venue().renderer(setting.drawing)),
          shooter_(sight.venue().shooter(setting.drawing, setting.density)),
          rival_(setting.rival ? setting.rival(cast_of(sight.venue().stage().figures())) : nullptr) {
        renderer_.resize(size_.width, size_.height);
    }

    // Beforehand, of a camera that frames are drawn from until the next: rivals aren't timed while they think.
    void settle(const scene::CameraPose& pose, std::int64_t tick) {
        if (!rival_) return;
        shooter_.survey(render::make_view(pose, size_.width, size_.height), tick);
        const Roll roll(*rival_);
        shooter_.select(roll, tick);
        rival_->settle(roll.people());
    }

    const render::Frame& shoot(const scene::CameraPose& pose, std::int64_t tick) {
        const render::Survey& survey = shooter_.survey(render::make_view(pose, size_.width, size_.height), tick);
        used_ = decision_ ? *decision_ : setting_.decision(static_cast<double>(survey.range));
        const render::Frame& frame = rival_ ? shooter_.select(*rival_, tick) : shooter_.select(used_, tick);
        shooter_.draw(frame);
        return frame;
    }
    render::Image picture() const {
        return setting_.factor == 1 ? renderer_.read_image() : box_filtered(renderer_.read_image(), setting_.factor);
    }
    const sfsm::Decision& used() const { return used_; }  // of the last frame

private:
    const Setting& setting_;
    const std::optional<sfsm::Decision>& decision_;
    Size size_;
    render::Renderer& renderer_;
    Shooter& shooter_;
    std::unique_ptr<Rival> rival_;
    sfsm::Decision used_;
};

void time_more(Sitting& sitting, const Shot& shot, Effort effort, Times& times) {
    constexpr double nudge = 0.001;  // [m]
    for (int frame = 1; frame <= effort.most_frames; ++frame) {
        if (std::accumulate(times.wall.begin(), times.wall.end(), 0.0) > effort.most_ms) break;
        scene::CameraPose pose = shot.now;
        pose.position.y += nudge * (frame % 2);
        times.take([&] { sitting.shoot(pose, shot.tick + frame); });
    }
}

void fill_times(const Times& times, Row& row) {
    row.wall_ms = median(times.wall);
    row.wall_low_ms = quantile(times.wall, 0.25);
    row.wall_high_ms = quantile(times.wall, 0.75);
    row.process_ms = median(times.process);
}

// What a rate or a rival comes to is known from the frame, unless a law said it.
void fill_decision(const Sitting& sitting, const Setting& setting, const render::Frame& frame, Row& row) {
    row.decision = sitting.used();
    if (setting.rate > 0 || setting.rival) {
        row.decision.state = frame.state;
        row.decision.splat_size = frame.splat_size;
    }
    const bool is_by_rule = row.decision.rate > 0 || setting.rival;
    const bool has_density = row.decision.state == sfsm::State::points && !is_by_rule;
    row.density = has_density ? static_cast<double>(setting.density) : 0;
}

Row named_row(const Sight& sight, const Setting& setting) {
    Row row;
    row.people = sight.venue().people();
    row.view = sight.shot().name;
    row.is_preset = sight.shot().is_preset;
    row.family = setting.family;
    row.setting = setting.name;
    row.samples = setting.samples();
    return row;
}

}  // namespace

Sight::Sight(Venue& venue, const Shot& shot, References& references)
    : venue_(venue), shot_(shot), judge_(references.of(venue, shot)) {}

const Present& Sight::present(sfsm::Drawing drawing, int factor) const {
    const auto [known, is_new] = present_.try_emplace({drawing, factor});
    if (is_new) {
        const render::View view = shot_.view_now(factor * venue_.size().width, factor * venue_.size().height);
        venue_.renderer(drawing).resize(view.width, view.height);
        const render::Frame& exact = venue_.shooter(drawing).choose(view, triangles(), shot_.tick);
        known->second = present_in(exact, venue_.stage(), shot_.tick);
    }
    return known->second;
}

Measured measure(const Sight& sight, const Setting& setting, Effort effort,
                 const std::optional<sfsm::Decision>& decision) {
    const Shot& shot = sight.shot();
    const Present& present = sight.present(setting.drawing, setting.factor);
    Measured measured{named_row(sight, setting), {}};
    Row& row = measured.row;
    Sitting sitting(sight, setting, decision);
    sitting.settle(shot.before, shot.tick - 1);
    sitting.shoot(shot.before, shot.tick - 1);
    const render::Image before = sitting.picture();
    sitting.settle(shot.now, shot.tick);
    Times times;
    const render::Frame* frame = nullptr;
    times.take([&] { frame = &sitting.shoot(shot.now, shot.tick); });
    fill_decision(sitting, setting, *frame, row);
    row.work = frame->work;
    row.expected_flip = frame->expected_flip;
    row.max_motion_px = frame->max_motion_px;
    row.max_splat_px = frame->max_splat_px;
    fill_offsets(*frame, present, sight.venue().stage(), way_of(setting.drawing), row);
    for (double* pixels : {&row.motion_px, &row.motion_worst_px, &row.outline_px, &row.outline_worst_px,
                           &row.covering_px, &row.max_motion_px, &row.max_splat_px})
        *pixels /= setting.factor;
    measured.picture = sitting.picture();
    time_more(sitting, shot, effort, times);
    fill_times(times, row);
    sight.judge().judge(before, measured.picture, row);
    return measured;
}

}  // namespace bench::front
