#include "model/io/gltf_document.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "model/input_file.h"
#include "model/io/data_uri.h"
#include "model/io/file_finder.h"

namespace model {
namespace {

using nlohmann::json;

constexpr std::uint64_t most_buffer_bytes = std::uint64_t{1} << 31;

std::string string_at(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// -1 where there is no whole number.
int index_at(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number_integer() ? found->get<int>() : -1;
}

json taken(json& document, const char* key) {
    const auto found = document.find(key);
    if (found == document.end()) return json::array();
    json list = std::move(*found);
    document.erase(found);
    if (!list.is_array()) fail(std::string(key) + " that are no list", "glTF 2.0");
    for (const json& element : list)
        if (!element.is_object()) fail("one of the " + std::string(key) + " that is no object", "glTF 2.0");
    return list;
}

// The list at `key`, where that is one of objects alone; else an empty one.
json& objects_at(json& object, const char* key) {
    static json none = json::array();
    const auto found = object.find(key);
    const bool good = found != object.end() && found->is_array() &&
                      std::ranges::all_of(*found, [](const json& element) { return element.is_object(); });
    return good ? *found : none;
}

// As those of KHR_animation_pointer, which change a material, say.
bool moves_no_node(const json& channel) {
    if (!channel.is_object()) return false;
    const auto target = channel.find("target");
    return target != channel.end() && target->is_object() && string_at(*target, "path") == "pointer";
}

void check_version(const json& document) {
    if (!document.is_object()) fail("JSON that is no object", "glTF 2.0");
    const auto asset = document.find("asset");
    const bool described = asset != document.end() && asset->is_object();
    const std::string version = described ? string_at(*asset, "version") : std::string();
    // Version 1 could leave it out, and has lists by name.
    const auto accessors = document.find("accessors");
    if (version.starts_with("1.") || (version.empty() && accessors != document.end() && accessors->is_object()))
        fail("glTF 1.0", "glTF 2.0");
    if (version.empty()) fail("no version of the asset", "glTF 2.0");
    if (!version.starts_with("2.")) fail("glTF " + in_quotes(version), "glTF 2.0");
}

std::vector<unsigned char> bytes_at(const std::string& uri, FileFinder& finder) {
    if (is_data_uri(uri)) return data_of_uri(uri);
    std::filesystem::path path = finder.find(uri);
    if (path.empty()) path = finder.find(percent_decoded(uri));
    if (path.empty()) fail("no file " + in_quotes(uri) + " beside it", "the buffer that it names");
    return read_file(path, "a buffer", 2 * most_buffer_bytes);
}

}  // namespace

GltfDocument::GltfDocument(std::string_view text, Warnings& warnings) : document_(json::parse(text)) {
    check_version(document_);
    buffers_ = taken(document_, "buffers");
    images_ = taken(document_, "images");
    keep_plain_animations(warnings);
    hide_packed_indices();
}

// tinygltf copies a clip's extensions once for every sampler, and drops channels without a node in silence.
void GltfDocument::keep_plain_animations(Warnings& warnings) {
    const auto animations = document_.find("animations");
    if (animations == document_.end() || !animations->is_array()) return;
    for (json& animation : *animations) {
        if (!animation.is_object()) continue;
        const std::string name = string_at(animation, "name");
        if (animation.erase("extensions") > 0) warnings.add("extension of a clip, left out", name);
        const auto channels = animation.find("channels");
        if (channels == animation.end() || !channels->is_array()) continue;
        for (const json& channel : *channels)
            if (moves_no_node(channel)) warnings.add("channel of a clip that moves no bone or morph, left out", name);
    }
}

// tinygltf refuses indices without a buffer view, which those that Draco holds have no need of.
void GltfDocument::hide_packed_indices() {
    for (json& mesh : objects_at(document_, "meshes")) {
        for (json& primitive : objects_at(mesh, "primitives")) {
            const auto extensions = primitive.find("extensions"), indices = primitive.find("indices");
            if (extensions == primitive.end() || !extensions->is_object() || indices == primitive.end()) continue;
            const auto packed = extensions->find("KHR_draco_mesh_compression");
            if (packed == extensions->end() || !packed->is_object()) continue;
            (*packed)["indices"] = std::move(*indices);
            primitive.erase(indices);
        }
    }
}

std::string GltfDocument::take_rest() {
    std::string text = document_.dump();
    document_ = nullptr;
    return text;
}

std::vector<tinygltf::Buffer> GltfDocument::buffers(const std::filesystem::path& folder,
                                                    std::vector<unsigned char> chunk) {
    FileFinder finder(folder);
    std::vector<tinygltf::Buffer> out(buffers_.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        json& buffer = buffers_[i];
        const std::string name = "buffer " + std::to_string(i);
        const auto length = buffer.find("byteLength");
        if (length == buffer.end() || !length->is_number_unsigned()) fail(name + " without a byteLength", "one");
        const bool has_uri = buffer.contains("uri");
        if (!has_uri && i > 0) continue;
        std::vector<unsigned char>& data = out[i].data;
        data = has_uri ? bytes_at(string_at(buffer, "uri"), finder) : std::move(chunk);
        buffer.erase("uri");
        const std::uint64_t bytes = length->get<std::uint64_t>();
        if (data.size() < bytes) fail(name + " of " + std::to_string(data.size()) + " bytes", std::to_string(bytes));
        data.resize(bytes);
        if (has_uri) data.shrink_to_fit();
    }
    return out;
}

std::vector<tinygltf::Image> GltfDocument::images() {
    std::vector<tinygltf::Image> out(images_.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].uri = string_at(images_[i], "uri");
        out[i].name = string_at(images_[i], "name");
        out[i].bufferView = index_at(images_[i], "bufferView");
        images_[i] = nullptr;
    }
    return out;
}

}  // namespace model
