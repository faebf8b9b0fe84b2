// What the user did at a window.
#pragma once

#include <vector>

namespace render {

// Presses, in the order they came; a key that is held repeats only raise_target and lower_target.
enum class Command { preset_1, preset_2, preset_3, preset_4, preset_5, raise_target, lower_target, pause, screenshot };

// Since the last poll.
struct Input {
    float forward = 0, right = 0, up = 0;  // held keys, each in [-1, 1]
    bool hurry = false;                    // shift
    double look_x = 0, look_y = 0;         // [px] dragged to the right, dragged down
    std::vector<Command> commands;
};

}  // namespace render
