// What must hold of glTF's JSON before tinygltf may see it: it recurses over nested values.
#pragma once

#include <string_view>

namespace model {

// Throws std::runtime_error, "found ...; expected ...", if `text` is not JSON, nests deeper than 64 levels, holds more
// than a million objects or 131,072 in one top-level list, or declares buffers of more than 2 GiB in all. Needs no
// memory in proportion to the text.
void check_gltf_json(std::string_view text);

}  // namespace model
