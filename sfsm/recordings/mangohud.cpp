#include "sfsm/recordings/mangohud.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sfsm {
namespace {

constexpr double most_frames_of_all = 20'000'000;
constexpr double ns_per_ms = 1e6;
constexpr double ms_by_fps = 1e3, us_by_fps = 1e6;  // a frame's time times its fps

// In which unit the times are the inverse of the fps; where no row tells fps, in which the median is under a second.
Unit unit_of(const std::vector<RawTime>& raw) {
    std::vector<double> products, times;
    for (const RawTime& row : raw) {
        if (row.time > 0) times.push_back(row.time);
        if (row.time * row.fps > 0) products.push_back(row.time * row.fps);
    }
    constexpr double longest_ms = 1000;
    if (products.empty()) return median(std::move(times)) > longest_ms ? Unit::us : Unit::ms;
    return median(std::move(products)) > std::sqrt(ms_by_fps * us_by_fps) ? Unit::us : Unit::ms;
}

void note_unit(StreamFrames& stream, Unit unit) {
    constexpr double tolerance = 0.1;
    Tally others;
    for (const RawTime& row : stream.raw) {
        const double other = unit == Unit::us ? ms_by_fps : us_by_fps;
        if (std::abs(row.time * row.fps / other - 1) < tolerance) others.add(row.line);
    }
    if (unit == Unit::us) stream.notes.push_back("frame times of such a size are microseconds");
    if (others.count == 0) return;
    stream.notes.push_back(std::to_string(others.count) + " rows with a time of another unit by their fps (the first " +
                           "in line " + std::to_string(others.first) + "): taken for " + std::string(name_of(unit)) +
                           " like the others");
}

// [ms] from row to row; NaN: not told, or the clock ran back.
std::vector<double> intervals(const std::vector<RawTime>& raw) {
    std::vector<double> steps(raw.size(), std::nan(""));
    for (std::size_t i = 1; i < raw.size(); ++i) {
        const double ms = (raw[i].elapsed_ns - raw[i - 1].elapsed_ns) / ns_per_ms;
        if (ms >= 0 && std::isfinite(ms)) steps[i] = ms;
    }
    return steps;
}

// Rows a frame each take their frametime from row to row; pauses between them change nothing.
bool is_sampled(const std::vector<FrameRecord>& rows, const std::vector<double>& steps) {
    constexpr double tolerance = 1.5;
    std::vector<double> ratios;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double ratio = steps[i] / rows[i].frame_ms;
        if (!std::isnan(ratio)) ratios.push_back(ratio);
    }
    const double ratio = median(std::move(ratios));
    return ratio > tolerance || ratio < 1 / tolerance;
}

double usual(const std::vector<double>& steps) {
    std::vector<double> told;
    for (const double ms : steps) {
        if (ms > 0) told.push_back(ms);
    }
    return median(std::move(told));
}

// How many frames each sample stands for.
class Spread {
public:
    explicit Spread(double usual_ms) : usual_ms_(usual_ms) {}

    double count(double since_before_ms, double frame_ms) {
        constexpr double pause = 10;       // usual steps
        constexpr double rounding = 1e-6;  // of times written with a few decimals, in frames
        if (std::isnan(since_before_ms) || std::isnan(frame_ms)) return 1;
        const bool is_pause = since_before_ms > pause * usual_ms_;
        pauses_ += is_pause;
        rest_ms_ += is_pause ? usual_ms_ : since_before_ms;
        const double count = std::floor(rest_ms_ / frame_ms + rounding);
        rest_ms_ = std::max(0.0, rest_ms_ - count * frame_ms);
        return count;
    }
    std::int64_t pauses() const { return pauses_; }

private:
    double usual_ms_, rest_ms_ = 0;
    std::int64_t pauses_ = 0;
};

void spread_samples(StreamFrames& stream, const std::vector<double>& steps, const std::string& name) {
    std::vector<FrameRecord> frames;
    Spread spread(usual(steps));
    for (std::size_t i = 1; i < stream.frames.size(); ++i) {
        const FrameRecord& sample = stream.frames[i];
        const double count = spread.count(steps[i], sample.frame_ms);
        if (static_cast<double>(frames.size()) + count > most_frames_of_all) {
            throw std::runtime_error(name + ": found samples of more than 20 million frames, expected fewer");
        }
        frames.insert(frames.end(), static_cast<std::size_t>(count), sample);
    }
    stream.notes.push_back("sampled: " + std::to_string(stream.frames.size()) + " rows stand for " +
                           std::to_string(frames.size()) + " frames, as many as fit between them" +
                           (spread.pauses() > 0 ? "; pauses left out: " + std::to_string(spread.pauses()) : ""));
    stream.frames = std::move(frames);
}

}  // namespace

void take_mangohud_rows(StreamFrames& stream, const std::string& name) {
    const Unit unit = unit_of(stream.raw);
    note_unit(stream, unit);
    stream.frames.reserve(stream.raw.size());
    for (const RawTime& row : stream.raw) {
        stream.frames.push_back(usable_frame({in_milliseconds(row.time, unit)}, stream, row.line));
    }
    const std::vector<double> steps = intervals(stream.raw);
    stream.raw = {};
    if (is_sampled(stream.frames, steps)) spread_samples(stream, steps, name);
}

}  // namespace sfsm
