#include "model/io/gltf.h"

#include "model/io/cutouts.h"
#include "model/io/gltf_file.h"

namespace model {
namespace {

Character load(const std::filesystem::path& path) {
    Character character;
    GltfFile file = open_gltf(path, character.warnings);
    character.name = path.stem().string();
    const NodeOrder nodes = build_nodes(file, character.skeleton);
    build_mesh(file, nodes, character);
    fill_cutouts(character.mesh);
    if (character.mesh.indices.empty()) fail("no triangles", "a mesh in the default scene");
    build_clips(file, nodes, character);
    move_near(file, nodes, character);
    return character;
}

}  // namespace

Character load_gltf(const std::filesystem::path& path) {
    return with_name(path, [&] { return load(path); });
}

}  // namespace model
