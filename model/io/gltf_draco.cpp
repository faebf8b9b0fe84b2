#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "model/io/gltf_packed.h"

namespace model {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

struct Bounds {
    std::uint64_t corners = 0, vertices = 0;  // that the primitive's accessors have
    UnpackLimit& limit;
};

// Draco's decoder, which asks for memory by what the data says of its size: that is checked before.
template <typename Decoder>
class BoundedDecoder : public Decoder {
public:
    explicit BoundedDecoder(const Bounds& bounds) : bounds_(bounds) {}

protected:
    bool DecodeConnectivity() override {
        if (this->bitstream_version() != draco::kDracoMeshBitstreamVersion) fail("another version of Draco", "2.2");
        draco::DecoderBuffer ahead = *this->buffer();
        std::uint32_t first = 0, second = 0;
        if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
        constexpr bool faces_first = std::is_same_v<Decoder, draco::MeshSequentialDecoder>;
        check_counts(faces_first ? first : second, faces_first ? second : first);
        return Decoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override {
        const draco::PointCloud& points = *this->point_cloud();
        constexpr std::uint64_t working = 4;  // [bytes] of a component, before it is what it was
        for (int i = 0; i < points.num_attributes(); ++i) {
            const draco::PointAttribute& attribute = *points.attribute(i);
            const auto components = static_cast<std::uint64_t>(attribute.num_components());
            const auto stride = static_cast<std::uint64_t>(attribute.byte_stride());
            bounds_.limit.spend(points.num_points(), stride + working * components);
        }
        return Decoder::DecodeAllAttributes();
    }

private:
    void check_counts(std::uint64_t faces, std::uint64_t vertices) {
        constexpr std::uint64_t face_size = 32, vertex_size = 16;  // [bytes], of the decoder's tables
        const auto check = [](std::uint64_t found, std::uint64_t most, const char* what) {
            if (found > most)
                fail(std::to_string(found) + " " + what + " in Draco's data",
                     std::to_string(most) + " as the accessor says");
        };
        check(3 * faces, bounds_.corners, "indices");
        check(vertices, bounds_.vertices, "vertices");
        bounds_.limit.spend(faces, face_size);
        bounds_.limit.spend(vertices, vertex_size);
    }

    Bounds bounds_;
};

std::unique_ptr<draco::MeshDecoder> decoder_for(draco::DecoderBuffer data, const Bounds& bounds) {
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&data, &header).ok())
        fail("no data of Draco in a Draco primitive", "some");
    if (header.encoder_type != draco::TRIANGULAR_MESH) fail("Draco data that is no mesh", "one");
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
        return std::make_unique<BoundedDecoder<draco::MeshSequentialDecoder>>(bounds);
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        return std::make_unique<BoundedDecoder<draco::MeshEdgebreakerDecoder>>(bounds);
    fail("Draco data of an unknown method", "sequential or edgebreaker");
}

std::unique_ptr<draco::Mesh> decode(std::span<const unsigned char> bytes, const Bounds& bounds) {
    draco::DecoderBuffer data;
    data.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::unique_ptr<draco::MeshDecoder> decoder = decoder_for(data, bounds);
    auto mesh = std::make_unique<draco::Mesh>();
    if (!decoder->Decode(draco::DecoderOptions(), &data, mesh.get()).ok())
        fail("Draco data that is damaged", "all of it");
    return mesh;
}

std::vector<unsigned char> indices_of(const draco::Mesh& mesh) {
    std::vector<unsigned char> bytes(std::size_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = face[k].value();
            std::memcpy(bytes.data() + (3 * std::size_t{i} + k) * sizeof corner, &corner, sizeof corner);
        }
    }
    return bytes;
}

template <typename T>
std::vector<unsigned char> values_of(const draco::PointAttribute& attribute, std::uint32_t points) {
    const std::size_t size = sizeof(T) * static_cast<std::size_t>(attribute.num_components());
    std::vector<unsigned char> bytes(size * points);
    std::vector<T> element(static_cast<std::size_t>(attribute.num_components()));
    for (std::uint32_t i = 0; i < points; ++i) {
        const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(i));
        if (at.value() >= attribute.size() ||
            !attribute.ConvertValue(at, static_cast<std::int8_t>(element.size()), element.data()))
            fail("Draco's values beyond what their accessor can hold", "others");
        std::memcpy(bytes.data() + i * size, element.data(), size);
    }
    return bytes;
}

std::vector<unsigned char> values_of(const draco::PointAttribute& attribute, std::uint32_t points, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return values_of<std::int8_t>(attribute, points);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return values_of<std::uint8_t>(attribute, points);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return values_of<std::int16_t>(attribute, points);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return values_of<std::uint16_t>(attribute, points);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return values_of<std::uint32_t>(attribute, points);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return values_of<float>(attribute, points);
        default:
            fail("component type " + std::to_string(type), "one of glTF 2.0's");
    }
}

const tinygltf::Accessor* accessor_at(const GltfFile& file, int index) {
    const bool exists = index >= 0 && static_cast<std::size_t>(index) < file.model.accessors.size();
    return exists ? &file.model.accessors[static_cast<std::size_t>(index)] : nullptr;
}

