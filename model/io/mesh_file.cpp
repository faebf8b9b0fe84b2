#include "model/io/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

#include "model/input_file.h"
#include "model/io/gltf.h"
#include "model/io/mesh_readers.h"

namespace model {
namespace {

// What files without a skeleton don't hold: all hangs on one node.
Character statue_of(Mesh mesh, const std::string& name) {
    if (mesh.indices.empty()) fail("no triangles", "at least one face of three corners");
    const std::size_t count = mesh.vertex_count();
    mesh.uvs.resize(count, glm::vec2(0.0f));
    mesh.colors.resize(count, glm::u8vec4(255));
    mesh.slots.resize(count, no_slot);
    mesh.material_ids.resize(count, 0);
    mesh.joints.resize(count, glm::u16vec4(0));
    mesh.weights.resize(count, glm::vec4(1, 0, 0, 0));
    if (mesh.materials.empty()) mesh.materials.emplace_back();
    for (Material& material : mesh.materials) material.double_sided = true;  // a closed surface looks the same
    Character character;
    character.name = name;
    character.mesh = std::move(mesh);
    character.skeleton.nodes.push_back({name, -1, {}, glm::mat4(1.0f)});
    character.skeleton.palette.push_back({0, glm::mat4(1.0f)});
    return character;
}

using Read = Mesh (*)(const std::filesystem::path&, Warnings&);

Character load_statue(const std::filesystem::path& path, const std::string& name, Read read) {
    return with_name(path, [&] {
        Warnings warnings;
        Character character = statue_of(read(path, warnings), name);
        character.warnings = std::move(warnings);
        return character;
    });
}

std::string lower_case(const std::filesystem::path& path) {
    std::string text = path.string();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_gltf(std::string_view extension) {
    return extension == ".glb" || extension == ".gltf" || extension == ".vrm";
}

}  // namespace

Character load_mesh(const std::filesystem::path& path) {
    static constexpr std::array<std::pair<const char*, Read>, 4> readers{
        {{".obj", read_obj}, {".ply", read_ply}, {".stl", read_stl}, {".off", read_off}}};
    constexpr const char* formats = ".glb, .gltf, .vrm, .obj, .ply, .stl or .off";
    std::filesystem::path name = path.filename();
    const bool packed = lower_case(name.extension()) == ".gz";
    if (packed) name = name.stem();
    const std::string extension = lower_case(name.extension());
    if (!packed && (is_gltf(extension))) return load_gltf(path);
    for (const auto& [suffix, read] : readers)
        if (extension == suffix) return load_statue(path, name.stem().string(), read);
    return with_name(path, [&]() -> Character {
        const InputFile file(path, std::string("a file that ends in ") + formats);  // a folder has no extension
        fail(extension.empty() ? "a name without extension" : "a name that ends in " + in_quotes(extension), formats);
    });
}

}  // namespace model
