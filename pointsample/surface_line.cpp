#include "pointsample/surface_line.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pointsample {
namespace {

constexpr int bits = 21;  // an axis

// Three coordinates to their place on Hilbert's curve (Skilling 2004, "Programming the Hilbert curve").
std::uint64_t hilbert(std::array<std::uint32_t, 3> x) {
    for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
        const std::uint32_t p = q - 1;
        for (std::size_t i = 0; i < 3; ++i) {
            if (x[i] & q) {
                x[0] ^= p;
            } else {
                const std::uint32_t t = (x[0] ^ x[i]) & p;
                x[0] ^= t;
                x[i] ^= t;
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t t = 0;
    for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
        if (x[2] & q) t ^= q - 1;
    for (std::uint32_t& c : x) c ^= t;
    std::uint64_t key = 0;
    for (int b = bits - 1; b >= 0; --b)
        for (std::size_t i = 0; i < 3; ++i) key = key << 1 | (x[i] >> b & 1);
    return key;
}

// The key in halves, as there is one for each triangle: whole, it would make 16 bytes of 12.
struct Keyed {
    std::uint32_t high, low;
    std::uint32_t triangle;

    std::uint64_t key() const { return std::uint64_t{high} << 32 | low; }
};

Keyed keyed_by(std::uint64_t key, std::size_t triangle) {
    return {static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key),
            static_cast<std::uint32_t>(triangle)};
}

// Stable, by key.
void radix_sort(std::vector<Keyed>& keyed) {
    constexpr int digit = 11;
    constexpr std::size_t digits = std::size_t{1} << digit;
    std::vector<Keyed> other(keyed.size());
    for (int shift = 0; shift < 3 * bits; shift += digit) {
        std::array<std::size_t, digits + 1> start{};
        const auto digit_of = [shift](const Keyed& k) {
            return static_cast<std::size_t>(k.key() >> shift & (digits - 1));
        };
        for (const Keyed& k : keyed) ++start[digit_of(k) + 1];
        for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
        for (const Keyed& k : keyed) other[start[digit_of(k)]++] = k;
        keyed.swap(other);
    }
}

std::uint64_t key_of(const Surface& surface, std::size_t triangle) {
    constexpr float steps = static_cast<float>((1 << bits) - 1);
    const std::vector<glm::vec3>& positions = surface.poses().front().positions;
    glm::vec3 middle(0.0f);
    for (std::size_t k = 0; k < 3; ++k) middle += surface.scaled(positions[surface.indices()[3 * triangle + k]]);
    // A triangle's middle is at most one unit from the centroid.
    const glm::vec3 at = glm::clamp(0.5f + middle * (0.5f / 3.0f), 0.0f, 1.0f) * steps;
    return hilbert(
        {static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y), static_cast<std::uint32_t>(at.z)});
}

}  // namespace

std::vector<std::uint32_t> order_along_line(const Surface& surface) {
    std::vector<Keyed> keyed;
    keyed.reserve(surface.triangle_count());
    for (std::size_t i = 0; i < surface.triangle_count(); ++i)
        if (surface.first_area(i) > 0) keyed.push_back(keyed_by(key_of(surface, i), i));
    radix_sort(keyed);
    std::vector<std::uint32_t> triangles;
    triangles.reserve(keyed.size());
    for (const Keyed& k : keyed) triangles.push_back(k.triangle);
    return triangles;
}

Cell cell_along(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, double along, int halvings) {
    static constexpr std::array<glm::vec2, 3> corners{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};
    const auto squared = [](const glm::vec3& d) { return glm::dot(d, d); };
    const float ab = squared(b - a), bc = squared(c - b), ca = squared(a - c);
    const std::size_t first = ab >= bc && ab >= ca ? 0 : bc >= ca ? 1 : 2;
    Cell cell{corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]};
    for (int i = 0; i < halvings; ++i) {
        const glm::vec2 middle = 0.5f * (cell.from + cell.to);
        along *= 2;
        const bool second = along >= 1;  // half; no branch, as nobody could predict it
        along -= second ? 1.0 : 0.0;
        cell.to = second ? cell.to : cell.apex;
        cell.from = second ? cell.apex : cell.from;
        cell.apex = middle;
    }
    return cell;
}

}  // namespace pointsample
