// Files of GltfBuilder with their data compressed, by the codecs' own encoders.
#pragma once

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/model/gltf_builder.h"

namespace tests {

inline constexpr int barrel_around = 20, barrel_up = 8;  // quads

// A barrel of `make_everything`'s texture and skin, without morph targets. Its first and last columns of vertices are
// in one place and differ in their texture coordinates.
inline GltfBuilder make_barrel() {
    GltfBuilder builder = make_everything();
    std::vector<float> positions, normals, uvs, colors, weights;
    std::vector<std::uint8_t> joints;
    std::vector<std::uint16_t> indices;
    for (int y = 0; y <= barrel_up; ++y) {
        for (int i = 0; i <= barrel_around; ++i) {
            const float u = static_cast<float>(i) / barrel_around, v = static_cast<float>(y) / barrel_up;
            const float angle = 6.2831853f * static_cast<float>(i % barrel_around) / barrel_around;
            const float radius = 1 + v * (1 - v);
            positions.insert(positions.end(), {radius * std::cos(angle), 3 * v, radius * std::sin(angle)});
            normals.insert(normals.end(), {std::cos(angle), 0, std::sin(angle)});
            uvs.insert(uvs.end(), {u, v});
            colors.insert(colors.end(), {u, v, 1 - u, 1});
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {0.9f - 0.3f * v, 0.1f + 0.3f * v, 0, 0});
        }
    }
    const auto at = [](int y, int i) { return static_cast<std::uint16_t>(y * (barrel_around + 1) + i); };
    for (int y = 0; y < barrel_up; ++y)
        for (int i = 0; i < barrel_around; ++i)
            indices.insert(indices.end(),
                           {at(y, i), at(y + 1, i), at(y, i + 1), at(y, i + 1), at(y + 1, i), at(y + 1, i + 1)});
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive.erase("targets");
    builder.document["meshes"][0].erase("weights");
    builder.document["animations"][0]["channels"].erase(1);
    primitive["attributes"] = {{"POSITION", builder.vec3(positions)},
                               {"NORMAL", builder.vec3(normals)},
                               {"TEXCOORD_0", builder.vec2(uvs)},
                               {"COLOR_0", builder.vec4(colors)},
                               {"JOINTS_0", builder.add("VEC4", u8, 4, joints)},
                               {"WEIGHTS_0", builder.vec4(weights)}};
    primitive["indices"] = builder.indices(indices);
    return builder;
}

// A compressed stretch of the file's one buffer, as an extension of a buffer view names it.
struct PackedData {
    std::string bytes, mode = "ATTRIBUTES", filter = "NONE";
    std::size_t count = 0, stride = 0;
};

inline PackedData pack_attributes(const void* elements, std::size_t count, std::size_t stride) {
    PackedData packed{{}, "ATTRIBUTES", "NONE", count, stride};
    packed.bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
    packed.bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.bytes.data()),
                                                   packed.bytes.size(), elements, count, stride));
    return packed;
}

// `mode`: TRIANGLES or INDICES.
inline PackedData pack_indices(const std::vector<std::uint16_t>& indices, const std::string& mode) {
    constexpr std::size_t vertices = 65536;
    PackedData packed{{}, mode, "NONE", indices.size(), 2};
    const bool triangles = mode == "TRIANGLES";
    packed.bytes.resize(triangles ? meshopt_encodeIndexBufferBound(indices.size(), vertices)
                                  : meshopt_encodeIndexSequenceBound(indices.size(), vertices));
    auto* out = reinterpret_cast<unsigned char*>(packed.bytes.data());
    packed.bytes.resize(triangles
                            ? meshopt_encodeIndexBuffer(out, packed.bytes.size(), indices.data(), indices.size())
                            : meshopt_encodeIndexSequence(out, packed.bytes.size(), indices.data(), indices.size()));
    return packed;
}

