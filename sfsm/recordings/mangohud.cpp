#include "sfsm/recordings/mangohud.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sfsm {
namespace {

constexpr double most_frames = 1000;  // that a sample stands for
constexpr std::size_t most_frames_of_all = 20'000'000;
constexpr double ns_per_ms = 1e6;

// [ms] since the row before; NaN for the first of a log.
double since_before(const StreamFrames& stream, std::size_t i) {
    if (i == 0) return std::nan("");
    const double ms = (stream.elapsed[i] - stream.elapsed[i - 1]) / ns_per_ms;
    return ms >= 0 && std::isfinite(ms) ? ms : std::nan("");
}

// Rows a frame each take their frametime from row to row, on the whole.
bool is_sampled(const StreamFrames& stream) {
    constexpr double tolerance = 1.5;
    double elapsed_ms = 0, frames_ms = 0;
    for (std::size_t i = 1; i < stream.frames.size(); ++i) {
        const double ms = since_before(stream, i);
        if (std::isnan(ms) || std::isnan(stream.frames[i].frame_ms)) continue;
        elapsed_ms += ms;
        frames_ms += stream.frames[i].frame_ms;
    }
    return elapsed_ms > 0 && (elapsed_ms > tolerance * frames_ms || frames_ms > tolerance * elapsed_ms);
}

}  // namespace

double in_milliseconds(double frametime, double fps) {
    constexpr double us_per_s = 1e6, tolerance = 0.1;
    const bool is_us = std::abs(fps * frametime / us_per_s - 1) < tolerance && frametime == std::floor(frametime);
    return is_us ? frametime / 1000 : frametime;
}

void spread_samples(StreamFrames& stream, const std::string& name) {
    if (stream.elapsed.size() != stream.frames.size() || stream.frames.size() < 2 || !is_sampled(stream)) return;
    std::vector<FrameTimes> frames;
    double rest_ms = 0;
    std::int64_t pauses = 0;
    for (std::size_t i = 0; i < stream.frames.size(); ++i) {
        const FrameTimes& sample = stream.frames[i];
        const double ms = since_before(stream, i);
        double count = 1;
        if (!std::isnan(ms) && !std::isnan(sample.frame_ms)) {
            count = std::floor((rest_ms + ms) / sample.frame_ms);
            rest_ms = std::fmod(rest_ms + ms, sample.frame_ms);
            pauses += count > most_frames;
        }
        frames.insert(frames.end(), static_cast<std::size_t>(std::min(count, most_frames)), sample);
        if (frames.size() > most_frames_of_all) {
            throw std::runtime_error(name + ": found samples of more than " + std::to_string(most_frames_of_all) +
                                     " frames, expected fewer");
        }
    }
    stream.notes.push_back("sampled: " + std::to_string(stream.frames.size()) + " rows stand for " +
                           std::to_string(frames.size()) + " frames, as many as fit between them" +
                           (pauses > 0 ? "; pauses left out: " + std::to_string(pauses) : ""));
    stream.frames = std::move(frames);
    stream.elapsed.clear();
}

}  // namespace sfsm
