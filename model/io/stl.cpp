// STL meshes, text and binary. Every facet is flat, as the format has no vertices that facets share.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/input_file.h"
#include "model/io/mesh_readers.h"
#include "model/io/polygon_mesh.h"
#include "model/io/words.h"

namespace model {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's byte order is the machine's");

constexpr std::size_t header_bytes = 80, facet_bytes = 50;

std::string lower_case(std::string_view word) {
    std::string lower(word);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

// Binary headers may begin with "solid" too, but a count of facets below 2^24 has a zero.
bool is_text(InputFile& file) {
    const std::string_view start = file.peek(header_bytes + 4);
    return lower_case(Words(start).next()) == "solid" && start.find('\0') == std::string_view::npos;
}

void add_facet(PolygonMesh& mesh, std::span<const glm::dvec3> corners, std::optional<glm::u8vec4> color) {
    std::vector<std::uint32_t> vertices;
    for (const glm::dvec3& corner : corners) {
        if (mesh.positions.size() >= most_corners) fail("more than 2^31 vertices", "fewer");
        vertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(corner);
        if (color) mesh.colors.resize(mesh.positions.size() - 1, glm::u8vec4(255));
        if (color || !mesh.colors.empty()) mesh.colors.push_back(color.value_or(glm::u8vec4(255)));
    }
    mesh.add_face({vertices, std::nullopt, {}, no_texture});
}

void read_text(InputFile& file, PolygonMesh& mesh) {
    std::vector<glm::dvec3> corners;
    std::string_view line;
    try {
        while (file.line(line)) {
            Words words(line);
            const std::string keyword = lower_case(words.next());
            if (keyword == "vertex") {
                glm::dvec3 corner;
                for (int i = 0; i < 3; ++i) corner[i] = to_double(words.next());
                check_face_corners(corners.size() + 1);
                corners.push_back(corner);
            } else if (keyword == "endloop" || keyword == "endfacet") {
                add_facet(mesh, corners, std::nullopt);
                corners.clear();
            }
        }
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("line " + std::to_string(file.line_number()) + ": " + error.what());
    }
    if (!corners.empty()) fail("the end of the file within a facet", "endloop");
}

// What the two spare bytes of a facet mean: five bits a channel. Magics says so in its header, and counts from red;
// others count from blue, and set the uppermost bit of those that have a colour.
class FacetColors {
public:
    explicit FacetColors(std::string_view header) {
        constexpr std::string_view key = "COLOR=";
        const std::size_t at = header.find(key);
        if (at == std::string_view::npos || at + key.size() + 4 > header.size()) return;
        std::array<unsigned char, 4> rgba{};
        std::memcpy(rgba.data(), header.data() + at + key.size(), rgba.size());
        whole_ = glm::u8vec4(rgba[0], rgba[1], rgba[2], 255);
    }

    std::optional<glm::u8vec4> of(std::uint16_t spare) const {
        const bool flagged = (spare & 0x8000) != 0;
        if (flagged == whole_.has_value()) return whole_;
        const auto channel = [&](int bits) { return static_cast<std::uint8_t>(((spare >> bits) & 31) * 255 / 31); };
        const glm::u8vec4 color(channel(0), channel(5), channel(10), 255);
        return whole_ ? color : glm::u8vec4(color.b, color.g, color.r, 255);
    }

private:
    std::optional<glm::u8vec4> whole_;
};

void read_binary(InputFile& file, PolygonMesh& mesh) {
    if (file.peek(header_bytes + 4).size() < header_bytes + 4)
        fail("no STL file", "text from 'solid' on, or a header of 84 bytes");
    const FacetColors colors({reinterpret_cast<const char*>(file.take(header_bytes)), header_bytes});
    std::uint32_t count = 0;
    std::memcpy(&count, file.take(sizeof count), sizeof count);
    if (count > file.left() / facet_bytes)
        fail(std::to_string(count) + " facets in " + std::to_string(file.left()) + " bytes", "as many as it holds");
    for (std::uint32_t i = 0; i < count; ++i) {
        const unsigned char* facet = file.take(facet_bytes);
        std::array<float, 12> numbers;  // the normal comes first
        std::uint16_t spare = 0;
        std::memcpy(numbers.data(), facet, sizeof numbers);
        std::memcpy(&spare, facet + sizeof numbers, sizeof spare);
        std::array<glm::dvec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = {numbers[3 + 3 * k], numbers[4 + 3 * k], numbers[5 + 3 * k]};
        add_facet(mesh, corners, colors.of(spare));
    }
}

}  // namespace

Mesh read_stl(const std::filesystem::path& path, Warnings& warnings) {
    InputFile file(path, "an STL file", InputFile::Packing::unpacked);
    PolygonMesh mesh(PolygonMesh::Looks::of_vertices);
    if (is_text(file))
        read_text(file, mesh);
    else
        read_binary(file, mesh);
    return mesh.finish(warnings);
}

}  // namespace model
