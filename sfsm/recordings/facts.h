// What a recording says of the run and the machine, for people: "GPU", "GeForce RTX 2080 Ti".
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sfsm {

using Facts = std::vector<std::pair<std::string, std::string>>;  // names and values, in the order they are shown

// What is told of a run. Keys are those of the file, in any case, with blanks or without ("System RAM", "SystemRam").
struct Told {
    std::string format;
    std::string process, runtime, resolution, present_mode;  // of the stream; empty: not told
    std::map<std::string, std::string> settings;             // of the file
};

// Game, process, GPU, driver, CPU, memory, system, API, resolution, present mode, recorder and date, as far as they are
// told; nothing that is empty, no comment, no folder.
Facts facts_of(const Told& told);

// Of a trace of ours by its settings: law, device, people, seed, size, draw.
Facts facts_of_trace(const std::map<std::string, std::string>& settings);

// On one line, at most 120 bytes, without the folders before a file's name. Empty: a path of folders alone, or what
// only says that nothing is known.
std::string presentable(std::string_view value);

}  // namespace sfsm
