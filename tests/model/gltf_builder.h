// Small glTF files made by code, whole or damaged on purpose.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/io/gltf.h"
#include "tests/model/folder.h"

namespace tests {

using nlohmann::json;

inline std::string bytes_of_u32(std::uint32_t value) {
    return {static_cast<char>(value), static_cast<char>(value >> 8), static_cast<char>(value >> 16),
            static_cast<char>(value >> 24)};
}

inline std::string make_glb(std::string text, std::string binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string body = bytes_of_u32(static_cast<std::uint32_t>(text.size())) + "JSON" + text;
    if (!binary.empty())
        body += bytes_of_u32(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
    return "glTF" + bytes_of_u32(2) + bytes_of_u32(static_cast<std::uint32_t>(12 + body.size())) + body;
}

// A PNG of RGB texels, uncompressed; without texels, one that lies about its size. Readers that check sums would refuse
// it; stb_image does not.
inline std::string make_png(std::uint32_t width, std::uint32_t height, const std::string& rgb) {
    const auto big = [](std::uint32_t v) {
        return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
                           static_cast<char>(v)};
    };
    const auto chunk = [&](const std::string& name, const std::string& data) {
        return big(static_cast<std::uint32_t>(data.size())) + name + data + std::string(4, '\0');
    };
    std::string rows;
    for (std::uint32_t y = 0; y < height && !rgb.empty(); ++y)
        rows += '\0' + rgb.substr(std::size_t{3} * width * y, std::size_t{3} * width);
    const auto length = static_cast<std::uint16_t>(rows.size());
    const std::string stored = {'\x78',
                                '\x01',
                                '\x01',
                                static_cast<char>(length),
                                static_cast<char>(length >> 8),
                                static_cast<char>(~length),
                                static_cast<char>(~length >> 8)};
    return std::string("\x89PNG\r\n\x1a\n", 8) +
           chunk("IHDR", big(width) + big(height) + std::string("\x08\x02\0\0\0", 5)) +
           chunk("IDAT", stored + rows + std::string(4, '\0')) + chunk("IEND", "");
}

enum ComponentType { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

// Collects accessors into one buffer.
class GltfBuilder {
public:
    json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0},
                     {"scenes", {{{"nodes", {0}}}}},  {"nodes", json::array()},
                     {"meshes", json::array()},       {"accessors", json::array()},
                     {"bufferViews", json::array()}};
    std::string binary;

    int add_view(const std::string& bytes) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
        binary += bytes;
        return static_cast<int>(document["bufferViews"].size()) - 1;
    }

    template <typename T>
    int add(const std::string& type, ComponentType component, std::size_t width, const std::vector<T>& values) {
        std::string bytes(values.size() * sizeof(T), '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        document["accessors"].push_back({{"bufferView", add_view(bytes)},
                                         {"componentType", static_cast<int>(component)},
                                         {"count", values.size() / width},
                                         {"type", type}});
        return static_cast<int>(document["accessors"].size()) - 1;
    }
    int scalars(const std::vector<float>& values) { return add("SCALAR", f32, 1, values); }
    int vec2(const std::vector<float>& values) { return add("VEC2", f32, 2, values); }
    int vec3(const std::vector<float>& values) { return add("VEC3", f32, 3, values); }
    int vec4(const std::vector<float>& values) { return add("VEC4", f32, 4, values); }
    int indices(const std::vector<std::uint16_t>& values) { return add("SCALAR", u16, 1, values); }

    json& node(std::size_t index) {
        while (document["nodes"].size() <= index) document["nodes"].push_back(json::object());
        return document["nodes"][index];
    }

    // One mesh with one primitive; returns that primitive.
    json& add_mesh(const json& attributes) {
        document["meshes"].push_back({{"primitives", {{{"attributes", attributes}}}}});
        return document["meshes"].back()["primitives"][0];
    }

    std::string glb() {
        if (!binary.empty()) document["buffers"] = {{{"byteLength", binary.size()}}};
        return make_glb(document.dump(), binary);
    }
};

// The unit square in the xy plane, facing +z, as one mesh on node 0.
inline GltfBuilder make_square() {
    GltfBuilder builder;
    const int positions = builder.vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    builder.add_mesh({{"POSITION", positions}})["indices"] = builder.indices({0, 1, 2, 0, 2, 3});
    builder.node(0)["mesh"] = 0;
    return builder;
}

// A square with everything on it: texture, material, vertex colours, skin, morph target and a clip.
inline GltfBuilder make_everything() {
    GltfBuilder builder;
    const json attributes = {
        {"POSITION", builder.vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})},
        {"NORMAL", builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})},
        {"TEXCOORD_0", builder.vec2({0, 0, 1, 0, 1, 1, 0, 1})},
        {"COLOR_0", builder.vec4(std::vector<float>(16, 1.0f))},
        {"JOINTS_0", builder.add<std::uint8_t>("VEC4", u8, 4, {0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0})},
        {"WEIGHTS_0", builder.vec4({2, 2, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0})}};
    json& primitive = builder.add_mesh(attributes);
    primitive["indices"] = builder.indices({0, 1, 2, 0, 2, 3});
    primitive["material"] = 0;
    primitive["targets"] = {{{"POSITION", builder.vec3({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4})}}};
    builder.document["meshes"][0]["weights"] = {0.25};
    builder.node(0) = {{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}};
    builder.node(1) = {{"name", "root"}, {"children", {2}}, {"rotation", {0, 0, 0, 1}}};
    builder.node(2) = {{"name", "tip"}, {"translation", {0, 2, 0}}};
    builder.document["scenes"][0]["nodes"] = {0, 1};
    std::vector<float> binds(32, 0.0f);
    for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) binds[i] = 1;
    builder.document["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", builder.add("MAT4", f32, 16, binds)}}};
    const int times = builder.scalars({0, 0.5f, 2});
    builder.document["animations"] = {
        {{"name", "wag"},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers",
          {{{"input", times}, {"output", builder.vec3({0, 2, 0, 0, 3, 0, 0, 2, 0})}},
           {{"input", times}, {"output", builder.scalars({0, 1, 0})}, {"interpolation", "STEP"}}}}}};
    builder.document["images"] = {
        {{"mimeType", "image/png"}, {"bufferView", builder.add_view(make_png(2, 1, "\xff\x20\x10\x01\x02\x03"))}}};
    builder.document["textures"] = {{{"source", 0}}};
    builder.document["materials"] = {
        {{"doubleSided", true},
         {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.0, 0.5}}, {"baseColorTexture", {{"index", 0}}}}}}};
    return builder;
}

// What the loader makes of it.
inline model::Character load(GltfBuilder builder) {
    const TemporaryFolder folder;
    return model::load_gltf(folder.write("built.glb", builder.glb()));
}

}  // namespace tests
