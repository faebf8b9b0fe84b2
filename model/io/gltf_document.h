// The parts of glTF's JSON that Grandstand reads itself, as what people have is wider than what tinygltf takes:
// buffers, images, and which extensions an animation has. Internal to the loader.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/io/json_members.h"
#include "model/warnings.h"

namespace model {

class GltfDocument {
public:
    // `text` has passed check_gltf_json, and stays until rest() was asked for. Throws if it is of another version than
    // 2. Builds what it reads alone: clips and meshes are most of a file's JSON, and seldom need a change.
    GltfDocument(std::string_view text, Warnings& warnings);

    // What tinygltf may see: all but buffers, images and the clips' own extensions. Of primitives that Draco holds the
    // indices' accessor is in their extension, as "indices".
    std::string rest() const;

    // Takes clips out of the rest that lack what every clip has, which tinygltf refuses a file for. Whether there were
    // any.
    bool leave_out_bad_clips(Warnings& warnings);

    // `chunk`: the binary chunk, which is the first buffer if that has no URI. Others without one are empty, as the
    // fallbacks of compressed data are. Throws if a buffer can't be had or is shorter than it says.
    std::vector<tinygltf::Buffer> buffers(const std::filesystem::path& folder, std::vector<unsigned char> chunk);

    // Not decoded: a URI, or else a buffer view, or -1.
    std::vector<tinygltf::Image> images();

private:
    // Another text for a stretch of it.
    struct Change {
        std::size_t begin, end;
        std::string text;
    };

    std::string_view text_of(const JsonMember& member) const;
    void check_version() const;
    void replace(const JsonMember& member, std::string text);
    nlohmann::json take_list(const JsonMember& member);
    void keep_plain_animations(const JsonMember& member, Warnings& warnings);
    void hide_packed_indices(const JsonMember& member);

    std::string_view text_;
    std::vector<JsonMember> members_;
    std::vector<Change> changes_;  // in the order of the text
    nlohmann::json buffers_, images_;
};

}  // namespace model
