#include "model/io/gltf_document.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "model/input_file.h"
#include "model/io/data_uri.h"
#include "model/io/file_finder.h"
#include "model/io/gltf_file.h"

namespace model {
namespace {

using nlohmann::json;

constexpr const char* draco_name = "KHR_draco_mesh_compression";
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

bool is_list_of_objects(const json& value) {
    return value.is_array() && std::ranges::all_of(value, [](const json& element) { return element.is_object(); });
}

// Whether a name may be in it: those with escapes may be any.
bool may_hold(std::string_view text, std::string_view name) {
    return text.find(name) != std::string_view::npos || text.find("\\u") != std::string_view::npos;
}

// As those of KHR_animation_pointer, which change a material, say.
bool moves_no_node(const json& channel) {
    if (!channel.is_object()) return false;
    const auto target = channel.find("target");
    return target != channel.end() && target->is_object() && !target->contains("node") &&
           string_at(*target, "path") == "pointer";
}

bool is_clip(const json& animation) {
    const auto list = [&](const char* name) {
        const auto found = animation.find(name);
        return found != animation.end() && is_list_of_objects(*found) ? *found : json();
    };
    const json samplers = list("samplers"), channels = list("channels");
    return samplers.is_array() && channels.is_array() &&
           std::ranges::all_of(samplers,
                               [](const json& s) { return index_at(s, "input") >= 0 && index_at(s, "output") >= 0; }) &&
           std::ranges::all_of(channels, [](const json& c) {
               return index_at(c, "sampler") >= 0 && c.contains("target") && c["target"].is_object() &&
                      !string_at(c["target"], "path").empty();
           });
}

std::vector<unsigned char> bytes_at(const std::string& uri, FileFinder& finder) {
    if (is_data_uri(uri)) return data_of_uri(uri);
    std::filesystem::path path = finder.find(uri);
    if (path.empty()) path = finder.find(percent_decoded(uri));
    if (path.empty()) fail("no file " + in_quotes(uri) + " beside it", "the buffer that it names");
    return read_file(path, "a buffer", 2 * most_buffer_bytes);
}

}  // namespace

GltfDocument::GltfDocument(std::string_view text, Warnings& warnings)
    : text_(text), members_(members_of_json(text)), buffers_(json::array()), images_(json::array()) {
    check_version();
    for (const JsonMember& member : members_) {
        if (member.name == "buffers") buffers_ = take_list(member);
        if (member.name == "images") images_ = take_list(member);
        if (member.name == "animations") keep_plain_animations(member, warnings);
        if (member.name == "meshes") hide_packed_indices(member);
    }
}

std::string_view GltfDocument::text_of(const JsonMember& member) const {
    return text_.substr(member.begin, member.end - member.begin);
}

void GltfDocument::check_version() const {
    if (members_.empty()) fail("JSON that is no object, or an empty one", "glTF 2.0");
    std::string version;
    bool by_name = false;  // version 1 could leave it out, and has lists by name
    for (const JsonMember& member : members_) {
        if (member.name == "accessors")
            by_name = text_of(member).find_first_not_of(" \t\r\n") == text_of(member).find('{');
        if (member.name != "asset") continue;
        const json asset = json::parse(text_of(member));
        version = asset.is_object() ? string_at(asset, "version") : std::string();
    }
    if (version.starts_with("1.") || (version.empty() && by_name)) fail("glTF 1.0", "glTF 2.0");
    if (version.empty()) fail("no version of the asset", "glTF 2.0");
    if (!version.starts_with("2.")) fail("glTF " + in_quotes(version), "glTF 2.0");
}

void GltfDocument::replace(const JsonMember& member, std::string text) {
    const auto at = std::ranges::lower_bound(changes_, member.begin, {}, &Change::begin);
    if (at != changes_.end() && at->begin == member.begin)
        at->text = std::move(text);
    else
        changes_.insert(at, {member.begin, member.end, std::move(text)});
}

// tinygltf sees an empty list.
json GltfDocument::take_list(const JsonMember& member) {
    json list = json::parse(text_of(member));
    if (!list.is_array()) fail(member.name + " that are no list", "glTF 2.0");
    if (!is_list_of_objects(list)) fail("one of the " + member.name + " that is no object", "glTF 2.0");
    replace(member, "[]");
    return list;
}

// tinygltf copies a clip's extensions once for every sampler, and drops channels without a node in silence.
void GltfDocument::keep_plain_animations(const JsonMember& member, Warnings& warnings) {
    if (!may_hold(text_of(member), "\"extensions\"") && !may_hold(text_of(member), "\"pointer\"")) return;
    json animations = json::parse(text_of(member));
    if (!is_list_of_objects(animations)) return;
    for (json& animation : animations) {
        const std::string name = string_at(animation, "name");
        if (animation.erase("extensions") > 0) warnings.add("extension of a clip, left out", name);
        const auto channels = animation.find("channels");
        if (channels == animation.end() || !channels->is_array()) continue;
        for (const json& channel : *channels)
            if (moves_no_node(channel)) warnings.add(moves_nothing, name);
    }
    replace(member, animations.dump());
}

bool GltfDocument::leave_out_bad_clips(Warnings& warnings) {
    bool any = false;
    for (const JsonMember& member : members_) {
        if (member.name != "animations") continue;
        json animations = json::parse(text_of(member)), good = json::array();
        if (!is_list_of_objects(animations)) return false;
        for (json& animation : animations) {
            animation.erase("extensions");
            if (is_clip(animation))
                good.push_back(std::move(animation));
            else
                warnings.add("clip that lacks a part, left out", string_at(animation, "name"));
        }
        any |= good.size() < animations.size();
        replace(member, good.dump());
    }
    return any;
}

// tinygltf refuses indices without a buffer view, which those that Draco holds have no need of.
void GltfDocument::hide_packed_indices(const JsonMember& member) {
    if (!may_hold(text_of(member), draco_name)) return;
    json meshes = json::parse(text_of(member));
    if (!is_list_of_objects(meshes)) return;
    for (json& mesh : meshes) {
        const auto primitives = mesh.find("primitives");
        if (primitives == mesh.end() || !is_list_of_objects(*primitives)) continue;
        for (json& primitive : *primitives) {
            const auto extensions = primitive.find("extensions"), indices = primitive.find("indices");
            if (extensions == primitive.end() || !extensions->is_object() || indices == primitive.end()) continue;
            const auto packed = extensions->find(draco_name);
            if (packed == extensions->end() || !packed->is_object()) continue;
            (*packed)["indices"] = std::move(*indices);
            primitive.erase(indices);
        }
    }
    replace(member, meshes.dump());
}

std::string GltfDocument::rest() const {
    std::string rest;
    std::size_t at = 0;
    for (const Change& change : changes_) {
        rest += text_.substr(at, change.begin - at);
        rest += change.text;
        at = change.end;
    }
    rest += text_.substr(at);
    return rest;
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
