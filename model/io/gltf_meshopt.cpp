#include <meshoptimizer.h>

#include <array>
#include <utility>

#include "model/io/gltf_packed.h"

namespace model {
namespace {

// Its codecs spend at least two bits on every sixteen bytes of attributes, and a byte on every triangle or index.
constexpr std::uint64_t most_unpacked = 64;

struct PackedView {
    std::string user;  // for messages
    std::span<const unsigned char> bytes;
    std::uint32_t count = 0, stride = 0;  // elements, and the bytes of each
    std::string mode, filter;
};

const tinygltf::Value* extension_of(const tinygltf::BufferView& view) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (const auto found = view.extensions.find(name); found != view.extensions.end()) return &found->second;
    return nullptr;
}

std::string word_at(const tinygltf::Value& object, const char* name, const std::string& fallback) {
    return object.Has(name) && object.Get(name).IsString() ? object.Get(name).Get<std::string>() : fallback;
}

// The decoders take these for granted.
void check_layout(const PackedView& view) {
    const std::uint32_t stride = view.stride;
    const auto wrong_stride = [&] { fail("a stride of " + std::to_string(stride) + " in " + view.user, "another"); };
    if (view.mode == "ATTRIBUTES") {
        if (stride == 0 || stride > 256 || stride % 4 != 0) wrong_stride();
    } else if (view.mode == "TRIANGLES" || view.mode == "INDICES") {
        if (stride != 2 && stride != 4) wrong_stride();
        if (view.filter != "NONE") fail("filtered indices in " + view.user, "filters of attributes");
        if (view.mode == "TRIANGLES" && view.count % 3 != 0)
            fail(std::to_string(view.count) + " corners of triangles in " + view.user, "three for each");
    } else {
        fail("mode " + in_quotes(view.mode) + " of " + view.user, "ATTRIBUTES, TRIANGLES or INDICES");
    }
    if (view.filter == "OCTAHEDRAL") {
        if (stride != 4 && stride != 8) wrong_stride();
    } else if (view.filter == "QUATERNION") {
        if (stride != 8) wrong_stride();
    } else if (view.filter != "NONE" && view.filter != "EXPONENTIAL") {
        fail("filter " + in_quotes(view.filter) + " of " + view.user, "OCTAHEDRAL, QUATERNION or EXPONENTIAL");
    }
}

PackedView read_packed(const GltfFile& file, const tinygltf::Value& extension, std::string user) {
    PackedView view;
    view.user = std::move(user);
    const std::uint32_t buffer = whole_number(extension, "buffer", view.user);
    const std::uint32_t offset = extension.Has("byteOffset") ? whole_number(extension, "byteOffset", view.user) : 0;
    const std::uint32_t length = whole_number(extension, "byteLength", view.user);
    view.bytes = bytes_of_buffer(file, static_cast<int>(buffer), offset, length, view.user);
    view.count = whole_number(extension, "count", view.user);
    view.stride = whole_number(extension, "byteStride", view.user);
    view.mode = word_at(extension, "mode", "");
    if (view.mode.empty()) fail(view.user + " without mode", "ATTRIBUTES, TRIANGLES or INDICES");
    view.filter = word_at(extension, "filter", "NONE");
    check_layout(view);
    return view;
}

int decode(const PackedView& view, std::vector<unsigned char>& out) {
    const unsigned char* bytes = view.bytes.data();
    const std::size_t size = view.bytes.size();
    if (view.mode == "ATTRIBUTES") return meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, bytes, size);
    if (view.mode == "TRIANGLES") return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, bytes, size);
    return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, bytes, size);
}

void apply_filter(const PackedView& view, std::vector<unsigned char>& out) {
    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
}

std::vector<unsigned char> unpack(const PackedView& view, UnpackLimit& limit) {
    const std::uint64_t size = std::uint64_t{view.count} * view.stride;
    if (size > most_unpacked * view.bytes.size())
        fail(std::to_string(size) + " bytes of " + std::to_string(view.bytes.size()) + " in " + view.user,
             "what they can hold");
    limit.spend(view.count, view.stride);
    std::vector<unsigned char> out(size);
    if (out.empty()) return out;
    constexpr int unknown_version = -1;
    const int result = decode(view, out);
    if (result == unknown_version) fail(view.user + " in an unknown form", "version 0 of its codec");
    if (result != 0) fail(view.user + " that is damaged", "all of its data");
    apply_filter(view, out);
    return out;
}

bool has_data(const GltfFile& file, const tinygltf::BufferView& view) {
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= file.model.buffers.size()) return false;
    const std::size_t size = file.model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    return view.byteOffset < size && view.byteLength <= size - view.byteOffset;
}

}  // namespace

void unpack_meshopt(GltfFile& file, UnpackLimit& limit, Warnings& warnings) {
    const std::size_t count = file.model.bufferViews.size();
    for (std::size_t i = 0; i < count; ++i) {
        tinygltf::BufferView& view = file.model.bufferViews[i];
        const tinygltf::Value* extension = extension_of(view);
        if (extension == nullptr) continue;
        const std::string name = "buffer view " + std::to_string(i);
        try {
            std::vector<unsigned char> bytes = unpack(read_packed(file, *extension, "compressed " + name), limit);
            view.buffer = static_cast<int>(file.model.buffers.size());
            view.byteOffset = 0;
            view.byteLength = bytes.size();
            file.model.buffers.emplace_back().data = std::move(bytes);
        } catch (const BudgetError&) {
            throw;
        } catch (const std::runtime_error&) {
            if (!has_data(file, view)) throw;
            warnings.add("compressed data is damaged, its plain copy is read", name);
        }
    }
}

}  // namespace model
