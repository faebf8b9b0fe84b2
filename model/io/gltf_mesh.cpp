#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "model/io/gltf_file.h"
#include "model/io/materials.h"
#include "model/io/normals.h"
#include "model/io/uv_map.h"
#include "model/srgb.h"

namespace model {
namespace {

using Indices = std::vector<std::uint32_t>;

// Where a primitive's vertices hang: a skin's joints, or one node.
struct Attachment {
    std::vector<std::uint16_t> joints;  // palette entry of each of the skin's joints; a rigid part has just its own
    bool skinned = false;
};

// The palette, each (node, inverse bind) once: parts of one character tend to repeat one skin.
class PaletteBuilder {
public:
    explicit PaletteBuilder(Skeleton& skeleton) : skeleton_(skeleton) {}

    std::uint16_t entry(std::int32_t node, const glm::mat4& inverse_bind) {
        std::array<float, 16> key;
        for (int i = 0; i < 16; ++i) key[static_cast<std::size_t>(i)] = inverse_bind[i / 4][i % 4];
        const auto [at, added] =
            entries_.try_emplace({node, key}, static_cast<std::uint16_t>(skeleton_.palette.size()));
        if (!added) return at->second;
        if (skeleton_.palette.size() > std::numeric_limits<std::uint16_t>::max())
            fail("more than 65536 joints and rigid parts", "fewer");
        skeleton_.palette.push_back({node, inverse_bind});
        return at->second;
    }

private:
    Skeleton& skeleton_;
    std::map<std::pair<std::int32_t, std::array<float, 16>>, std::uint16_t> entries_;
};

// Where in it a texture is read.
struct UvPlace {
    int set = 0;
    glm::mat3 transform{1.0f};  // KHR_texture_transform
    Sampler sampler;

    bool operator==(const UvPlace&) const = default;
};

// What a material says about looks; the default is glTF's.
struct Look {
    std::string name;
    glm::vec4 factor{1.0f};  // linear
    Material material;
    UvPlace place;                      // of the base colour's texture
    std::optional<UvPlace> glow_place;  // of the emissive one, if that is another
};

float number_at(const tinygltf::Value& object, const char* name, std::size_t index, float fallback) {
    if (!object.Has(name)) return fallback;
    const tinygltf::Value& array = object.Get(name);
    if (!array.IsArray() || index >= array.ArrayLen()) return fallback;
    const tinygltf::Value& value = array.Get(static_cast<int>(index));
    const float number = value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : fallback;
    return std::isfinite(number) ? number : fallback;
}

void apply_texture_transform(const tinygltf::ExtensionMap& extensions, UvPlace& place) {
    const auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end() || !found->second.IsObject()) return;
    const tinygltf::Value& value = found->second;
    const glm::vec2 offset(number_at(value, "offset", 0, 0), number_at(value, "offset", 1, 0));
    const glm::vec2 scale(number_at(value, "scale", 0, 1), number_at(value, "scale", 1, 1));
    float angle = 0;
    if (value.Has("rotation") && value.Get("rotation").IsNumber())
        angle = static_cast<float>(value.Get("rotation").GetNumberAsDouble());
    if (!std::isfinite(angle)) angle = 0;
    if (value.Has("texCoord") && value.Get("texCoord").IsInt()) place.set = value.Get("texCoord").GetNumberAsInt();
    const float c = std::cos(angle), s = std::sin(angle);
    place.transform = glm::mat3(glm::vec3(c * scale.x, -s * scale.x, 0), glm::vec3(s * scale.y, c * scale.y, 0),
                                glm::vec3(offset, 1));
}

float number_of(const tinygltf::Value& object, const char* name, float fallback) {
    if (!object.Has(name) || !object.Get(name).IsNumber()) return fallback;
    const float number = static_cast<float>(object.Get(name).GetNumberAsDouble());
    return std::isfinite(number) ? number : fallback;
}

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() || !found->second.IsObject() ? nullptr : &found->second;
}

