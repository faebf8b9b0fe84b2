#include "model/io/obj_materials.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "model/input_file.h"
#include "model/io/image.h"
#include "model/io/words.h"
#include "model/srgb.h"

namespace model {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_libraries = 256;
constexpr std::uint64_t most_image_bytes = std::uint64_t{1} << 30;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

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

// `Kd r g b`; with one number, a grey. Spectra (Kd spectral ...) are left white.
glm::vec3 diffuse_of(Words words) {
    if (words.rest().starts_with("spectral") || words.rest().starts_with("xyz")) return glm::vec3(1.0f);
    glm::vec3 color(to_float(words.next()));
    for (int i = 1; i < 3 && !words.at_end(); ++i) color[i] = to_float(words.next());
    return color;
}

}  // namespace

fs::path ObjMaterials::place_of(std::string_view name) const {
    std::string file(name);
    if (file.find('\0') != std::string::npos) return {};
    std::replace(file.begin(), file.end(), '\\', '/');
    return folder_ / file;
}

void ObjMaterials::add_libraries(std::string_view names) {
    Words words(names);
    if (add_library(words.rest())) return;  // one name with blanks
    for (std::string_view name = words.next(); !name.empty(); name = words.next()) add_library(name);
}

bool ObjMaterials::add_library(std::string_view name) {
    const fs::path path = place_of(name);
    if (name.empty() || !is_file(path)) return false;
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
        try {
            if (keyword == "newmtl")
                material = &(materials_[std::string(words.rest())] = {});
            else if (material && keyword == "Kd")
                material->diffuse = diffuse_of(words);
            else if (material && keyword == "map_Kd")
                material->map = map_name(words);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(path.filename().string() + " line " + std::to_string(file.line_number()) + ": " +
                                     error.what());
        }
    }
}

ObjLook ObjMaterials::look_of(std::string_view name) {
    const auto found = materials_.find(name);
    if (found == materials_.end()) return {};
    const Material& material = found->second;
    ObjLook look;
    if (!material.map.empty()) look.texture = texture_of(material.map);
    // Exporters write black where a texture says it all.
    if (look.texture != no_texture && material.diffuse == glm::vec3(0.0f)) return look;
    for (int i = 0; i < 3; ++i) look.color[i] = unit_byte(material.diffuse[i]);
    return look;
}

std::uint8_t ObjMaterials::texture_of(const std::string& name) {
    const fs::path path = place_of(name);
    const auto [at, added] = texture_ids_.try_emplace(path.lexically_normal().string(), no_texture);
    if (!added || !is_file(path)) return at->second;
    if (textures_.size() >= no_texture) fail("more than 255 textures", "at most 255");
    textures_.push_back(decode_image(read_file(path, "a texture", most_image_bytes), texels_, in_quotes(name)));
    at->second = static_cast<std::uint8_t>(textures_.size() - 1);
    return at->second;
}

}  // namespace model
