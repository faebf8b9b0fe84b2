#include "apps/early_run.h"

#include <cmath>
#include <memory>
#include <utility>

#include "sfsm/replay.h"

namespace apps {
namespace {

bool is_same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

EarlyRun::EarlyRun(const sfsm::simulate::Contestant& law, const sfsm::TargetSchedule& targets, int delay)
    : law_(law.name), result_(std::async(std::launch::async, [=, this] { return run(law, targets, delay); })) {}

EarlyRun::~EarlyRun() {
    const std::lock_guard lock(mutex_);
    is_given_up_ = true;
    changed_.notify_all();
}

Rerun EarlyRun::run(const sfsm::simulate::Contestant& law, const sfsm::TargetSchedule& targets, int delay) {
    const std::unique_ptr<sfsm::Controller> controller = make_law(law, sfsm::Drawing::opengl);
    sfsm::Replaying replaying(*controller, delay);
    Rerun rerun{law.name, {}, {}};
    sfsm::TraceRow row;
    std::size_t piece = 0;
    while (const Times* times = next(piece++)) {
        for (const double ms : *times) {
            if (is_given_up_) return rerun;
            row.target_ms = targets.at(row.frame);
            row.frame_ms = ms;
            rerun.frames.push_back(next_frame(replaying, row));
            ++row.frame;
        }
    }
    return rerun;
}

// Waits for it; nothing: there is none.
const EarlyRun::Times* EarlyRun::next(std::size_t piece) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return piece < pieces_.size() || is_closed_ || is_given_up_; });
    return piece < pieces_.size() && !is_given_up_ ? &pieces_[piece] : nullptr;
}

void EarlyRun::push(Times times) {
    const std::lock_guard lock(mutex_);
    pieces_.push_back(std::move(times));
    changed_.notify_all();
}

void EarlyRun::add(std::span<const sfsm::FrameRecord> frames) {
    Times times;
    times.reserve(frames.size());
    for (const sfsm::FrameRecord& frame : frames) times.push_back(frame.frame_ms);
    push(std::move(times));
}

bool EarlyRun::end_with(std::span<const sfsm::FrameRecord> all) {
    std::size_t frame = 0;
    for (const Times& times : pieces_) {
        for (const double ms : times) {
            if (frame == all.size() || !is_same(ms, all[frame++].frame_ms)) return false;
        }
    }
    add(all.subspan(frame));
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    changed_.notify_all();
    return true;
}

}  // namespace apps