// A texture as an extension names one.
tinygltf::TextureInfo texture_info(const tinygltf::Value& object, const char* name) {
    tinygltf::TextureInfo info;
    if (!object.Has(name) || !object.Get(name).IsObject()) return info;
    const tinygltf::Value& value = object.Get(name);
    const auto whole = [&](const char* key, float fallback) {
        constexpr float most = 1e6f;  // more than any file has
        return static_cast<int>(std::clamp(number_of(value, key, fallback), -1.0f, most));
    };
    info.index = whole("index", -1);
    info.texCoord = whole("texCoord", 0);
    if (value.Has("extensions") && value.Get("extensions").IsObject())
        for (const std::string& extension : value.Get("extensions").Keys())
            info.extensions[extension] = value.Get("extensions").Get(extension);
    return info;
}

UvPlace place_of(const tinygltf::TextureInfo& info, const TextureSet& textures) {
    UvPlace place{info.texCoord, glm::mat3(1.0f), textures.sampler_of(info.index)};
    apply_texture_transform(info.extensions, place);
    return place;
}

// The older model's diffuse colour where a material has that, else the metallic-roughness one's.
void read_base_color(const tinygltf::Material& found, TextureSet& textures, Look& look) {
    const tinygltf::Value* glossy = extension_of(found.extensions, "KHR_materials_pbrSpecularGlossiness");
    const tinygltf::PbrMetallicRoughness& pbr = found.pbrMetallicRoughness;
    for (std::size_t i = 0; i < 4; ++i) {
        float& factor = look.factor[static_cast<int>(i)];
        if (glossy != nullptr)
            factor = number_at(*glossy, "diffuseFactor", i, 1);
        else if (pbr.baseColorFactor.size() == 4)
            factor = static_cast<float>(pbr.baseColorFactor[i]);
    }
    const tinygltf::TextureInfo info =
        glossy != nullptr ? texture_info(*glossy, "diffuseTexture") : pbr.baseColorTexture;
    look.material.texture = textures.id_of(info.index);
    look.place = place_of(info, textures);
}

void read_emission(const tinygltf::Material& found, TextureSet& textures, Look& look) {
    glm::vec3& emissive = look.material.emissive;
    for (int i = 0; i < 3 && found.emissiveFactor.size() == 3; ++i)
        emissive[i] = std::max(0.0f, static_cast<float>(found.emissiveFactor[static_cast<std::size_t>(i)]));
    if (const auto* strength = extension_of(found.extensions, "KHR_materials_emissive_strength"))
        emissive *= std::max(0.0f, number_of(*strength, "emissiveStrength", 1));
    if (!std::isfinite(emissive.x + emissive.y + emissive.z)) emissive = glm::vec3(0.0f);
    if (emissive == glm::vec3(0.0f) || found.emissiveTexture.index < 0) return;
    look.material.emissive_texture = textures.id_of(found.emissiveTexture.index);
    // Without its texture a glow would cover all that it leaves dark.
    if (look.material.emissive_texture == no_texture) emissive = glm::vec3(0.0f);
    const UvPlace own = place_of(found.emissiveTexture, textures);
    if (look.material.texture == no_texture)
        look.place = own;
    else if (look.material.emissive_texture != no_texture && own != look.place)
        look.glow_place = own;
}

void read_alpha(const tinygltf::Material& found, Warnings& warnings, Look& look) {
    if (found.alphaMode == "MASK") {
        const float cutoff = static_cast<float>(found.alphaCutoff);
        look.material.alpha_cutoff = std::isfinite(cutoff) ? std::max(cutoff, 0.0f) : 0.5f;
    } else if (found.alphaMode == "BLEND") {
        look.material.alpha_cutoff = 0.5f;
        warnings.add("blended material, cut out at one half", found.name);
    }
}

Look look_of(const GltfFile& file, int material, TextureSet& textures, Warnings& warnings) {
    Look look;
    if (material < 0) return look;
    if (static_cast<std::size_t>(material) >= file.model.materials.size()) {
        warnings.add("material that doesn't exist, left out", "material " + std::to_string(material));
        return look;
    }
    const tinygltf::Material& found = file.model.materials[static_cast<std::size_t>(material)];
    read_base_color(found, textures, look);
    read_emission(found, textures, look);
    look.material.sampler = look.place.sampler;
    look.name = found.name;
    read_alpha(found, warnings, look);
    look.material.double_sided = found.doubleSided;
    look.material.unlit = found.extensions.contains("KHR_materials_unlit");
    return look;
}

