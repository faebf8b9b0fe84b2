#include "model/io/gltf_file.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "model/io/gltf_guard.h"

namespace model {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_file_bytes = 0xffffffffu;          // lengths in GLB are 32 bits
constexpr std::size_t most_image_bytes = std::size_t{1} << 30;  // encoded, kept until the textures are decoded
constexpr const char* readable = "a readable glTF or GLB file";

// tinygltf also looks in the working directory (as ./name); only the model's own folder counts, whose path is absolute.
// Pipes and devices would block.
bool file_exists(const std::string& path, void*) {
    std::error_code error;
    return fs::path(path).is_absolute() && fs::is_regular_file(path, error);
}

std::string keep_path(const std::string& path, void*) {
    return path;
}  // tinygltf's own runs the shell's expansion

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
    try {
        *out = read_file(path, readable, most_file_bytes);
        return true;
    } catch (const std::exception& exception) {
        *error = exception.what();
        return false;
    }
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// A template, as tinygltf asks for a file's size since 2.9 only; from then on it takes all of these or none.
template <typename Callbacks>
Callbacks file_callbacks() {
    Callbacks callbacks{};
    callbacks.FileExists = file_exists;
    callbacks.ExpandFilePath = keep_path;
    callbacks.ReadWholeFile = read_whole_file;
    callbacks.WriteWholeFile = write_nothing;
    if constexpr (requires { callbacks.GetFileSizeInBytes; })
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string* error, const std::string& path, void*) {
            std::error_code code;
            *size = fs::file_size(path, code);
            *error = code ? code.message() : "";
            return !code;
        };
    return callbacks;
}

// Keeps an image encoded: only base colours are decoded, later. What lies in a buffer view is not touched, as tinygltf
// has not checked the view yet.
bool keep_encoded(tinygltf::Image* image, int, std::string* error, std::string*, int, int, const unsigned char* bytes,
                  int size, void* kept) {
    if (image->bufferView >= 0) return true;
    std::size_t& total = *static_cast<std::size_t*>(kept);
    total += static_cast<std::size_t>(std::max(size, 0));
    if (total > most_image_bytes) {
        *error = "found more than 1 GiB of images; expected less";
        return false;
    }
    image->image.assign(bytes, bytes + size);
    return true;
}

bool is_glb(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
}

// The JSON chunk of a GLB, whose header tinygltf will check again.
std::string_view json_of(const std::vector<unsigned char>& bytes) {
    const char* text = reinterpret_cast<const char*>(bytes.data());
    if (!is_glb(bytes)) return {text, bytes.size()};
    if (bytes.size() < 20) fail(std::to_string(bytes.size()) + " bytes", "a GLB of at least 20");
    const std::size_t length = bytes[12] | bytes[13] << 8 | bytes[14] << 16 | static_cast<std::size_t>(bytes[15]) << 24;
    if (length > bytes.size() - 20)
        fail("a JSON chunk of " + std::to_string(length) + " bytes in a file of " + std::to_string(bytes.size()),
             "a GLB that is whole");
    return {text + 20, length};
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

void parse(const std::vector<unsigned char>& bytes, const fs::path& path, tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    std::size_t kept = 0;
    loader.SetImageLoader(keep_encoded, &kept);
    loader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>());
    std::string error, warning;
    const std::string folder = fs::absolute(path).parent_path().string();
    const unsigned int size = static_cast<unsigned int>(bytes.size());
    bool good = false;
    try {
        good = is_glb(bytes) ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
                             : loader.LoadASCIIFromString(&model, &error, &warning,
                                                          reinterpret_cast<const char*>(bytes.data()), size, folder);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!good) fail("a damaged file (" + first_line(error) + ")", "glTF 2.0");
}

void check_extensions(const tinygltf::Model& model) {
    static constexpr std::array<std::string_view, 3> known{"KHR_texture_transform", "KHR_materials_unlit",
                                                           "KHR_mesh_quantization"};
    for (const std::string& name : model.extensionsRequired) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            fail("the required extension " + name,
                 "none but KHR_texture_transform, KHR_materials_unlit and KHR_mesh_quantization");
    }
}

}  // namespace

GltfFile open_gltf(const fs::path& path) {
    GltfFile file;
    {
        const std::vector<unsigned char> bytes = read_file(path, readable, most_file_bytes);
        check_gltf_json(json_of(bytes));
        parse(bytes, path, file.model);
    }
    check_extensions(file.model);
    std::size_t buffer_bytes = 0;
    for (const tinygltf::Buffer& buffer : file.model.buffers) buffer_bytes += buffer.data.size();
    file.budget = Budget(buffer_bytes);
    return file;
}

std::span<const unsigned char> GltfFile::image_bytes(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model.images.size())
        fail("a texture of image " + std::to_string(index), std::to_string(model.images.size()) + " images");
    const tinygltf::Image& image = model.images[static_cast<std::size_t>(index)];
    if (image.bufferView < 0) {
        if (image.image.empty()) fail("no file " + image.uri + " beside it", "the texture that it names");
        return image.image;
    }
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(image.bufferView)];
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail("image " + std::to_string(index) + " beyond the end of its buffer", "it inside");
    return {data.data() + view.byteOffset, view.byteLength};
}

}  // namespace model
