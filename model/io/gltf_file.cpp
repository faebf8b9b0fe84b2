#include "model/io/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "model/io/gltf_document.h"
#include "model/io/gltf_guard.h"
#include "model/io/gltf_packed.h"

namespace model {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_file_bytes = 0xffffffffu;  // lengths in GLB are 32 bits
constexpr const char* readable = "a readable glTF or GLB file";
constexpr std::uint32_t json_type = 0x4e4f534a, binary_type = 0x004e4942;

bool is_glb(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
}

std::uint32_t word_at(const std::vector<unsigned char>& bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

struct Stretch {
    std::size_t begin = 0, size = 0;
};

// Where a file's JSON and its binary chunk are.
struct Chunks {
    Stretch json, binary;
};

void check_glb_header(const std::vector<unsigned char>& bytes) {
    if (bytes.size() < 20) fail(std::to_string(bytes.size()) + " bytes", "a GLB of at least 20");
    if (word_at(bytes, 4) != 2) fail("glTF " + std::to_string(word_at(bytes, 4)) + ".0", "glTF 2.0");
    if (word_at(bytes, 8) > bytes.size())
        fail(std::to_string(bytes.size()) + " bytes of a GLB of " + std::to_string(word_at(bytes, 8)), "all of them");
    if (word_at(bytes, 16) != json_type) fail("a GLB whose first chunk is not JSON", "glTF 2.0");
}

// Chunks of other types are for other programs.
Chunks chunks_of(const std::vector<unsigned char>& bytes) {
    if (!is_glb(bytes)) return {{0, bytes.size()}, {}};
    check_glb_header(bytes);
    Chunks chunks;
    const std::size_t end = word_at(bytes, 8);
    for (std::size_t at = 12; at + 8 <= end;) {
        const Stretch chunk{at + 8, word_at(bytes, at)};
        const std::uint32_t type = word_at(bytes, at + 4);
        if (chunk.size > end - chunk.begin)
            fail("a chunk of " + std::to_string(chunk.size) + " bytes, longer than its file", "a GLB that is whole");
        if (type == json_type && chunks.json.size == 0) chunks.json = chunk;
        if (type == binary_type && chunks.binary.size == 0) chunks.binary = chunk;
        at = chunk.begin + chunk.size;
    }
    return chunks;
}

// Up to the first zero: writers pad with them, and nlohmann's parser, which checks it, reads no further.
std::string_view text_of(const std::vector<unsigned char>& bytes, const Stretch& json) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + json.begin, json.size);
    return text.substr(0, text.find('\0'));
}

std::string first_line(const std::string& text) {
    constexpr std::size_t longest = 80;
    return text.substr(0, std::min(text.find('\n'), longest));
}

// As JSON alone: tinygltf opens no file and decodes nothing.
void parse(const std::string& text, tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    bool good = false;
    try {
        good = loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned int>(text.size()),
                                          "");
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!good) fail("a damaged file (" + first_line(error) + ")", "glTF 2.0");
}

void parse_document(GltfDocument& document, tinygltf::Model& model, Warnings& warnings) {
    try {
        parse(document.rest(), model);
    } catch (const std::runtime_error&) {
        if (!document.leave_out_bad_clips(warnings)) throw;
        model = {};
        parse(document.rest(), model);
    }
}

// Those that only add looks, lights or labels take nothing from the shape. The rest of what is listed is read.
bool can_be_read(std::string_view extension) {
    static constexpr std::array<std::string_view, 16> known{"KHR_texture_transform",
                                                            "KHR_mesh_quantization",
                                                            "EXT_meshopt_compression",
                                                            "KHR_meshopt_compression",
                                                            "KHR_draco_mesh_compression",
                                                            "EXT_texture_webp",
                                                            "KHR_lights_punctual",
                                                            "KHR_animation_pointer",
                                                            "KHR_xmp",
                                                            "KHR_xmp_json_ld",
                                                            "EXT_lights_image_based",
                                                            "EXT_lights_ies",
                                                            "KHR_node_visibility",
                                                            "KHR_node_selectability",
                                                            "KHR_node_hoverability",
                                                            "MSFT_packing_occlusionRoughnessMetallic"};
    return extension.starts_with("KHR_materials_") || extension.starts_with("EXT_materials_") ||
           std::ranges::find(known, extension) != known.end();
}

void check_extensions(const tinygltf::Model& model) {
    for (const std::string& name : model.extensionsRequired)
        if (!can_be_read(name)) fail("the required extension " + in_quotes(name), "ones that Grandstand reads");
}

void keep_only(const Stretch& stretch, std::vector<unsigned char>& bytes) {
    bytes.resize(stretch.begin + stretch.size);
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(stretch.begin));
}

std::size_t bytes_of_buffers(const GltfFile& file) {
    std::size_t bytes = 0;
    for (const tinygltf::Buffer& buffer : file.model.buffers) bytes += buffer.data.size();
    return bytes;
}

}  // namespace

GltfFile open_gltf(const fs::path& path, Warnings& warnings) {
    GltfFile file;
    file.folder = path.parent_path();
    {
        std::vector<unsigned char> bytes = read_file(path, readable, most_file_bytes);
        const Chunks chunks = chunks_of(bytes);
        const std::string_view text = text_of(bytes, chunks.json);
        check_gltf_json(text);
        GltfDocument document(text, warnings);
        parse_document(document, file.model, warnings);
        check_extensions(file.model);
        keep_only(chunks.binary, bytes);
        file.model.buffers = document.buffers(file.folder, std::move(bytes));
        file.model.images = document.images();
    }
    UnpackLimit limit(bytes_of_buffers(file));
    unpack_meshopt(file, limit, warnings);
    unpack_draco(file, limit, warnings);
    file.budget = Budget(bytes_of_buffers(file));
    return file;
}

std::span<const unsigned char> bytes_of_buffer(const GltfFile& file, int index, std::size_t offset, std::size_t length,
                                               const std::string& user) {
    if (index < 0 || static_cast<std::size_t>(index) >= file.model.buffers.size())
        fail("buffer " + std::to_string(index) + " of " + user, "one that exists");
    const std::vector<unsigned char>& data = file.model.buffers[static_cast<std::size_t>(index)].data;
    if (offset > data.size() || length > data.size() - offset)
        fail(user + " beyond the end of its buffer", "it inside");
    return {data.data() + offset, length};
}

std::span<const unsigned char> bytes_of_view(const GltfFile& file, int index, const std::string& user) {
    if (index < 0 || static_cast<std::size_t>(index) >= file.model.bufferViews.size())
        fail("buffer view " + std::to_string(index) + " of " + user, "one that exists");
    const tinygltf::BufferView& view = file.model.bufferViews[static_cast<std::size_t>(index)];
    return bytes_of_buffer(file, view.buffer, view.byteOffset, view.byteLength, user);
}

}  // namespace model