int attribute_of(const std::map<std::string, int>& attributes, const std::string& name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
}

std::optional<Accessor> optional_accessor(GltfFile& file, const std::map<std::string, int>& attributes,
                                          const std::string& name, int width, std::size_t vertex_count) {
    const int index = attribute_of(attributes, name);
    if (index < 0) return std::nullopt;
    Accessor accessor(file, index, width);
    if (accessor.count() < vertex_count)
        fail(std::to_string(accessor.count()) + " elements of " + name,
             "as many as of POSITION, " + std::to_string(vertex_count));
    return accessor;
}

// The file's vertices of a primitive's triangles, three a triangle; lines and points have none.
Indices read_triangles(GltfFile& file, const tinygltf::Primitive& primitive, std::size_t vertex_count) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        fail("primitive mode " + std::to_string(primitive.mode), "0 to 6");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return {};
    Indices corners;
    if (primitive.indices >= 0) {
        const Accessor accessor(file, primitive.indices, 1);
        file.budget.spend(accessor.count());
        corners.resize(accessor.count());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corners[i] = accessor.index(i, 0);
            if (corners[i] >= vertex_count)
                fail("vertex index " + std::to_string(corners[i]), "below " + std::to_string(vertex_count));
        }
    } else {
        file.budget.spend(vertex_count);
        corners.resize(vertex_count);
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
        corners.resize(corners.size() - corners.size() % 3);
        return corners;
    }
    Indices triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const bool odd = !fan && i % 2 == 1;  // every other triangle of a strip winds backwards
        const std::uint32_t first = fan ? corners[0] : corners[i];
        triangles.insert(triangles.end(), {first, corners[i + (odd ? 2 : 1)], corners[i + (odd ? 1 : 2)]});
    }
    return triangles;
}

// Keeps the vertices that triangles use: `triangles` becomes indices into the returned list.
Indices compact(GltfFile& file, Indices& triangles) {
    if (triangles.empty()) return {};
    const auto [low, high] = std::minmax_element(triangles.begin(), triangles.end());
    const std::uint32_t first = *low;
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    file.budget.spend(*high - first);  // parts that share one accessor each use a stretch of it
    Indices place(std::size_t{*high - first} + 1, unused), used;
    for (const std::uint32_t corner : triangles) place[corner - first] = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == unused) continue;
        place[i] = static_cast<std::uint32_t>(used.size());
        used.push_back(first + static_cast<std::uint32_t>(i));
    }
    for (std::uint32_t& corner : triangles) corner = place[corner - first];
    return used;
}

glm::vec3 vector_at(const Accessor& accessor, std::size_t element) {
    return {accessor.finite(element, 0), accessor.finite(element, 1), accessor.finite(element, 2)};
}

// The unit normal of a triangle; zero if it has none.
glm::vec3 flat_normal(const std::array<glm::vec3, 3>& corners) {
    const glm::dvec3 first(corners[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - first, glm::dvec3(corners[2]) - first);
    const double length = glm::length(normal);
    return length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0.0f);
}

// Gives a vertex between triangles of other directions one place in `used` for each of them, so that all are flat. A
// vertex's list is looked through only so far: of thousands of directions one may come twice.
void split_at_edges(GltfFile& file, const Accessor& positions, Indices& triangles, Indices& used) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    constexpr float same = 1e-5f;  // between unit normals
    constexpr int patience = 64;
    std::vector<glm::vec3> normals(used.size(), glm::vec3(0.0f));
    Indices next(used.size(), none);  // the same vertex, for another direction
    std::vector<bool> taken(used.size(), false);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        std::array<glm::vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = vector_at(positions, used[triangles[i + k]]);
        const glm::vec3 normal = flat_normal(corners);
        if (normal == glm::vec3(0.0f)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& at = triangles[i + k];
            const std::uint32_t first = at;
            int tries = 0;
            while (taken[at] && glm::distance(normals[at], normal) > same) {
                const bool give_up = ++tries == patience;
                if (give_up || next[at] == none) {
                    if (give_up) at = first;
                    file.budget.spend(1);
                    next.push_back(std::exchange(next[at], static_cast<std::uint32_t>(used.size())));
                    used.push_back(used[at]);
                    normals.emplace_back(0.0f);
                    taken.push_back(false);
                }
                at = next[at];
            }
            taken[at] = true;
            normals[at] = normal;
        }
    }
}

