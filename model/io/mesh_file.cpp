#include "model/io/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <string>
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

Character load_statue(const std::filesystem::path& path, Mesh (*read)(const std::filesystem::path&, Warnings&)) {
    return with_name(path, [&] {
        Warnings warnings;
        Character character = statue_of(read(path, warnings), path.stem().string());
        character.warnings = std::move(warnings);
        return character;
    });
}

}  // namespace

Character load_mesh(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".glb" || extension == ".gltf") return load_gltf(path);
    if (extension == ".obj") return load_statue(path, read_obj);
    if (extension == ".ply") return load_statue(path, read_ply);
    return with_name(path, [&]() -> Character {
        const InputFile file(path,
                             "a .glb, .gltf, .obj or .ply file");  // a folder's lack of extension is not the point
        fail(extension.empty() ? "a name without extension" : "a name that ends in " + in_quotes(extension),
             ".glb, .gltf, .obj or .ply");
    });
}

}  // namespace model