int add_accessor(GltfFile& file, tinygltf::Accessor accessor, std::size_t count, std::vector<unsigned char> bytes) {
    accessor.bufferView = add_unpacked(file, std::move(bytes));
    accessor.byteOffset = 0;
    accessor.count = count;
    accessor.sparse.isSparse = false;
    file.model.accessors.push_back(std::move(accessor));
    return static_cast<int>(file.model.accessors.size()) - 1;
}

int add_attribute(GltfFile& file, const draco::Mesh& mesh, std::uint32_t id, int like, const std::string& name,
                  UnpackLimit& limit) {
    const tinygltf::Accessor* accessor = accessor_at(file, like);
    if (accessor == nullptr) fail("no accessor of " + in_quotes(name), "one that describes it");
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr) fail("no " + in_quotes(name) + " in Draco's data", "what the primitive names");
    const int width = accessor_width(file, like);
    if (attribute->num_components() != width)
        fail(std::to_string(attribute->num_components()) + " components of " + in_quotes(name) + " in Draco's data",
             std::to_string(width));
    limit.spend(mesh.num_points(), sizeof(float) * static_cast<std::uint64_t>(width));
    return add_accessor(file, *accessor, mesh.num_points(),
                        values_of(*attribute, mesh.num_points(), accessor->componentType));
}

int add_indices(GltfFile& file, const draco::Mesh& mesh, UnpackLimit& limit) {
    limit.spend(mesh.num_faces(), 3 * sizeof(std::uint32_t));
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    return add_accessor(file, std::move(accessor), std::size_t{mesh.num_faces()} * 3, indices_of(mesh));
}

// The indices' accessor is where GltfDocument put it.
Bounds bounds_of(const GltfFile& file, const tinygltf::Primitive& primitive, const tinygltf::Value& extension,
                 UnpackLimit& limit) {
    const auto position = primitive.attributes.find("POSITION");
    const tinygltf::Accessor* positions =
        position == primitive.attributes.end() ? nullptr : accessor_at(file, position->second);
    const tinygltf::Accessor* indices =
        extension.Has("indices")
            ? accessor_at(file, static_cast<int>(whole_number(extension, "indices", "a Draco primitive")))
            : nullptr;
    constexpr std::uint64_t unknown = std::uint64_t{1} << 32;
    return {indices == nullptr ? unknown : indices->count, positions == nullptr ? unknown : positions->count, limit};
}

tinygltf::Primitive unpacked(GltfFile& file, tinygltf::Primitive primitive, const tinygltf::Value& extension,
                             UnpackLimit& limit) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP)
        fail("Draco's data in primitive mode " + std::to_string(primitive.mode), "triangles");
    const auto view = static_cast<int>(whole_number(extension, "bufferView", "a Draco primitive"));
    const std::unique_ptr<draco::Mesh> mesh =
        decode(bytes_of_view(file, view, "Draco's data"), bounds_of(file, primitive, extension, limit));
    const tinygltf::Value& attributes = extension.Get("attributes");
    for (auto& [name, accessor] : primitive.attributes) {
        if (!attributes.Has(name)) continue;
        const std::uint32_t id = whole_number(attributes, name.c_str(), "Draco's attributes");
        accessor = add_attribute(file, *mesh, id, accessor, name, limit);
    }
    primitive.indices = add_indices(file, *mesh, limit);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    return primitive;
}

// Whether all that a program without Draco would read has data.
bool is_plain_too(const GltfFile& file, const tinygltf::Primitive& primitive, int indices) {
    const auto has_data = [&](int index) {
        const tinygltf::Accessor* accessor = accessor_at(file, index);
        return accessor != nullptr && accessor->bufferView >= 0;
    };
    return (indices < 0 || has_data(indices)) &&
           std::ranges::all_of(primitive.attributes, [&](const auto& attribute) { return has_data(attribute.second); });
}

void unpack(GltfFile& file, tinygltf::Primitive& primitive, const tinygltf::Value& extension, UnpackLimit& limit,
            Warnings& warnings) {
    try {
        primitive = unpacked(file, primitive, extension, limit);
    } catch (const BudgetError&) {
        throw;
    } catch (const std::runtime_error&) {
        // Where GltfDocument put them.
        const bool indexed = extension.Has("indices") && extension.Get("indices").IsInt();
        const int indices = indexed ? extension.Get("indices").GetNumberAsInt() : -1;
        if (!is_plain_too(file, primitive, indices)) throw;
        primitive.indices = indices;
        warnings.add("compressed data is damaged, its plain copy is read", "Draco's");
    }
}

}  // namespace

void unpack_draco(GltfFile& file, UnpackLimit& limit, Warnings& warnings) {
    for (tinygltf::Mesh& mesh : file.model.meshes) {
        for (tinygltf::Primitive& primitive : mesh.primitives) {
            const auto found = primitive.extensions.find(extension_name);
            if (found == primitive.extensions.end()) continue;
            const tinygltf::Value extension = found->second;
            unpack(file, primitive, extension, limit, warnings);
        }
    }
}

}  // namespace model