using InfluenceSet = std::pair<Accessor, Accessor>;  // joints and weights, four a vertex
constexpr std::size_t most_sets = 16;                // files have two or three
constexpr float heaviest = 1e30f;                    // all weights of a vertex have a sum

// Of one vertex.
struct Influences {
    std::array<std::pair<float, std::uint16_t>, 4 * most_sets> all;  // weight and palette entry
    std::size_t count = 0;

    // A joint that is named again just weighs more.
    void add(float weight, std::uint16_t joint) {
        std::size_t at = 0;
        while (at < count && all[at].second != joint) ++at;
        if (at == count) all[count++] = {0.0f, joint};
        all[at].first += weight;
    }

    float sum(std::size_t from, std::size_t to) const {
        float sum = 0;
        for (std::size_t i = from; i < to; ++i) sum += all[i].first;
        return sum;
    }
};

// Adds one primitive, hung on one attachment, to the mesh.
class PrimitiveWriter {
public:
    PrimitiveWriter(GltfFile& file, const tinygltf::Primitive& primitive, TextureSet& textures, Character& character)
        : file_(file),
          primitive_(primitive),
          textures_(textures),
          mesh_(character.mesh),
          warnings_(character.warnings),
          first_(character.mesh.positions.size()) {}

    void write(const Look& look, const Attachment& attachment) {
        const int position = attribute_of(primitive_.attributes, "POSITION");
        if (position < 0) return;
        const Accessor positions(file_, position, 3);
        vertex_count_ = positions.count();
        triangles_ = read_triangles(file_, primitive_, vertex_count_);
        used_ = compact(file_, triangles_);
        if (!primitive_.attributes.contains("NORMAL")) split_at_edges(file_, positions, triangles_, used_);
        if (used_.empty()) return;
        file_.budget.spend(used_.size());
        if (first_ + used_.size() > std::numeric_limits<std::uint32_t>::max()) fail("2^32 vertices", "fewer");
        for (const std::uint32_t vertex : used_) mesh_.positions.push_back(vector_at(positions, vertex));
        for (const std::uint32_t corner : triangles_)
            mesh_.indices.push_back(static_cast<std::uint32_t>(first_) + corner);
        write_normals();
        write_looks(look);
        write_influences(attachment);
    }

    void write_morphs(std::int32_t node, const std::vector<double>& rest_weights) {
        if (used_.empty()) return;
        for (std::size_t slot = 0; slot < primitive_.targets.size(); ++slot) {
            MorphTarget morph;
            morph.node = node;
            morph.weight = static_cast<std::int32_t>(slot);
            morph.rest_weight = slot < rest_weights.size() ? static_cast<float>(rest_weights[slot]) : 0.0f;
            if (!std::isfinite(morph.rest_weight)) fail("a morph weight that is not finite", "numbers");
            morph.first_vertex = static_cast<std::uint32_t>(first_);
            morph.position_offsets = offsets(primitive_.targets[slot], "POSITION");
            morph.normal_offsets = offsets(primitive_.targets[slot], "NORMAL");
            if (!morph.position_offsets.empty()) mesh_.morphs.push_back(std::move(morph));
        }
    }

private:
    std::vector<glm::vec3> offsets(const std::map<std::string, int>& target, const char* name) {
        const auto accessor = optional_accessor(file_, target, name, 3, vertex_count_);
        std::vector<glm::vec3> out;
        if (!accessor) return out;
        file_.budget.spend(used_.size());
        for (const std::uint32_t vertex : used_) out.push_back(vector_at(*accessor, vertex));
        return out;
    }

    // Without any normals triangles are flat, as glTF 2.0 says; single bad ones are the surface's.
    void write_normals() {
        const auto given = optional_accessor(file_, primitive_.attributes, "NORMAL", 3, vertex_count_);
        for (const std::uint32_t vertex : used_) {
            glm::vec3 normal(0.0f);
            for (int axis = 0; axis < 3 && given; ++axis) normal[axis] = given->number(vertex, axis);
            if (!std::isfinite(normal.x + normal.y + normal.z))
                warnings_.add("normal is no number, computed", "vertex " + std::to_string(vertex));
            mesh_.normals.push_back(normal);
        }
        complete_normals(std::span(mesh_.positions).subspan(first_), triangles_, {},
                         std::span(mesh_.normals).subspan(first_));
    }