// Puts `data` in the place of what view `view` had, which then has no bytes but in a buffer that isn't there.
inline void replace_view(GltfBuilder& builder, int view, const PackedData& data, const char* extension) {
    const int added = builder.add_view(data.bytes);
    const json from = builder.document["bufferViews"][static_cast<std::size_t>(added)];
    builder.document["bufferViews"][static_cast<std::size_t>(view)] = {{"buffer", 1},
                                                                       {"byteLength", data.count * data.stride},
                                                                       {"extensions",
                                                                        {{extension,
                                                                          {{"buffer", 0},
                                                                           {"byteOffset", from["byteOffset"]},
                                                                           {"byteLength", from["byteLength"]},
                                                                           {"byteStride", data.stride},
                                                                           {"count", data.count},
                                                                           {"mode", data.mode},
                                                                           {"filter", data.filter}}}}}};
}

// Compresses all that accessors read: 16-bit scalars as indices, the rest, whose elements have whole words, as
// attributes. What was there before is made useless.
inline GltfBuilder pack_meshopt(GltfBuilder builder, const std::string& mode,
                                const char* extension = "EXT_meshopt_compression") {
    const json accessors = builder.document["accessors"];
    for (const json& accessor : accessors) {
        const int view = accessor["bufferView"];
        const json before = builder.document["bufferViews"][static_cast<std::size_t>(view)];
        const std::size_t at = before["byteOffset"], size = before["byteLength"], count = accessor["count"];
        const std::string bytes = builder.binary.substr(at, size);
        std::fill_n(builder.binary.begin() + static_cast<std::ptrdiff_t>(at), size, '\xff');
        if (accessor["componentType"] == static_cast<int>(u16)) {
            std::vector<std::uint16_t> indices(count);
            std::memcpy(indices.data(), bytes.data(), size);
            replace_view(builder, view, pack_indices(indices, mode), extension);
        } else {
            replace_view(builder, view, pack_attributes(bytes.data(), count, size / count), extension);
        }
    }
    builder.document["extensionsUsed"] = builder.document["extensionsRequired"] = {extension};
    return builder;
}

inline std::vector<float> floats_of(const GltfBuilder& builder, int accessor) {
    const int view = builder.document["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
    const json& found = builder.document["bufferViews"][static_cast<std::size_t>(view)];
    std::vector<float> values(found["byteLength"].get<std::size_t>() / sizeof(float));
    std::memcpy(values.data(), builder.binary.data() + found["byteOffset"].get<std::size_t>(), 4 * values.size());
    return values;
}

// One of meshopt's encoders.
struct MeshoptFilter {
    const char* name;
    std::size_t stride;
    void (*encode)(void* out, std::size_t count, std::size_t stride, int bits, const float* data);
    int bits;
};

// Encodes an accessor's floats, `width` an element, for a filter.
inline void filter_accessor(GltfBuilder& builder, int index, std::size_t width, const MeshoptFilter& filter) {
    json& accessor = builder.document["accessors"][static_cast<std::size_t>(index)];
    const std::size_t count = accessor["count"];
    const std::vector<float> values = floats_of(builder, index);
    const bool exponential = std::string(filter.name) == "EXPONENTIAL";
    const std::size_t taken = exponential ? width : 4;
    std::vector<float> padded(count * taken, 0.0f);
    for (std::size_t i = 0; i < values.size(); ++i) padded[i / width * taken + i % width] = values[i];
    std::vector<char> encoded(count * filter.stride);
    filter.encode(encoded.data(), count, filter.stride, filter.bits, padded.data());
    PackedData packed = pack_attributes(encoded.data(), count, filter.stride);
    packed.filter = filter.name;
    replace_view(builder, accessor["bufferView"], packed, "EXT_meshopt_compression");
    if (exponential) return;
    accessor["componentType"] = static_cast<int>(filter.stride == 4 ? i8 : i16);
    accessor["normalized"] = true;
    builder.document["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteStride"] = filter.stride;
}

// With the buffer that compressed views fall back to, without data.
inline std::string packed_glb(GltfBuilder builder) {
    builder.glb();
    builder.document["buffers"] = {
        {{"byteLength", builder.binary.size()}},
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return make_glb(builder.document.dump(), builder.binary);
}

}  // namespace tests
