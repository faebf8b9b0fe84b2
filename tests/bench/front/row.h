// A point of the front: one crowd in one view drawn in one setting, what it cost and how far it was off. docs/front.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sfsm/decision.h"

namespace bench::front {

// Against everybody at full triangles, moved every frame, 16 samples a pixel.
struct ImageErrors {
    double flip = 0;                      // mean, [0, 1]
    double psnr = 0;                      // [dB]; infinite for the same picture
    double ssim = 1;                      // mean, of the luma
    double brightness = 0;                // mean linear light over the reference's, less 1
    double red = 0, green = 0, blue = 0;  // the same by channel
};

struct Row {
    // Where.
    std::int64_t people = 0;
    std::string view;  // a preset, or a moment of the roaming path: "roam-12s"
    bool is_preset = false;

    // How.
    std::string family;    // a way to draw: "native points", "OpenGL triangles"; rows of one are a curve
    std::string setting;   // what tells it from the others of its family: "S = 1.4", "D = 20, S = 2"
    std::string law;       // whose choice it is; empty: a setting that was asked for
    double target_ms = 0;  // of the law
    double density = 0;    // points a splat-sized square; 0: no points, or as many as a rule says
    int samples = 0;       // a pixel, of triangles
    sfsm::Decision decision;
    sfsm::Work work;  // counted; the same on every machine

    // How far off.
    ImageErrors frame;       // all pixels
    double crowd_share = 0;  // of the pixels: those that differ from the same view of nobody, in the references
    ImageErrors crowd;       // these alone
    double change = 0;       // mean of |(I_t - R_t) - (I_t-1 - R_t-1)| [of 255] while the camera moves
    double motion_px = 0, motion_worst_px = 0;    // people's surfaces from where they should be: mean over people of
                                                  // each one's farthest point, and the farthest of all
    double outline_px = 0, outline_worst_px = 0;  // their outlines: mean over people, and the worst
    double covering_px = 0;                       // mean covering radius of their points; 0: no points
    // What the frame said of itself before it was drawn (render::Frame): 0 in files that are older than that.
    double expected_flip = 0;
    double max_motion_px = 0, max_splat_px = 0;

    // How long a frame took.
    double wall_ms = 0, wall_low_ms = 0, wall_high_ms = 0;  // median, first and last quartile
    double process_ms = 0;                                  // of all threads together: median

    bool is_mark() const { return !law.empty(); }
};

// What was measured on.
struct Machine {
    std::string processor;
    int threads = 0;
    std::string opengl;  // the driver; empty: none
    std::string date;    // 2026-11-26
};

struct Front {
    Machine machine;
    std::vector<Row> rows;
};

// A line a row below a line of columns; before them "# name: value" of the machine. Numbers as they are compared:
// errors with 5 decimals, times with 3.
std::string to_csv(const Front& front);
// Of a file that is older than some columns these are 0. Throws std::runtime_error with one line: `name`, the line,
// what was found and what was expected. `lines_before`: of the file, before `text`.
Front from_csv(std::string_view text, const std::string& name, std::int64_t lines_before = 0);

}  // namespace bench::front
