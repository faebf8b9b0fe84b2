#include <algorithm>
#include <cmath>
#include <cstring>

#include "model/io/gltf_file.h"

namespace model {
namespace {

std::string name_of(int accessor) {
    return "accessor " + std::to_string(accessor);
}

const tinygltf::Accessor& accessor_at(const GltfFile& file, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= file.model.accessors.size())
        fail(name_of(index), "one of the file's " + std::to_string(file.model.accessors.size()));
    return file.model.accessors[static_cast<std::size_t>(index)];
}

std::size_t size_of_component(int type, int accessor) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            fail("component type " + std::to_string(type) + " in " + name_of(accessor), "one of glTF 2.0's");
    }
}

struct Run {
    const unsigned char* data;
    std::size_t stride;  // [bytes]
};

// `count` elements of `size` bytes at `offset` in a buffer view, all inside it; `accessor` is for the message.
Run run_of(const GltfFile& file, int view_index, std::size_t offset, std::size_t count, std::size_t size,
           int accessor) {
    const std::span<const unsigned char> bytes = bytes_of_view(file, view_index, name_of(accessor));
    const std::size_t byte_stride = file.model.bufferViews[static_cast<std::size_t>(view_index)].byteStride;
    const std::size_t stride = byte_stride == 0 ? size : byte_stride;
    const auto overrun = [&] { fail(name_of(accessor) + " beyond the end of its buffer", "it inside"); };
    if (offset > bytes.size()) overrun();
    const std::size_t room = bytes.size() - offset;
    if (count > 0 && (room < size || (room - size) / stride < count - 1)) overrun();
    return {bytes.data() + offset, stride};
}

std::uint32_t read_unsigned(const unsigned char* bytes, int type) {
    std::uint32_t value = bytes[0];
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) value |= static_cast<std::uint32_t>(bytes[1]) << 8;
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        value |= static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
    return value;
}

// Puts a sparse accessor's own values over `elements`, which are tightly packed.
void merge_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, int index, std::size_t element_size,
                  std::vector<unsigned char>& elements) {
    const auto& sparse = accessor.sparse;
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail("sparse indices of component type " + std::to_string(type) + " in " + name_of(index), "unsigned ones");
    // What is negative, in the releases of tinygltf that have it signed, is beyond every buffer's end as a size.
    const std::size_t count = static_cast<std::size_t>(sparse.count), size = size_of_component(type, index);
    const Run indices = run_of(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                               count, size, index);
    const Run values = run_of(file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                              element_size, index);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t to = read_unsigned(indices.data + i * indices.stride, type);
        if (to >= accessor.count)
            fail("sparse index " + std::to_string(to) + " in " + name_of(index),
                 "below " + std::to_string(accessor.count));
        std::memcpy(elements.data() + to * element_size, values.data + i * values.stride, element_size);
    }
}

}  // namespace

int accessor_width(const GltfFile& file, int accessor) {
    return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_at(file, accessor).type));
}

Accessor::Accessor(GltfFile& file, int index, int width) {
    const tinygltf::Accessor& accessor = accessor_at(file, index);
    if (accessor_width(file, index) != width)
        fail(std::to_string(accessor_width(file, index)) + " components in " + name_of(index), std::to_string(width));
    index_of_accessor_ = index;
    component_type_ = accessor.componentType;
    component_size_ = size_of_component(component_type_, index);
    normalized_ = accessor.normalized;
    count_ = accessor.count;
    const std::size_t element_size = component_size_ * static_cast<std::size_t>(width);
    stride_ = element_size;
    if (accessor.bufferView >= 0) {
        const Run run = run_of(file, accessor.bufferView, accessor.byteOffset, count_, element_size, index);
        data_ = run.data;
        stride_ = run.stride;
        if (!accessor.sparse.isSparse) return;
    }
    file.budget.spend(count_);
    merged_.resize(count_ * element_size);
    for (std::size_t i = 0; data_ != nullptr && i < count_; ++i)
        std::memcpy(merged_.data() + i * element_size, data_ + i * stride_, element_size);
    stride_ = element_size;
    if (accessor.sparse.isSparse) merge_sparse(file, accessor, index, element_size, merged_);
    data_ = merged_.data();
}

const unsigned char* Accessor::at(std::size_t element, int component) const {
    return data_ + element * stride_ + static_cast<std::size_t>(component) * component_size_;
}

float Accessor::number(std::size_t element, int component) const {
    const unsigned char* bytes = at(element, component);
    if (component_type_ == TINYGLTF_COMPONENT_TYPE_FLOAT) {
        float value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    if (component_type_ == TINYGLTF_COMPONENT_TYPE_BYTE || component_type_ == TINYGLTF_COMPONENT_TYPE_SHORT) {
        const bool byte = component_type_ == TINYGLTF_COMPONENT_TYPE_BYTE;
        const int value =
            byte ? static_cast<std::int8_t>(bytes[0]) : static_cast<std::int16_t>(bytes[0] | bytes[1] << 8);
        const float largest = byte ? 127.0f : 32767.0f;
        return normalized_ ? std::max(static_cast<float>(value) / largest, -1.0f) : static_cast<float>(value);
    }
    const float value = static_cast<float>(read_unsigned(bytes, component_type_));
    if (!normalized_) return value;
    return value / (component_size_ == 1 ? 255.0f : component_size_ == 2 ? 65535.0f : 4294967295.0f);
}

float Accessor::finite(std::size_t element, int component) const {
    const float value = number(element, component);
    if (!std::isfinite(value)) fail(std::to_string(value) + " in " + name_of(index_of_accessor_), "finite numbers");
    return value;
}

std::uint32_t Accessor::index(std::size_t element, int component) const {
    if (component_type_ != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        component_type_ != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        component_type_ != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail("component type " + std::to_string(component_type_) + " in " + name_of(index_of_accessor_),
             "unsigned integers");
    return read_unsigned(at(element, component), component_type_);
}

}  // namespace model