    void write_looks(const Look& look) {
        Material material = look.material;
        const bool shown = material.texture != no_texture || material.emissive_texture != no_texture;
        std::vector<glm::vec2> uvs = uvs_at(look.place, shown);
        if (uvs.empty() && material.texture != no_texture) {
            warnings_.add("texture without coordinates, left out", look.name);
            material.texture = no_texture;
        }
        if (look.glow_place) uvs = join_glow(look, std::move(uvs), material);
        if (uvs.empty()) {
            if (material.emissive_texture != no_texture) material.emissive = glm::vec3(0.0f);
            material.emissive_texture = no_texture;
            uvs.resize(used_.size(), glm::vec2(0.0f));
        }
        mesh_.uvs.insert(mesh_.uvs.end(), uvs.begin(), uvs.end());
        write_colors(look.factor);
        mesh_.slots.resize(mesh_.positions.size(), no_slot);
        mesh_.material_ids.resize(mesh_.positions.size(), number_of(material, mesh_.materials));
    }

    // One a vertex; none if the file has none. shown: they matter.
    std::vector<glm::vec2> uvs_at(const UvPlace& place, bool shown) {
        std::vector<glm::vec2> uvs;
        const std::string name = "TEXCOORD_" + std::to_string(place.set);
        const auto given = optional_accessor(file_, primitive_.attributes, name, 2, vertex_count_);
        if (!given) return uvs;
        uvs.reserve(used_.size());
        for (const std::uint32_t vertex : used_) {
            const glm::vec3 uv = place.transform * glm::vec3(given->number(vertex, 0), given->number(vertex, 1), 1);
            const bool finite = std::isfinite(uv.x + uv.y);
            if (!finite && shown)
                warnings_.add("texture coordinate is no number, set to 0", "vertex " + std::to_string(vertex));
            uvs.push_back(finite ? glm::vec2(uv) : glm::vec2(0));
        }
        return uvs;
    }

    // Two textures that are read differently: the coordinates, of `uvs` and its own, that both can be read by, as one
    // is resampled for them. Where neither follows from the other the one that glows is left out.
    std::vector<glm::vec2> join_glow(const Look& look, std::vector<glm::vec2> uvs, Material& material) {
        std::vector<glm::vec2> own = uvs_at(*look.glow_place, true);
        const Sampler &base = look.place.sampler, &glow = look.glow_place->sampler;
        if (uvs.empty()) {
            material.sampler = glow;
            return own;
        }
        const std::uint8_t for_base = moved_texture(material.emissive_texture, uvs, own, base, glow);
        if (for_base != no_texture) {
            material.emissive_texture = for_base;
            return uvs;
        }
        const std::uint8_t for_own = moved_texture(material.texture, own, uvs, glow, base);
        if (for_own != no_texture) {
            material.texture = for_own;
            material.sampler = glow;
            return own;
        }
        warnings_.add("emissive texture read unlike the base colour's, left out", look.name);
        material.emissive_texture = no_texture;
        material.emissive = glm::vec3(0.0f);
        return uvs;
    }

    // A texture that is read at `from` by `by` and shows what texture `id` does at `to` by `sampler`, or no_texture.
    std::uint8_t moved_texture(std::uint8_t id, const std::vector<glm::vec2>& from, const std::vector<glm::vec2>& to,
                               const Sampler& by, const Sampler& sampler) {
        if (from.size() != to.size()) return no_texture;
        const auto map = uv_map(from, to, triangles_);
        return map && shows_all(from, by, sampler, *map) ? textures_.resampled_id(id, sampler, *map) : no_texture;
    }

