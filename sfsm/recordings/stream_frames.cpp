#include "sfsm/recordings/stream_frames.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sfsm {
namespace {

std::string first_in(const Tally& tally, std::string_view place) {
    return (tally.count == 1 ? " (in " : " (the first in ") + std::string(place) + ' ' + std::to_string(tally.first) +
           ')';
}

double part(double told, StreamFrames& stream, std::int64_t place) {
    if (std::isnan(told) || (told >= 0 && told <= longest_frame_ms)) return told;
    stream.unusable_parts.add(place);
    return FrameRecord::untold;
}

float detail(float told, bool is_usable, StreamFrames& stream, std::int64_t place) {
    if (std::isnan(told) || is_usable) return told;
    stream.unusable_details.add(place);
    return std::numeric_limits<float>::quiet_NaN();
}

// What was shown, beside what was rendered.
std::string rates(const StreamFrames& stream) {
    const double seconds = stream.seconds();
    const auto frames = std::count_if(stream.frames.begin(), stream.frames.end(),
                                      [](const FrameRecord& frame) { return !std::isnan(frame.frame_ms); });
    const std::int64_t presents = frames + stream.generated.count();
    std::string text = std::to_string(presents) + " presented, " + std::to_string(frames) + " rendered";
    const auto a_second = [&](std::int64_t count) {
        return std::to_string(std::llround(static_cast<double>(count) / seconds));
    };
    return seconds > 0 ? text + ": " + a_second(presents) + " and " + a_second(frames) + " a second" : text;
}

void append_generated_notes(std::vector<std::string>& notes, const StreamFrames& stream, std::string_view place) {
    const GeneratedFrames& generated = stream.generated;
    if (generated.rows.count > 0) {
        notes.push_back(counted(generated.rows.count, "row", "rows") + " of generated frames, " + generated.type +
                        first_in(generated.rows, place) + ": left out, their time is in the application's next");
    }
    if (generated.of_zero.count > 0) {
        notes.push_back(counted(generated.of_zero.count, "present", "presents") + " of 0 ms" +
                        first_in(generated.of_zero, place) + ": taken for generated frames, left out");
    }
    if (generated.count() > 0) notes.push_back(rates(stream));
    if (stream.other_types.count > 0) {
        notes.push_back(counted(stream.other_types.count, "row", "rows") + " of FrameType " + stream.other_type +
                        first_in(stream.other_types, place) + ": taken for the application's");
    }
}

}  // namespace

std::string counted(std::int64_t count, const char* one, const char* several) {
    return std::to_string(count) + ' ' + (count == 1 ? one : several);
}

double StreamFrames::seconds() const {
    double ms = 0;
    for (const FrameRecord& frame : frames) ms += std::isnan(frame.frame_ms) ? 0 : frame.frame_ms;
    return ms / 1000;
}

void add_frame(StreamFrames& stream, FrameRecord frame, std::size_t present) {
    GeneratedFrames& generated = stream.generated;
    const bool is_told_again = present != 0 && present == generated.present;
    if (is_told_again) generated.waiting_ms -= generated.last_ms;
    frame.frame_ms += generated.waiting_ms;
    stream.frames.push_back(frame);
    generated.waiting_ms = generated.last_ms = 0;
    generated.present = present;
}

void add_generated(StreamFrames& stream, double ms, std::size_t present) {
    GeneratedFrames& generated = stream.generated;
    if (present != 0 && present == generated.present) return;
    generated.last_ms = ms > 0 && ms <= longest_frame_ms ? ms : 0;
    generated.waiting_ms += generated.last_ms;
    generated.present = present;
}

FrameRecord usable_frame(FrameRecord told, StreamFrames& stream, std::int64_t place) {
    if (std::isnan(told.frame_ms)) {
        stream.untold.add(place);
    } else if (!(told.frame_ms > 0 && told.frame_ms <= longest_frame_ms)) {
        stream.unusable.add(place);
        told.frame_ms = FrameRecord::untold;
    }
    told.cpu_ms = part(told.cpu_ms, stream, place);
    told.gpu_ms = part(told.gpu_ms, stream, place);
    const bool is_error = std::abs(told.animation_error_ms) <= longest_frame_ms;
    told.animation_error_ms = detail(told.animation_error_ms, is_error, stream, place);
    const bool is_count = told.compilations >= 0 && std::isfinite(told.compilations);
    told.compilations = detail(told.compilations, is_count, stream, place);
    return told;
}

bool is_shown_again(StreamFrames& stream, double told_ms, std::int64_t place) {
    if (told_ms != 0 || stream.frames.empty()) return false;
    stream.generated.of_zero.add(place);
    return true;
}

std::vector<std::string> all_notes(const StreamFrames& stream, std::string_view place) {
    std::vector<std::string> notes;
    const auto frames = [](const Tally& tally) { return counted(tally.count, "frame", "frames"); };
    if (stream.unshown.count > 0) {
        notes.push_back(frames(stream.unshown) + " dropped, never shown" + first_in(stream.unshown, place) +
                        ": rendered, so kept");
    }
    if (stream.unknown_fate.count > 0) {
        notes.push_back(frames(stream.unknown_fate) + " of unknown fate, shown or not" +
                        first_in(stream.unknown_fate, place) + ": kept");
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
                        " that can't be read, under 0 or over 10 minutes" + first_in(stream.unusable_parts, place) +
                        ": taken as NaN");
    }
    if (stream.unusable_details.count > 0) {
        notes.push_back(counted(stream.unusable_details.count, "display time, animation error or count",
                                "display times, animation errors or counts") +
                        " that can't be read or be so" + first_in(stream.unusable_details, place) + ": taken as NaN");
    }
    append_generated_notes(notes, stream, place);
    notes.insert(notes.end(), stream.notes.begin(), stream.notes.end());
    return notes;
}

void Mostly::add(std::string_view text) {
    constexpr std::size_t most = 32;
    if (text.empty()) return;
    if (last_ >= counts_.size() || counts_[last_].first != text) {
        const auto is_it = [&](const auto& count) { return count.first == text; };
        last_ = static_cast<std::size_t>(std::find_if(counts_.begin(), counts_.end(), is_it) - counts_.begin());
        if (last_ == most) return;
        if (last_ == counts_.size()) counts_.emplace_back(text, 0);
    }
    ++counts_[last_].second;
}

void Mostly::add(const Mostly& later) {
    for (const auto& [text, count] : later.counts_) {
        add(text);
        if (last_ < counts_.size()) counts_[last_].second += count - 1;
    }
}

std::string Mostly::text() const {
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto found = std::max_element(counts_.begin(), counts_.end(), fewer);
    return found == counts_.end() ? "" : found->first;
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
