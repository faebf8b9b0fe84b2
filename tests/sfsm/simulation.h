// Simulated renderers to close the loop around a law: a time for every decision, arriving frames late.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "sfsm/controller.h"
#include "sfsm/trace.h"

namespace sfsm {

inline constexpr double test_range = 200;  // L [m]

// In [0, 1). Standard distributions differ between platforms, the engine does not.
inline double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}
inline double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * uniform(random);
}

// Times [ms]: linear in D, and for points falling with S.
struct Plant {
    double fixed = 100;          // of triangles, whoever moves
    double motion = 100;         // when everybody moves; in proportion to D
    double points = 10;          // of points, of any size
    double point_density = 100;  // at S = 1 px; in proportion to 1 / S

    double time(const Decision& decision, double range) const {
        const double moving = motion * std::min(decision.motion_distance, range) / range;
        if (decision.state != State::points) return fixed + moving;
        return points + point_density / decision.splat_size;
    }
};

using Time = std::function<double(std::int64_t frame, const Decision&)>;
using Target = std::function<double(std::int64_t frame)>;

struct Loop {
    Time time;
    Target target;
    std::int64_t frames = 100;
    int delay = 0;
    double range = test_range;
};

// One row a frame: what the law decided and what it took. Times arrive `delay` frames late. `draw` gets a row with its
// frame, target and range, has the law decide, and says what that took.
template <class Draw>
std::vector<TraceRow> run_frames(Controller& law, std::int64_t frames, int delay, const Target& target, double range,
                                 const Draw& draw) {
    std::vector<TraceRow> rows;
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        if (frame > delay) {
            const TraceRow& arrived = rows[static_cast<std::size_t>(frame - 1 - delay)];
            law.observe({arrived.frame, arrived.frame_ms, arrived.decision, arrived.work});
        }
        TraceRow row;
        row.frame = frame;
        row.target_ms = target(frame);
        row.range = range;
        draw(row);
        rows.push_back(row);
    }
    return rows;
}

inline std::vector<TraceRow> run(Controller& law, const Loop& loop) {
    return run_frames(law, loop.frames, loop.delay, loop.target, loop.range, [&](TraceRow& row) {
        row.decision = law.decide({row.target_ms, row.range});
        row.frame_ms = loop.time(row.frame, row.decision);
    });
}

inline Time exact(const Plant& plant, double range = test_range) {
    return [=](std::int64_t, const Decision& decision) { return plant.time(decision, range); };
}

inline Target constant(double ms) {
    return [=](std::int64_t) { return ms; };
}

}  // namespace sfsm