    void write_colors(const glm::vec4& base) {
        const int color = attribute_of(primitive_.attributes, "COLOR_0");
        const int channels = color < 0 ? 0 : accessor_width(file_, color);
        if (color >= 0 && channels != 3 && channels != 4)
            fail(std::to_string(channels) + " components of COLOR_0", "3 or 4");
        const auto colors = optional_accessor(file_, primitive_.attributes, "COLOR_0", channels, vertex_count_);
        for (const std::uint32_t vertex : used_) {
            glm::vec4 factor = base;
            for (int i = 0; i < channels; ++i) {
                const float given = colors->number(vertex, i);
                if (std::isnan(given))
                    warnings_.add("colour is no number, left out", "vertex " + std::to_string(vertex));
                factor[i] *= std::isnan(given) ? 1.0f : given;
            }
            mesh_.colors.emplace_back(srgb_of_linear(factor.r), srgb_of_linear(factor.g), srgb_of_linear(factor.b),
                                      unit_byte(factor.a));
        }
    }

    // JOINTS_0 and WEIGHTS_0 and so on; none of a rigid part.
    std::vector<InfluenceSet> read_influence_sets(const Attachment& attachment) {
        std::vector<InfluenceSet> sets;
        while (attachment.skinned) {
            const std::string set = std::to_string(sets.size());
            auto joints = optional_accessor(file_, primitive_.attributes, "JOINTS_" + set, 4, vertex_count_);
            auto weights = optional_accessor(file_, primitive_.attributes, "WEIGHTS_" + set, 4, vertex_count_);
            if (!joints || !weights) break;
            if (sets.size() == most_sets)
                fail("more than " + std::to_string(4 * most_sets) + " influences of a vertex", "fewer");
            file_.budget.spend(sets.empty() ? 0 : used_.size());
            sets.emplace_back(std::move(*joints), std::move(*weights));
        }
        return sets;
    }

    void write_influences(const Attachment& attachment) {
        const std::vector<InfluenceSet> sets = read_influence_sets(attachment);
        Influences found;
        for (const std::uint32_t vertex : used_) {
            find_influences(attachment, sets, vertex, found);
            add_influences(found, vertex);
        }
        if (mesh_.more_joints.empty()) return;
        mesh_.more_joints.resize(mesh_.positions.size(), glm::u16vec4(0));
        mesh_.more_weights.resize(mesh_.positions.size(), glm::vec4(0.0f));
    }

