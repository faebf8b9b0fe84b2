// The members of a JSON object where they stand in its text, so that a reader builds only those that it needs, and can
// put others in their place. Internal to the loaders.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace model {

struct JsonMember {
    std::string name;
    std::size_t begin = 0, end = 0;  // [bytes] of its value, blanks around it and all
};

// Of the object that `text` is, in their order; nothing if it is no object. The text is sound JSON; names that come
// twice are listed twice.
std::vector<JsonMember> members_of_json(std::string_view text);

}  // namespace model
