// A parsed glTF file and checked access to its numbers. Internal to the loader: gltf*.cpp.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/character.h"
#include "model/input_file.h"
#include "model/io/mesh_textures.h"

namespace model {

// The whole file is refused, whatever was being read.
struct BudgetError : std::runtime_error {
    using runtime_error::runtime_error;
};

// How much a file may unfold to, so that a small file cannot claim all memory by naming one accessor a thousand times:
// vertices, indices, keys and the like, a million and one for every byte of its buffers.
class Budget {
public:
    explicit Budget(std::size_t buffer_bytes) : left_(buffer_bytes + (std::size_t{1} << 20)) {}
    void spend(std::size_t elements) {
        if (elements > left_)
            throw BudgetError(
                "found more repeated or implied data than a file of this size should hold; expected less");
        left_ -= elements;
    }

private:
    std::size_t left_;
};

struct GltfFile {
    tinygltf::Model model;
    Budget budget{0};
    std::filesystem::path folder;  // that the file's own names are relative to
};

// Reads, unpacks and checks all but images, which stay as names, data URIs and buffer views.
GltfFile open_gltf(const std::filesystem::path& path, Warnings& warnings);

// A stretch of a buffer [bytes], inside it; throws unless it is. `user` is for the message.
std::span<const unsigned char> bytes_of_buffer(const GltfFile& file, int buffer, std::size_t offset, std::size_t length,
                                               const std::string& user);

// All of a buffer view, inside its buffer; throws unless it is. `user` is for the message.
std::span<const unsigned char> bytes_of_view(const GltfFile& file, int view, const std::string& user);

// Element access to one accessor, every bound checked when it is made. Sparse values are merged in.
class Accessor {
public:
    // Throws unless `accessor` names one whose elements have `width` components of a type that glTF 2.0 allows.
    Accessor(GltfFile& file, int accessor, int width);
    Accessor(Accessor&&) = default;  // data_ may point into merged_, whose elements a move leaves in place
    Accessor(const Accessor&) = delete;

    std::size_t count() const { return count_; }
    float number(std::size_t element, int component) const;         // normalised integers as [-1, 1] or [0, 1]
    float finite(std::size_t element, int component) const;         // the same; throws on NaN and infinity
    std::uint32_t index(std::size_t element, int component) const;  // throws unless it holds whole numbers

private:
    const unsigned char* at(std::size_t element, int component) const;

    const unsigned char* data_ = nullptr;
    std::size_t count_ = 0, stride_ = 0, component_size_ = 0;
    int component_type_ = 0, index_of_accessor_ = 0;
    bool normalized_ = false;
    std::vector<unsigned char> merged_;  // the elements of an accessor that is sparse or has no buffer view
};

// How many components an element of `accessor` has; throws if there is no such accessor.
int accessor_width(const GltfFile& file, int accessor);

// The file's nodes as a skeleton: parents first.
struct NodeOrder {
    std::vector<std::int32_t> order;        // the file's index of each of the skeleton's nodes
    std::vector<std::int32_t> in_skeleton;  // the skeleton's index of each of the file's nodes
    std::vector<bool> in_scene;             // by the file's index: part of the default scene
};
NodeOrder build_nodes(const GltfFile& file, Skeleton& skeleton);

// All meshes of the scene, and the palette that their vertices index.
void build_mesh(GltfFile& file, const NodeOrder& nodes, Character& character);

inline constexpr const char* moves_nothing = "channel of a clip that moves no bone or morph, left out";

// Clips and channels that can't be played are left out, and said.
void build_clips(GltfFile& file, const NodeOrder& nodes, Character& character);

// Gives a character that rests away from the file's zero an origin of its own (origin.h), and takes it out of its
// nodes, keys and vertices; one that floats are exact enough for is left as it is. A node that clips turn about a far
// place stays as exact as floats are there, and so does a skin whose vertices are far in bind space.
void move_near(const GltfFile& file, const NodeOrder& nodes, Character& character);

// Textures as materials name them, each image decoded once. What can't be had is said.
class TextureSet {
public:
    TextureSet(const GltfFile& file, Warnings& warnings);

    // The id of the file's texture `texture`, or no_texture if it names none that can be had.
    std::uint8_t id_of(int texture);
    Sampler sampler_of(int texture) const;  // glTF's default if it names none
    // The texture `id` resampled (uv_map.h); no_texture if there are too many.
    std::uint8_t resampled_id(std::uint8_t id, const Sampler& sampler, const glm::mat3& map);

    std::vector<Texture> take() { return textures_.take(); }

private:
    std::uint8_t decode(int image);

    const GltfFile& file_;
    Warnings& warnings_;
    MeshTextures textures_;
    std::map<int, std::uint8_t> id_of_image_;
    struct Resampled {
        std::uint8_t from, id;
        Sampler sampler;
        glm::mat3 map;
    };
    std::vector<Resampled> resampled_;
    std::size_t resampled_texels_ = 0;
};

}  // namespace model
