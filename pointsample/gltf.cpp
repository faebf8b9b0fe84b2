#include "pointsample/gltf.h"

#include <new>
#include <stdexcept>
#include <string>

#include "pointsample/gltf_file.h"

namespace pointsample {
namespace {

motion::Character load(const std::filesystem::path& path) {
    GltfFile file = open_gltf(path);
    motion::Character character;
    character.name = path.stem().string();
    const NodeOrder nodes = build_nodes(file, character.skeleton);
    build_mesh(file, nodes, character);
    if (character.mesh.indices.empty()) fail("no triangles", "a mesh in the default scene");
    build_clips(file, nodes, character.clips);
    return character;
}

// Names out of the file may hold anything.
std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return text;
}

}  // namespace

motion::Character load_gltf(const std::filesystem::path& path) {
    try {
        return load(path);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(path.string() + ": found more than fits into memory; expected a character");
    } catch (const std::exception& error) {
        throw std::runtime_error(one_line(path.string() + ": " + error.what()));
    }
}

}  // namespace pointsample
