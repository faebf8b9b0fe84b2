#include "model/io/obj_materials.h"

#include <optional>
#include <stdexcept>

#include "model/input_file.h"
#include "model/io/words.h"
#include "model/srgb.h"

namespace model {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_libraries = 256;

// How many words follow an option of map_Kd at most; those of -o, -s and -t are numbers, one to three.
int words_of_option(std::string_view option) {
    if (option == "-o" || option == "-s" || option == "-t") return 3;
    return option == "-mm" ? 2 : 1;
}

bool is_number(std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
}

// The name in `map_Kd [-OPTION VALUES] NAME`; it may hold blanks.
std::string map_name(Words words) {
    std::string_view rest = words.rest();
    while (rest.starts_with('-')) {
        const std::string_view option = words.next();
        for (int i = words_of_option(option); i > 0; --i) {
            Words ahead = words;
            const std::string_view value = ahead.next();
            if (i < words_of_option(option) && !is_number(value)) break;
            words = ahead;
        }
        rest = words.rest();
    }
    return std::string(rest);
}

// `Kd r g b`; with one number, a grey. Spectra (Kd spectral ...) are left white. None: it has what is no number.
std::optional<glm::vec3> diffuse_of(Words words) {
    if (words.rest().starts_with("spectral") || words.rest().starts_with("xyz")) return glm::vec3(1.0f);
    try {
        glm::vec3 color(to_float(words.next()));
        for (int i = 1; i < 3 && !words.at_end(); ++i) color[i] = to_float(words.next());
        return color;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

}  // namespace

void ObjMaterials::add_libraries(std::string_view names) {
    Words words(names);
    const std::string_view whole = words.rest();
    if (add_library(whole)) return;  // one name with blanks
    bool all = !whole.empty();
    for (std::string_view name = words.next(); !name.empty(); name = words.next()) all = add_library(name) && all;
    if (!all) warnings_.add("material library not found, left out", whole);
}

bool ObjMaterials::add_library(std::string_view name) {
    const fs::path path = finder_.find(name);
    if (path.empty()) return false;
    if (!libraries_.insert(path.lexically_normal().string()).second) return true;
    if (libraries_.size() > most_libraries)
        fail("more than " + std::to_string(most_libraries) + " material libraries", "fewer");
    read_library(path);
    return true;
}

void ObjMaterials::read_library(const fs::path& path) {
    InputFile file(path, "a material library");
    Material* material = nullptr;
    std::string_view line;
    while (file.line(line)) {
        Words words(line);
        const std::string_view keyword = words.next();
        if (keyword == "newmtl")
            material = &(materials_[std::string(words.rest())] = {});
        else if (material && keyword == "Kd")
            read_diffuse(words, *material);
        else if (material && keyword == "map_Kd")
            material->map = map_name(words);
    }
}

void ObjMaterials::read_diffuse(Words words, Material& material) {
    const std::string text(words.rest());
    if (const auto color = diffuse_of(words))
        material.diffuse = *color;
    else
        warnings_.add("material colour is no number, left white", "Kd " + text);
}

ObjLook ObjMaterials::look_of(std::string_view name) {
    const auto found = materials_.find(name);
    if (found == materials_.end()) {
        const bool none = name.empty() || name == "None" || name == "(null)";  // as exporters write
        if (!none) warnings_.add("material not found, left white", name);
        return {};
    }
    const Material& material = found->second;
    ObjLook look;
    if (!material.map.empty()) look.texture = textures_.of_file(material.map);
    // Exporters write black where a texture says it all.
    if (!material.map.empty() && material.diffuse == glm::vec3(0.0f)) return look;
    for (int i = 0; i < 3; ++i) look.color[i] = unit_byte(material.diffuse[i]);
    return look;
}

}  // namespace model
