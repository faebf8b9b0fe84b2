#include "sfsm/recordings/swap_chains.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "sfsm/number_text.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

bool follows(const Span& early, const Span& late) {
    const std::optional<double> end = parse_double(early.last_time), begin = parse_double(late.first_time);
    return end && begin ? *end <= *begin : early.last_line < late.first_line;
}

bool overlap(const StreamFrames& a, const StreamFrames& b) {
    return !follows(a.span, b.span) && !follows(b.span, a.span);
}

using Group = std::vector<std::size_t>;  // places of streams that become one

bool may_join(const std::vector<StreamFrames>& streams, const Group& group, const StreamFrames& stream) {
    const StreamFrames& first = streams[group.front()];
    if (first.process != stream.process || first.process_id != stream.process_id) return false;
    if (stream.process.empty() && stream.process_id.empty()) return false;
    if (first.span.first_line == 0 || stream.span.first_line == 0) return false;
    return std::none_of(group.begin(), group.end(), [&](std::size_t i) { return overlap(streams[i], stream); });
}

std::vector<Group> groups_of(const std::vector<StreamFrames>& streams) {
    Group busiest_first(streams.size());
    std::iota(busiest_first.begin(), busiest_first.end(), std::size_t{0});
    std::stable_sort(busiest_first.begin(), busiest_first.end(),
                     [&](std::size_t a, std::size_t b) { return streams[a].frames.size() > streams[b].frames.size(); });
    std::vector<Group> groups;
    for (const std::size_t i : busiest_first) {
        const auto group = std::find_if(groups.begin(), groups.end(),
                                        [&](const Group& other) { return may_join(streams, other, streams[i]); });
        if (group == groups.end()) {
            groups.push_back({i});
        } else {
            group->push_back(i);
        }
    }
    return groups;
}

void append(StreamFrames& stream, StreamFrames&& next) {
    stream.swap_chain += ' ' + next.swap_chain;
    stream.frames.insert(stream.frames.end(), next.frames.begin(), next.frames.end());
    for (Tally StreamFrames::*tally :
         {&StreamFrames::unshown, &StreamFrames::unknown_fate, &StreamFrames::untold, &StreamFrames::unusable,
          &StreamFrames::unusable_parts, &StreamFrames::unusable_details, &StreamFrames::other_types}) {
        (stream.*tally).add(next.*tally);
    }
    stream.present_modes.add(next.present_modes);
    if (stream.other_type.empty()) stream.other_type = next.other_type;
    if (stream.generated.type.empty()) stream.generated.type = next.generated.type;
    stream.generated.rows.add(next.generated.rows);
    stream.generated.of_zero.add(next.generated.of_zero);
    next.frames = {};
}

StreamFrames joined(std::vector<StreamFrames>& streams, Group group) {
    std::sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) {
        return follows(streams[a].span, streams[b].span) && !follows(streams[b].span, streams[a].span);
    });
    constexpr std::size_t most_named = 4;
    std::string names;
    for (std::size_t k = 0; k < std::min(group.size(), most_named); ++k) {
        const StreamFrames& part = streams[group[k]];
        names += (k == 0 ? "" : ", ") + shown(part.swap_chain) + " (" + std::to_string(part.frames.size()) + " frames)";
    }
    if (group.size() > most_named) names += ", ...";
    StreamFrames whole = std::move(streams[group.front()]);
    for (std::size_t k = 1; k < group.size(); ++k) append(whole, std::move(streams[group[k]]));
    if (group.size() > 1) {
        whole.notes.push_back(std::to_string(group.size()) + " swap chains, each made when the one before was gone: " +
                              names + ": put together; --swap-chain takes one");
    }
    return whole;
}

// Without "0x" and zeros.
std::string_view digits_of(std::string_view chain) {
    if (same_name(chain.substr(0, 2), "0x")) chain.remove_prefix(2);
    while (chain.size() > 1 && chain.front() == '0') chain.remove_prefix(1);
    return chain;
}

}  // namespace

void join_swap_chains(std::vector<StreamFrames>& streams) {
    std::vector<StreamFrames> result;
    std::vector<Group> groups = groups_of(streams);
    for (Group& group : groups) result.push_back(joined(streams, std::move(group)));
    streams = std::move(result);
}

bool is_same_chain(std::string_view a, std::string_view b) {
    const auto is_hexadecimal = [](std::string_view text) {
        return !text.empty() && text.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
    };
    const std::string_view x = digits_of(a), y = digits_of(b);
    return same_name(a, b) || (is_hexadecimal(x) && is_hexadecimal(y) && same_name(x, y));
}

}  // namespace sfsm
