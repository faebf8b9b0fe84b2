// The bytes of a .pts file; docs/pts-format.md has the table. Internal to points_*.cpp.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace pointsample {

static_assert(std::endian::native == std::endian::little, "the file's byte order is the machine's");

// In the file's order.
enum Section {
    key_section,
    drawn_section,
    triangle_section,
    uv_section,
    joint_section,
    weight_section,
    spacing_section,
    alpha_section,
    coverage_section
};
inline constexpr std::size_t section_count = 9;
// After the last, of models that have any: own lights, 4 bytes a point.
inline constexpr std::uint64_t own_light_bytes = 4;

struct PointsHeader {
    std::array<char, 8> magic;
    std::uint32_t version;
    std::uint32_t byte_order;
    std::uint64_t file_bytes;
    std::uint64_t points;
    std::uint64_t coverage;  // entries
    std::uint64_t hidden_removed;
    std::array<float, 3> box_min, box_max;
    float area;
    std::uint32_t key_bytes;
    std::array<std::uint64_t, section_count> offsets;
    std::array<double, 3> origin;
    std::uint64_t own_lights;  // their offset; 0: none
    std::uint64_t reserved;    // 0
};
static_assert(sizeof(PointsHeader) == 192);

inline constexpr std::array<char, 8> points_magic{'\x89', 'P', 'T', 'S', '\r', '\n', '\x1a', '\n'};
inline constexpr std::uint32_t points_version = 1;
inline constexpr std::uint32_t points_byte_order = 0x01020304;
inline constexpr std::uint64_t points_alignment = 64;
inline constexpr std::size_t most_key_bytes = std::size_t{64} << 10;

// Of a section: bytes an element.
inline constexpr std::array<std::uint64_t, section_count> element_bytes{1, 12, 4, 4, 8, 4, 4, 1, 8};

inline constexpr std::uint64_t bytes_per_point = 12 + 4 + 4 + 8 + 4 + 4 + 1;

struct PointsLayout {
    std::array<std::uint64_t, section_count> offsets;
    std::uint64_t own_lights;  // 0: none
    std::uint64_t checksum;    // its offset
    std::uint64_t file_bytes() const { return checksum + 8; }
};

// Must not overflow: check the counts against the file's size before.
constexpr PointsLayout layout_of(std::uint64_t points, std::uint64_t coverage, std::uint64_t key_bytes,
                                 bool has_own_lights) {
    PointsLayout layout{};
    std::uint64_t end = sizeof(PointsHeader);
    const auto aligned = [&] { return (end + points_alignment - 1) / points_alignment * points_alignment; };
    for (std::size_t i = 0; i < section_count; ++i) {
        const std::uint64_t count = i == key_section ? key_bytes : i == coverage_section ? coverage : points;
        layout.offsets[i] = aligned();
        end = layout.offsets[i] + count * element_bytes[i];
    }
    if (has_own_lights) {
        layout.own_lights = aligned();
        end = layout.own_lights + points * own_light_bytes;
    }
    layout.checksum = (end + 7) / 8 * 8;
    return layout;
}

}  // namespace pointsample
