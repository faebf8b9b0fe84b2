#include "model/clip_list.h"

#include "model/input_file.h"

namespace model {

std::string list_of(std::span<const Clip> clips) {
    constexpr std::size_t longest = 90;
    std::string list;
    for (const Clip& clip : clips) {
        const std::string name = in_quotes(clip.name);
        if (list.size() + name.size() > longest) return list + ", ...";
        list += (list.empty() ? "" : ", ") + name;
    }
    return list;
}

}  // namespace model
