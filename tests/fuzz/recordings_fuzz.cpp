// libFuzzer's entry: the bytes as a recorded file of any tool. With clang and -DGRANDSTAND_FUZZ=ON:
// bin/recordings_fuzz -max_total_time=60 CORPUS
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "sfsm/recordings/recording.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        const sfsm::Recording recording = sfsm::read_recording(in, "fuzz");
        const std::int64_t frames = recording.streams.at(recording.chosen).frames;
        if (frames != static_cast<std::int64_t>(recording.frames.size())) std::abort();
    } catch (const std::runtime_error& error) {
        if (std::string(error.what()).find_first_of("\r\n") != std::string::npos) std::abort();
    }
    return 0;
}
