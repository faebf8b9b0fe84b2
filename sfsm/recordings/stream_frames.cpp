#include "sfsm/recordings/stream_frames.h"

#include <cmath>
#include <functional>

namespace sfsm {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double longest_ms = 600'000;

std::string counted(std::int64_t count, const char* one, const char* several) {
    return std::to_string(count) + ' ' + (count == 1 ? one : several);
}

std::string first_in(const Tally& tally, std::string_view place) {
    return (tally.count == 1 ? " (in " : " (the first in ") + std::string(place) + ' ' + std::to_string(tally.first) +
           ')';
}

double part(double told, StreamFrames& stream, std::int64_t place) {
    if (std::isnan(told) || (told >= 0 && told <= longest_ms)) return told;
    stream.unusable_parts.add(place);
    return unknown;
}

// Whether a frame is far shorter than `neighbour`; never beside a NaN.
bool is_far_shorter(double ms, double neighbour) {
    return ms < neighbour / 10;
}

// How many presents from `i` on are far shorter than the one before them and the one behind: 0 to 3.
std::size_t short_run(const std::vector<FrameTimes>& frames, std::size_t i) {
    constexpr std::size_t longest = 3;
    const double before = frames[i - 1].frame_ms;
    std::size_t end = i;
    while (end < frames.size() && end - i <= longest && is_far_shorter(frames[end].frame_ms, before)) ++end;
    if (end - i > longest) return 0;
    for (std::size_t k = i; end < frames.size() && k < end; ++k) {
        if (!is_far_shorter(frames[k].frame_ms, frames[end].frame_ms)) return 0;
    }
    return end - i;
}

std::size_t count_short(const std::vector<FrameTimes>& frames) {
    std::size_t count = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const std::size_t run = short_run(frames, i);
        count += run;
        i += run;
    }
    return count;
}

}  // namespace

double StreamFrames::seconds() const {
    double ms = 0;
    for (const FrameTimes& times : frames) ms += std::isnan(times.frame_ms) ? 0 : times.frame_ms;
    return ms / 1000;
}

void add_frame(StreamFrames& stream, FrameTimes times, std::size_t present) {
    GeneratedFrames& generated = stream.generated;
    const bool is_told_again = present != 0 && present == generated.present;
    if (is_told_again) generated.waiting_ms -= generated.last_ms;
    times.frame_ms += generated.waiting_ms;
    stream.frames.push_back(times);
    generated.waiting_ms = generated.last_ms = 0;
    generated.present = present;
}

void add_generated(StreamFrames& stream, double ms, std::size_t present) {
    GeneratedFrames& generated = stream.generated;
    if (present != 0 && present == generated.present) return;
    generated.last_ms = ms > 0 && ms <= longest_ms ? ms : 0;
    generated.waiting_ms += generated.last_ms;
    generated.present = present;
}

FrameTimes usable_times(FrameTimes told, StreamFrames& stream, std::int64_t place) {
    if (std::isnan(told.frame_ms)) {
        stream.untold.add(place);
    } else if (!(told.frame_ms > 0 && told.frame_ms <= longest_ms)) {
        stream.unusable.add(place);
        told.frame_ms = unknown;
    }
    told.cpu_ms = part(told.cpu_ms, stream, place);
    told.gpu_ms = part(told.gpu_ms, stream, place);
    return told;
}

void merge_generated_presents(StreamFrames& stream) {
    constexpr std::size_t least_share = 10;  // one in so many
    std::vector<FrameTimes>& frames = stream.frames;
    const std::size_t count = count_short(frames);
    if (count == 0 || count * least_share < frames.size()) return;
    std::size_t kept = 1;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        // The neighbour before is the row before: of the rows kept it may have grown already.
        for (std::size_t run = short_run(frames, i); run > 0; --run) frames[kept - 1].frame_ms += frames[i++].frame_ms;
        if (i < frames.size()) frames[kept++] = frames[i];
    }
    frames.resize(kept);
    stream.notes.push_back(counted(static_cast<std::int64_t>(count), "present is", "presents are") +
                           " far shorter than those beside, as frame generation makes them: put together with the "
                           "frame before");
}

std::vector<std::string> all_notes(const StreamFrames& stream, std::string_view place) {
    std::vector<std::string> notes;
    const auto frames = [](const Tally& tally) { return counted(tally.count, "frame", "frames"); };
    if (stream.unshown.count > 0) {
        notes.push_back(frames(stream.unshown) + " dropped, never shown" + first_in(stream.unshown, place) +
                        ": rendered, so kept");
    }
    if (stream.untold.count > 0) {
        notes.push_back(frames(stream.untold) + " without a time" + first_in(stream.untold, place) + ": kept as NaN");
    }
    if (stream.unusable.count > 0) {
        notes.push_back(frames(stream.unusable) + " with a time not over 0 or over 10 minutes" +
                        first_in(stream.unusable, place) + ": kept as NaN");
    }
    if (stream.unusable_parts.count > 0) {
        notes.push_back(counted(stream.unusable_parts.count, "CPU or GPU time", "CPU or GPU times") +
                        " under 0 or over 10 minutes" + first_in(stream.unusable_parts, place) + ": taken as NaN");
    }
    if (stream.generated.rows.count > 0) {
        notes.push_back(counted(stream.generated.rows.count, "row", "rows") + " of generated frames, " +
                        stream.generated.type + first_in(stream.generated.rows, place) +
                        ": left out, their time is in the application's next");
    }
    notes.insert(notes.end(), stream.notes.begin(), stream.notes.end());
    return notes;
}

StreamFrames& StreamTable::find(std::string_view process, std::string_view process_id, std::string_view swap_chain) {
    const auto is_it = [&](const StreamFrames& stream) {
        return stream.swap_chain == swap_chain && stream.process_id == process_id && stream.process == process;
    };
    if (last_ < streams_.size() && is_it(streams_[last_])) return streams_[last_];
    const std::hash<std::string_view> hash;
    const std::size_t key = hash(process) ^ 3 * hash(process_id) ^ 5 * hash(swap_chain);
    const auto [begin, end] = by_hash_.equal_range(key);
    for (auto found = begin; found != end; ++found) {
        if (is_it(streams_[last_ = found->second])) return streams_[last_];
    }
    last_ = streams_.size();
    by_hash_.emplace(key, last_);
    StreamFrames& stream = streams_.emplace_back();
    stream.process = process;
    stream.process_id = process_id;
    stream.swap_chain = swap_chain;
    return stream;
}

}  // namespace sfsm
