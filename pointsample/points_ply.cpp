// Points as PLY.
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <ostream>
#include <string>

#include "pointsample/points_file.h"

namespace pointsample {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's byte order is the machine's");

constexpr std::size_t block_bytes = std::size_t{1} << 16;

bool has_origin(const PointModel& model) {
    return model.origin != glm::dvec3(0.0);
}

glm::dvec3 world_position(const PointModel& model, std::size_t i) {
    return model.origin + glm::dvec3(model.positions[i]);
}

void append_binary(std::string& out, const PointModel& model, std::size_t i) {
    const auto append = [&](const auto& value, std::size_t size) {
        std::array<char, sizeof value> bytes;
        std::memcpy(bytes.data(), &value, sizeof value);
        out.append(bytes.data(), size);
    };
    if (has_origin(model))
        append(world_position(model, i), sizeof(glm::dvec3));
    else
        append(model.positions[i], sizeof(glm::vec3));
    append(model.normals[i], sizeof(glm::vec3));
    append(model.colors[i], 3);
}

// The shortest digits that read as the same number.
template <typename Number>
void append_number(std::string& out, Number number, char after) {
    std::array<char, 32> text;
    char* const end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    out.append(text.data(), static_cast<std::size_t>(end - text.data())).push_back(after);
}

void append_text(std::string& out, const PointModel& model, std::size_t i) {
    const auto append = [&](const auto& vector) {
        for (int axis = 0; axis < 3; ++axis) append_number(out, vector[axis], ' ');
    };
    if (has_origin(model))
        append(world_position(model, i));
    else
        append(model.positions[i]);
    append(model.normals[i]);
    for (int channel = 0; channel < 3; ++channel)
        append_number(out, unsigned{model.colors[i][channel]}, channel < 2 ? ' ' : '\n');
}

}  // namespace

void write_ply(std::ostream& out, const PointModel& model, PlyFormat format) {
    const bool ascii = format == PlyFormat::ascii;
    out << "ply\nformat " << (ascii ? "ascii" : "binary_little_endian") << " 1.0\nelement vertex " << model.size()
        << '\n';
    const char* places = has_origin(model) ? "double" : "float";
    for (const char* name : {"x", "y", "z"}) out << "property " << places << ' ' << name << '\n';
    for (const char* name : {"nx", "ny", "nz"}) out << "property float " << name << '\n';
    for (const char* name : {"red", "green", "blue"}) out << "property uchar " << name << '\n';
    out << "end_header\n";
    std::string block;
    for (std::size_t i = 0; i < model.size(); ++i) {
        (ascii ? append_text : append_binary)(block, model, i);
        if (block.size() < block_bytes && i + 1 < model.size()) continue;
        out.write(block.data(), static_cast<std::streamsize>(block.size()));
        block.clear();
    }
}

}  // namespace pointsample
