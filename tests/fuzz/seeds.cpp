// Writes the files that the fuzzers of files begin from: fuzz_seeds FOLDER makes FOLDER/gltf, FOLDER/obj ..., a folder
// a fuzzer. Small ones, which together reach every reader and decoder.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pointsample/points_file.h"
#include "tests/model/draco_packer.h"
#include "tests/model/gltf_packer.h"
#include "tests/model/gzip.h"
#include "tests/model/webp.h"
#include "tests/model/whole_files.h"
#include "tests/pointsample/models.h"

namespace {

using tests::GltfBuilder;
using tests::json;

class Folder {
public:
    explicit Folder(std::filesystem::path path) : path_(std::move(path)) { std::filesystem::create_directories(path_); }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream file(path_ / name, std::ios::binary);
        if (!(file << bytes)) throw std::runtime_error((path_ / name).string() + " can't be written");
    }

private:
    std::filesystem::path path_;
};

// Data that nothing reads any more would be what is damaged most.
GltfBuilder without_unused_data(GltfBuilder builder) {
    std::set<std::size_t> used;
    const json flat = builder.document.flatten();
    for (const auto& [place, value] : flat.items())
        if (place.ends_with("/bufferView")) used.insert(value.get<std::size_t>());
    std::string kept;
    const auto keep = [&](json& stretch) {
        kept.resize((kept.size() + 3) / 4 * 4, '\0');
        const std::string bytes = builder.binary.substr(stretch["byteOffset"], stretch["byteLength"]);
        stretch["byteOffset"] = kept.size();
        kept += bytes;
    };
    json& views = builder.document["bufferViews"];
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (views[i].contains("extensions"))
            keep(views[i]["extensions"].front());
        else if (used.contains(i))
            keep(views[i]);
        else
            views[i].update({{"byteOffset", 0}, {"byteLength", 1}});
    }
    builder.binary = kept;
    return builder;
}

std::string meshopt_glb(const GltfBuilder& builder, const char* mode) {
    return tests::packed_glb(without_unused_data(tests::pack_meshopt(builder, mode)));
}

std::string draco_glb(const GltfBuilder& builder, int method) {
    return without_unused_data(tests::pack_draco(builder, method)).glb();
}

std::string webp(bool lossless) {
    constexpr int side = 16;
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < side * side; ++i)
        for (const int value : {i, 7 * i, 255 - i, i % 5 == 0 ? 90 : 255})
            rgba.push_back(static_cast<std::uint8_t>(value));
    return tests::make_webp(side, side, rgba, lossless);
}

const json& attributes(const GltfBuilder& builder) {
    return builder.document["meshes"][0]["primitives"][0]["attributes"];
}

std::string filtered_glb() {
    GltfBuilder builder = tests::make_barrel();
    builder.document["animations"][0]["channels"][0]["target"]["path"] = "rotation";
    const int rotations = builder.vec4({0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0.5f, -0.5f, 0.70710678f});
    builder.document["animations"][0]["samplers"][0]["output"] = rotations;
    tests::filter_accessor(builder, attributes(builder)["POSITION"], 3,
                           {"EXPONENTIAL", 12, meshopt_encodeFilterExp, 22});
    tests::filter_accessor(builder, attributes(builder)["NORMAL"], 3, {"OCTAHEDRAL", 4, meshopt_encodeFilterOct, 8});
    tests::filter_accessor(builder, rotations, 4, {"QUATERNION", 8, meshopt_encodeFilterQuat, 16});
    return tests::packed_glb(without_unused_data(builder));
}

std::string quantized_glb() {
    GltfBuilder builder = tests::make_everything();
    json& found = builder.document["meshes"][0]["primitives"][0]["attributes"];
    found["POSITION"] = builder.add<std::int16_t>("VEC3", tests::i16, 3, {0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 100, 0});
    found["TEXCOORD_0"] = builder.add<std::uint16_t>("VEC2", tests::u16, 2, {0, 0, 65535, 0, 65535, 65535, 0, 65535});
    builder.document["accessors"].back()["normalized"] = true;
    builder.document["extensionsUsed"] = builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    return builder.glb();
}

