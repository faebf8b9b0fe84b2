// A law's open-loop run over a recording while it is still being read: reading takes one core and deciding another.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "apps/rerun.h"
#include "sfsm/recordings/frame_record.h"
#include "sfsm/target.h"

namespace apps {

class EarlyRun {
public:
    // `law` is none that looks ahead.
    EarlyRun(const sfsm::simulate::Contestant& law, const sfsm::TargetSchedule& targets, int delay);
    ~EarlyRun();  // gives up what is not done yet
    EarlyRun(const EarlyRun&) = delete;

    const std::string& law() const { return law_; }

    // Frames as they are read, in their order.
    void add(std::span<const sfsm::FrameRecord> frames);

    // All frames of the run. False: they don't begin with those that were added, so that this is nobody's run.
    bool end_with(std::span<const sfsm::FrameRecord> all);

    // The run, once, after that: waits for it. The same as rerun_open's.
    bool has_result() const { return result_.valid(); }
    Rerun result() { return result_.get(); }

private:
    using Times = std::vector<double>;  // [ms]

    Rerun run(const sfsm::simulate::Contestant& law, const sfsm::TargetSchedule& targets, int delay);
    const Times* next(std::size_t piece);
    void push(Times times);

    std::string law_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Times> pieces_;  // none moves while others are added
    bool is_closed_ = false;
    std::atomic<bool> is_given_up_ = false;
    std::future<Rerun> result_;
};

}  // namespace apps
