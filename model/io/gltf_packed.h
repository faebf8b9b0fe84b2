// Compressed parts of a glTF file: unpacked into buffers of their own, so that what reads accessors knows of none.
// Internal to the loader.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "model/io/gltf_file.h"

namespace model {

// How far what is compressed may unfold, in all: 16 MiB, and a hundred bytes for every byte of the file's buffers, up
// to 2 GiB.
class UnpackLimit {
public:
    explicit UnpackLimit(std::uint64_t buffer_bytes)
        : left_(std::min((std::uint64_t{1} << 24) + 100 * buffer_bytes, std::uint64_t{1} << 31)) {}

    // Throws BudgetError beyond the limit. No overflow while `elements` and `size` are below 2^32.
    void spend(std::uint64_t elements, std::uint64_t size) {
        if (elements * size > left_)
            throw BudgetError("found more compressed data than a file of this size should hold; expected less");
        left_ -= elements * size;
    }

private:
    std::uint64_t left_;
};

// A new buffer of these bytes, and a view of all of it; returns the view.
int add_unpacked(GltfFile& file, std::vector<unsigned char> bytes);

// A whole number from 0 to 2^31 - 1 in an extension; throws "found `user` without ..." if there is none.
std::uint32_t whole_number(const tinygltf::Value& object, const char* name, const std::string& user);

// EXT_meshopt_compression, and KHR_meshopt_compression as far as it is the same: the views that have it become views of
// what they unpack to. One that is damaged stays what it is for programs without the extension, and is said; throws if
// that isn't in the file.
void unpack_meshopt(GltfFile& file, UnpackLimit& limit, Warnings& warnings);

// KHR_draco_mesh_compression: primitives that have it get accessors of what it unpacks to, which hold as many vertices
// and indices as there are; more than the file's own accessors say are refused. One that is damaged keeps the accessors
// it has for programs without the extension, and is said; throws if these have no data.
void unpack_draco(GltfFile& file, UnpackLimit& limit, Warnings& warnings);

}  // namespace model
