// libFuzzer's entry: the bytes as a recorded file of any tool. The last byte says how they are packed, since no change
// of packed bytes would get past the unpacker. With clang and -DGRANDSTAND_FUZZ=ON: bin/recordings_fuzz
// -max_total_time=60 -dict=tests/fuzz/recordings.dict CORPUS tests/fuzz/recordings
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "sfsm/recordings/recording.h"
#include "tests/recordings/packed.h"

namespace {

void demand(bool holds) {
    if (!holds) std::abort();
}

// What stands there, then so many lines of nothing that it swells a hundredfold. Long ones, as they are read in no
// time.
std::string swollen(const std::string& text) {
    constexpr std::size_t lines = 9000, length = 1024;
    const std::string line = std::string(length, 'x') + '\n';
    std::string all = text;
    for (std::size_t i = 0; i < lines; ++i) all += line;
    return all;
}

std::string packed(const std::string& text, std::uint8_t how) {
    switch (how) {
        case 1:
            return sfsm::gzip(text);
        case 2:
            return sfsm::utf16(text, false);
        case 3:
            return sfsm::utf16("\xFE\xFF" + text, true);
        case 4:
            return sfsm::gzip(sfsm::utf16(text, false));
        case 5:
            return sfsm::gzip(swollen(text));
        case 6:
            return sfsm::gzip(text) + sfsm::gzip(text);
        default:
            return text;
    }
}

bool is_time(double ms) {
    return std::isnan(ms) || (ms >= 0 && std::isfinite(ms));
}

void check(const sfsm::Recording& recording) {
    demand(recording.streams.at(recording.chosen).frames == static_cast<std::int64_t>(recording.frames.size()));
    demand(recording.has_work() || recording.trace.rows.empty());
    for (const auto& [name, value] : recording.facts)
        demand(!value.empty() && value.find_first_of("\r\n\t") == std::string::npos);
    for (const sfsm::FrameRecord& frame : recording.frames) {
        if (recording.has_work()) break;  // our own numbers are read as they are
        demand(is_time(frame.frame_ms) && is_time(frame.cpu_ms) && is_time(frame.gpu_ms));
        demand(is_time(frame.display_ms) && is_time(frame.compilations));
        demand(std::isnan(frame.animation_error_ms) || std::isfinite(frame.animation_error_ms));
        if (frame.fate == sfsm::FrameRecord::Fate::dropped)
            demand(std::isnan(frame.display_ms) && std::isnan(frame.animation_error_ms));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::istringstream in(size == 0 ? text : packed(text.substr(0, size - 1), data[size - 1]));
    try {
        check(sfsm::read_recording(in, "fuzz"));
    } catch (const std::runtime_error& error) {
        demand(std::string(error.what()).find_first_of("\r\n") == std::string::npos);
    }
    return 0;
}
