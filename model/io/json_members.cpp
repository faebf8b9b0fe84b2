#include "model/io/json_members.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace model {
namespace {

// Behind the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    for (++at; text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    return at + 1;
}

}  // namespace

std::vector<JsonMember> members_of_json(std::string_view text) {
    std::vector<JsonMember> members;
    std::optional<JsonMember> open;  // whose value is being passed
    std::string_view last;           // string
    int depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"') {
            const std::size_t end = end_of_string(text, at);
            last = text.substr(at, end - at);
            at = end - 1;
        } else if (c == '{' || c == '[') {
            if (depth++ == 0 && c == '[') return {};
        } else if (c == ':' && depth == 1) {
            open = {nlohmann::json::parse(last).get<std::string>(), at + 1, at + 1};
        } else if (c == ',' || c == '}' || c == ']') {
            if (depth == 1 && open) {
                open->end = at;
                members.push_back(*std::exchange(open, std::nullopt));
            }
            if (c != ',' && --depth == 0) break;
        }
    }
    return members;
}

}  // namespace model
