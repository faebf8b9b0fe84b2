// The parts of glTF's JSON that Grandstand reads itself, as what people have is wider than what tinygltf takes:
// buffers, images, and which extensions an animation has. Internal to the loader.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/warnings.h"

namespace model {

class GltfDocument {
public:
    // `text` has passed check_gltf_json. Throws if it is of another version than 2.
    GltfDocument(std::string_view text, Warnings& warnings);

    // What tinygltf may see: all but buffers, images and the clips' own extensions. Of primitives that Draco holds the
    // indices' accessor is in their extension, as "indices". Once: the memory is given back, as
    // tinygltf needs as much for its own.
    std::string take_rest();

    // `chunk`: the binary chunk, which is the first buffer if that has no URI. Others without one are empty, as the
    // fallbacks of compressed data are. Throws if a buffer can't be had or is shorter than it says.
    std::vector<tinygltf::Buffer> buffers(const std::filesystem::path& folder, std::vector<unsigned char> chunk);

    // Not decoded: a URI, or else a buffer view, or -1.
    std::vector<tinygltf::Image> images();

private:
    void keep_plain_animations(Warnings& warnings);
    void hide_packed_indices();

    nlohmann::json document_, buffers_, images_;
};

}  // namespace model