std::string sparse_glb() {
    GltfBuilder builder = tests::make_everything();
    const int indices = builder.add_view(std::string("\x01", 2)), values = builder.add_view(std::string(12, '\x3f'));
    builder.document["accessors"][attributes(builder)["POSITION"].get<std::size_t>()]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", static_cast<int>(tests::u16)}}},
        {"values", {{"bufferView", values}}}};
    return builder.glb();
}

std::string looks_glb() {
    GltfBuilder builder = tests::make_everything();
    builder.document["images"].push_back({{"bufferView", builder.add_view(webp(true))}});
    builder.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    builder.document["textures"] = {
        {{"source", 0}, {"sampler", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    json& material = builder.document["materials"][0];
    material["alphaMode"] = "MASK";
    material["emissiveFactor"] = {1, 0.5, 0};
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 0}};
    material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 0.7}}}};
    material["extensions"] = {{"KHR_materials_unlit", json::object()},
                              {"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {1, 1, 0, 1}}}}};
    return builder.glb();
}

// As a text with its data inside.
std::string text_gltf() {
    GltfBuilder builder = tests::make_everything();
    builder.glb();  // completes the document
    std::string uri = "data:application/octet-stream,";
    for (const char byte : builder.binary) {
        constexpr const char* digits = "0123456789abcdef";
        const auto value = static_cast<unsigned char>(byte);
        uri += {'%', digits[value / 16], digits[value % 16]};
    }
    builder.document["buffers"][0]["uri"] = uri;
    return builder.document.dump();
}

void write_gltf(const Folder& folder) {
    folder.write("square.glb", tests::make_square().glb());
    folder.write("everything.glb", tests::make_everything().glb());
    folder.write("text.gltf", text_gltf());
    folder.write("looks.glb", looks_glb());
    folder.write("sparse.glb", sparse_glb());
    folder.write("quantized.glb", quantized_glb());
    folder.write("filtered.glb", filtered_glb());
    for (const char* mode : {"TRIANGLES", "INDICES"}) {
        folder.write("meshopt_square_" + std::string(mode), meshopt_glb(tests::make_square(), mode));
        folder.write("meshopt_barrel_" + std::string(mode), meshopt_glb(tests::make_barrel(), mode));
    }
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        folder.write("draco_square_" + std::to_string(method), draco_glb(tests::make_square(), method));
        folder.write("draco_barrel_" + std::to_string(method), draco_glb(tests::make_barrel(), method));
    }
}

void write_ply(const Folder& folder) {
    folder.write("full.ply", tests::full_ply());
    for (const char* format : tests::ply_formats)
        folder.write(std::string(format) + ".ply", tests::ply_of(tests::make_cube(), format));
}

void write_points(const Folder& folder) {
    std::ostringstream out;
    pointsample::write_pts(out, tests::random_model(20, 6), "key");
    folder.write("random.pts", out.str());
}

void write_seeds(const std::filesystem::path& path) {
    write_gltf(Folder(path / "gltf"));
    write_ply(Folder(path / "ply"));
    write_points(Folder(path / "pts"));
    Folder(path / "obj").write("whole.obj", tests::whole_obj());
    Folder(path / "off").write("whole.off", tests::whole_off());
    Folder(path / "stl").write("binary.stl", tests::binary_stl());
    Folder(path / "stl").write("text.stl", tests::text_stl());
    Folder(path / "gzip").write("full.ply.gz", tests::gzip(tests::full_ply()));
    Folder(path / "gzip")
        .write("two.ply.gz", tests::gzip(tests::full_ply()) + tests::gzip("\n") + std::string(3, '\0'));
    Folder(path / "image").write("lossless.webp", webp(true));
    Folder(path / "image").write("lossy.webp", webp(false));
    Folder(path / "image").write("two.png", tests::make_png(2, 1, "\xff\x20\x10\x01\x02\x03"));
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "fuzz_seeds FOLDER\n";
        return 2;
    }
    try {
        write_seeds(arguments[1]);
    } catch (const std::exception& error) {
        std::cerr << "fuzz_seeds: " << error.what() << '\n';
        return 1;
    }
}