    // All of a vertex, each joint once, the heaviest first; none at all hangs it on the first joint.
    static void find_influences(const Attachment& attachment, const std::vector<InfluenceSet>& sets, std::size_t vertex,
                                Influences& found) {
        found.count = 0;
        for (const auto& [joints, weights] : sets) {
            for (int i = 0; i < 4; ++i) {
                const float weight = std::min(weights.finite(vertex, i), heaviest);
                const std::uint32_t joint = joints.index(vertex, i);
                if (!(weight > 0.0f)) continue;
                if (joint >= attachment.joints.size())
                    fail("joint " + std::to_string(joint), "below " + std::to_string(attachment.joints.size()));
                found.add(weight, attachment.joints[joint]);
            }
        }
        if (found.count == 0) found.add(1.0f, attachment.joints.front());
        std::stable_sort(found.all.begin(), found.all.begin() + static_cast<std::ptrdiff_t>(found.count),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
    }

    // The eight heaviest, which weigh 1 together.
    void add_influences(const Influences& found, std::uint32_t vertex) {
        const std::size_t kept = std::min<std::size_t>(found.count, 8);
        const float sum = found.sum(0, kept);
        if (found.sum(kept, found.count) > 1e-3f * found.sum(0, found.count))
            warnings_.add("vertex with more than eight influences, the lightest left out", std::to_string(vertex));
        std::array<glm::u16vec4, 2> joints{glm::u16vec4(0), glm::u16vec4(0)};
        std::array<glm::vec4, 2> weights{glm::vec4(0.0f), glm::vec4(0.0f)};
        for (std::size_t i = 0; i < kept; ++i) {
            joints[i / 4][static_cast<int>(i % 4)] = found.all[i].second;
            weights[i / 4][static_cast<int>(i % 4)] = found.all[i].first / sum;
        }
        if (kept > 4) {
            mesh_.more_joints.resize(mesh_.joints.size(), glm::u16vec4(0));
            mesh_.more_weights.resize(mesh_.joints.size(), glm::vec4(0.0f));
            mesh_.more_joints.push_back(joints[1]);
            mesh_.more_weights.push_back(weights[1]);
        }
        mesh_.joints.push_back(joints[0]);
        mesh_.weights.push_back(weights[0]);
    }

    GltfFile& file_;
    const tinygltf::Primitive& primitive_;
    TextureSet& textures_;
    Mesh& mesh_;
    Warnings& warnings_;
    std::size_t first_, vertex_count_ = 0;
    Indices triangles_;  // into used_
    Indices used_;       // the file's vertices that triangles use
};

Attachment attach_to_skin(GltfFile& file, const tinygltf::Skin& skin, const NodeOrder& nodes, PaletteBuilder& palette) {
    Attachment attachment{{}, true};
    std::optional<Accessor> binds;
    if (skin.inverseBindMatrices >= 0) {
        binds.emplace(file, skin.inverseBindMatrices, 16);
        if (binds->count() < skin.joints.size())
            fail(std::to_string(binds->count()) + " inverse bind matrices", std::to_string(skin.joints.size()));
    }
    file.budget.spend(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        const int joint = skin.joints[i];
        if (joint < 0 || static_cast<std::size_t>(joint) >= nodes.in_skeleton.size())
            fail("joint at node " + std::to_string(joint), "one that exists");
        glm::mat4 bind(1.0f);
        for (int k = 0; k < 16 && binds; ++k) bind[k / 4][k % 4] = binds->finite(i, k);
        attachment.joints.push_back(palette.entry(nodes.in_skeleton[static_cast<std::size_t>(joint)], bind));
    }
    if (attachment.joints.empty()) fail("a skin without joints", "at least one");
    return attachment;
}

// A mirror in the rest pose turns triangles inside out: wind those the other way.
void unmirror(Character& character) {
    std::vector<glm::mat4> world, palette;
    for (const Node& node : character.skeleton.nodes) world.push_back(node.rest_matrix);
    resolve_hierarchy(character.skeleton, world, palette);
    std::vector<float> determinants;
    for (const glm::mat4& matrix : palette) determinants.push_back(glm::determinant(glm::mat3(matrix)));
    Mesh& mesh = character.mesh;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        float handedness = 0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh.indices[i + corner];
            mesh.visit_influences(
                vertex, [&](std::uint16_t joint, float weight) { handedness += weight * determinants[joint]; });
        }
        if (handedness < 0.0f) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
}

bool has_influences(const tinygltf::Primitive& primitive) {
    return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
}

}  // namespace

void build_mesh(GltfFile& file, const NodeOrder& nodes, Character& character) {
    TextureSet textures(file, character.warnings);
    PaletteBuilder palette(character.skeleton);
    std::map<int, Attachment> skins;
    for (const std::int32_t index : nodes.order) {
        const tinygltf::Node& node = file.model.nodes[static_cast<std::size_t>(index)];
        if (node.mesh < 0 || !nodes.in_scene[static_cast<std::size_t>(index)]) continue;
        if (static_cast<std::size_t>(node.mesh) >= file.model.meshes.size())
            fail("mesh " + std::to_string(node.mesh), "one of " + std::to_string(file.model.meshes.size()));
        const tinygltf::Mesh& mesh = file.model.meshes[static_cast<std::size_t>(node.mesh)];
        if (node.skin >= 0 && static_cast<std::size_t>(node.skin) >= file.model.skins.size())
            fail("skin " + std::to_string(node.skin), "one of " + std::to_string(file.model.skins.size()));
        const std::int32_t own = nodes.in_skeleton[static_cast<std::size_t>(index)];
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            file.budget.spend(1);
            const bool skinned = node.skin >= 0 && has_influences(primitive);
            if (skinned && !skins.contains(node.skin)) {
                const tinygltf::Skin& skin = file.model.skins[static_cast<std::size_t>(node.skin)];
                skins[node.skin] = attach_to_skin(file, skin, nodes, palette);
            }
            PrimitiveWriter writer(file, primitive, textures, character);
            const Look look = look_of(file, primitive.material, textures, character.warnings);
            writer.write(look, skinned ? skins[node.skin] : Attachment{{palette.entry(own, glm::mat4(1.0f))}, false});
            writer.write_morphs(own, node.weights.empty() ? mesh.weights : node.weights);
        }
    }
    character.mesh.textures = textures.take();
    unmirror(character);
}

}  // namespace model
