// What the display made of a stream's frames: the times between its changes, and the animation error where a recording
// doesn't have it but tells enough to compute it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// By what a file may tell when the simulation of a frame began, the best first.
enum class SimulationStart {
    animation_time,   // as it is
    simulation_step,  // sum of the steps from frame to frame
    cpu_start,        // when the CPU began with the frame
    present_end,      // when the Present() call before it returned
};
inline constexpr std::size_t simulation_starts = 4;

// Of one row [ms]; NaN: not told.
struct DisplayRow {
    static constexpr double untold = std::numeric_limits<double>::quiet_NaN();

    double display_ms = untold;  // between display changes, or how long it was shown
    double animation_ms = untold, step_ms = untold, cpu_start_ms = untold;  // SimulationStart's
    double present_ms = untold, in_present_ms = untold;  // when Present() was called, by a clock; how long it took
};

// How to read rows.
struct DisplayMeaning {
    bool is_shown_for = false;  // display_ms goes on from where the frame was shown, not up to there
    bool computes_errors = false;
};

class DisplayTimes {
public:
    // A row that another than the application made: its display time counts for the application's next.
    void add_generated(const DisplayRow& row);

    // The next frame. Returns its display time: NaN if it was never shown or that isn't told.
    double add(const DisplayRow& row, const FrameRecord& frame, DisplayMeaning meaning);

    // What comes is not to be compared with what was: the recording begins anew.
    void begin_again();

    // Gives the frames that were added, `frames`, their animation errors, if they were computed, as PresentMon defines
    // them, of frames that were shown, across those that never were:
    //   error = (simulation start - that of the frame shown before) - (time between their display changes)
    // Simulation starts are the first of SimulationStart that gives an error. Those that go on by less than a quarter
    // or over four times the frames' times, in most frames, are no clock in milliseconds. Returns which was taken;
    // nothing: none.
    std::optional<SimulationStart> finish(std::vector<FrameRecord>& frames);

private:
    struct Clock {
        double shown_ms = DisplayRow::untold;   // of the frame shown before
        double before_ms = DisplayRow::untold;  // of the frame before
        std::int64_t compared = 0, alike = 0;   // steps beside a frame's time, and those of about its length
        std::vector<float> errors;              // of the first frame on, as far as there are any

        void begin_again();
        void add(double start_ms, double frame_ms, std::int64_t frame, std::optional<double> displays_ms);
    };

    std::array<double, simulation_starts> starts_of(const DisplayRow& row);

    std::int64_t frames_ = 0;
    double waiting_ms_ = 0;                       // display times of the generated frames since the last frame shown
    double shown_for_ms_ = DisplayRow::untold;    // where they go on from it: with its own
    double steps_ms_ = 0;                         // sum
    double present_end_ms_ = DisplayRow::untold;  // of the frame before
    std::array<Clock, simulation_starts> clocks_;
};

// The note on errors that were computed, by the names of the columns.
std::string computed_note(const std::string& start, const std::string& display);

}  // namespace sfsm
