// Files of GltfBuilder with their first primitive compressed, by Draco's own encoder.
#pragma once

#include <draco/compression/encode.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "tests/model/gltf_builder.h"

namespace tests {

inline constexpr int draco_position_bits = 14;

inline std::string bytes_of_accessor(const GltfBuilder& builder, const json& accessor) {
    const json& view = builder.document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    return builder.binary.substr(view["byteOffset"], view["byteLength"]);
}

// Returns its id, which primitives name it by.
inline std::uint32_t add_draco_attribute(draco::Mesh& mesh, const std::string& name, const json& accessor,
                                         const std::string& bytes) {
    using draco::GeometryAttribute;
    const bool bytewise = accessor["componentType"] == static_cast<int>(u8);
    const auto width = static_cast<std::uint8_t>(accessor["type"].get<std::string>().back() - '0');
    const std::size_t size = (bytewise ? 1u : 4u) * width;
    const GeometryAttribute::Type type = name == "POSITION"     ? GeometryAttribute::POSITION
                                         : name == "NORMAL"     ? GeometryAttribute::NORMAL
                                         : name == "TEXCOORD_0" ? GeometryAttribute::TEX_COORD
                                                                : GeometryAttribute::GENERIC;
    GeometryAttribute attribute;
    attribute.Init(type, nullptr, width, bytewise ? draco::DT_UINT8 : draco::DT_FLOAT32, false,
                   static_cast<std::int64_t>(size), 0);
    const int at = mesh.AddAttribute(attribute, true, mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i)
        mesh.attribute(at)->SetAttributeValue(draco::AttributeValueIndex(i), bytes.data() + i * size);
    return mesh.attribute(at)->unique_id();
}

inline std::string encode_draco(const draco::Mesh& mesh, int method) {
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, draco_position_bits);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 14);
    draco::EncoderBuffer out;
    if (!encoder.EncodeMeshToBuffer(mesh, &out).ok()) return {};
    return {out.data(), out.size()};
}

// `method`: draco::MESH_SEQUENTIAL_ENCODING or MESH_EDGEBREAKER_ENCODING. Accessors lose their views, and these all
// that was in them.
inline GltfBuilder pack_draco(GltfBuilder builder, int method) {
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    json& accessors = builder.document["accessors"];
    draco::Mesh mesh;
    json ids = json::object();
    for (const auto& [name, index] : primitive["attributes"].items()) {
        const json& accessor = accessors[index.get<std::size_t>()];
        mesh.set_num_points(accessor["count"].get<std::uint32_t>());
        ids[name] = add_draco_attribute(mesh, name, accessor, bytes_of_accessor(builder, accessor));
        accessors[index.get<std::size_t>()].erase("bufferView");
    }
    json& indices = accessors[primitive["indices"].get<std::size_t>()];
    const std::string bytes = bytes_of_accessor(builder, indices);
    for (std::size_t i = 0; i + 6 <= bytes.size(); i += 6) {
        std::array<std::uint16_t, 3> corners;
        std::memcpy(corners.data(), bytes.data() + i, 6);
        draco::Mesh::Face face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = draco::PointIndex(corners[k]);
        mesh.AddFace(face);
    }
    indices.erase("bufferView");
    primitive["extensions"] = {{"KHR_draco_mesh_compression",
                                {{"bufferView", builder.add_view(encode_draco(mesh, method))}, {"attributes", ids}}}};
    builder.document["extensionsUsed"] = builder.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return builder;
}

}  // namespace tests
