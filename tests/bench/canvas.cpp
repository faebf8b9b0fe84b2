#include "tests/bench/canvas.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/srgb.h"

namespace bench {
namespace {

constexpr int samples_per_side = 4;  // of a pixel
constexpr std::uint32_t no_triangle = ~0u;

glm::vec3 linear(const glm::u8vec4& color) {
    return {model::linear_of_srgb(color.r), model::linear_of_srgb(color.g), model::linear_of_srgb(color.b)};
}

// The nearest texel's.
glm::vec3 texture_color(const model::Texture& texture, const glm::vec2& uv) {
    const auto wrapped = [](float at, int size) {
        return std::min(static_cast<int>((at - std::floor(at)) * static_cast<float>(size)), size - 1);
    };
    const std::size_t row = static_cast<std::size_t>(wrapped(uv.y, texture.height));
    return linear(texture.texels[row * texture.width + wrapped(uv.x, texture.width)]);
}

// Twice the signed area of a triangle in the picture.
float turn(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

View view_of(const motion::Bounds& box, float azimuth, float elevation, float pixels_per_unit, int margin) {
    View view{};
    view.toward = {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                   std::cos(azimuth) * std::cos(elevation)};
    view.right = {std::cos(azimuth), 0, -std::sin(azimuth)};
    view.up = glm::cross(view.toward, view.right);
    view.center = box.center();
    view.pixels_per_unit = pixels_per_unit;
    const auto pixels = [&](const glm::vec3& axis) {
        return static_cast<int>(std::ceil(glm::dot(glm::abs(axis), box.size()) * pixels_per_unit)) + 2 * margin;
    };
    view.width = pixels(view.right);
    view.height = pixels(view.up);
    return view;
}

Canvas::Canvas(const View& view, glm::vec3 background)
    : view_(view),
      width_(view.width * samples_per_side),
      height_(view.height * samples_per_side),
      colors_(static_cast<std::size_t>(width_) * height_, background),
      depths_(colors_.size(), -std::numeric_limits<float>::infinity()),
      triangles_(colors_.size(), no_triangle) {}

glm::vec3 Canvas::to_samples(const glm::vec3& position) const {
    const glm::vec3 from_center = position - view_.center;
    const float scale = view_.pixels_per_unit * samples_per_side;
    return {0.5f * static_cast<float>(width_) + scale * glm::dot(from_center, view_.right),
            0.5f * static_cast<float>(height_) - scale * glm::dot(from_center, view_.up),
            glm::dot(from_center, view_.toward)};
}

void Canvas::put(int x, int y, float depth, const glm::vec3& color, std::uint32_t triangle) {
    const std::size_t sample = static_cast<std::size_t>(y) * width_ + x;
    if (depth <= depths_[sample]) return;
    depths_[sample] = depth;
    colors_[sample] = color;
    triangles_[sample] = triangle;
}

// Lambert's law, with the stadium's sun.
glm::vec3 Canvas::lit(const glm::vec3& color, glm::vec3 normal, bool double_sided) const {
    static const glm::vec3 sun = glm::normalize(glm::vec3(0.45f, 0.72f, 0.38f));
    constexpr float surroundings = 0.4f;
    if (double_sided && glm::dot(normal, view_.toward) < 0) normal = -normal;
    return color * (surroundings + (1 - surroundings) * std::max(glm::dot(glm::normalize(normal), sun), 0.0f));
}

glm::vec3 Canvas::surface_color(const Subject& subject, std::size_t triangle, const glm::vec3& shares) const {
    const model::Mesh& mesh = subject.character.mesh;
    const std::uint32_t* corners = &mesh.indices[3 * triangle];
    const auto mixed = [&](const auto& value_of) {
        return shares.x * value_of(corners[0]) + shares.y * value_of(corners[1]) + shares.z * value_of(corners[2]);
    };
    glm::vec3 color = mixed([&](std::uint32_t vertex) {
        return linear(mesh.colors[vertex]) * linear(subject.palette[mesh.slots[vertex]]);
    });
    if (const std::uint8_t texture = mesh.material_of(corners[0]).texture; texture != model::no_texture)
        color *= texture_color(mesh.textures[texture], mixed([&](std::uint32_t vertex) { return mesh.uvs[vertex]; }));
    return lit(color, mixed([&](std::uint32_t vertex) { return subject.pose.normals[vertex]; }), mesh.double_sided());
}

void Canvas::draw_mesh(const Subject& subject, std::optional<glm::vec3> flat) {
    const model::Mesh& mesh = subject.character.mesh;
    for (std::size_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        std::array<glm::vec3, 3> at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = to_samples(subject.pose.positions[mesh.indices[3 * triangle + k]]);
        const float area = turn(at[0], at[1], at[2]);
        if (!(std::abs(area) > 0)) continue;
        const glm::vec3 low = glm::min(glm::min(at[0], at[1]), at[2]), high = glm::max(glm::max(at[0], at[1]), at[2]);
        const int last_x = std::min(static_cast<int>(high.x), width_ - 1);
        const int last_y = std::min(static_cast<int>(high.y), height_ - 1);
        for (int y = std::max(static_cast<int>(low.y), 0); y <= last_y; ++y) {
            for (int x = std::max(static_cast<int>(low.x), 0); x <= last_x; ++x) {
                const glm::vec3 here(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0);
                const glm::vec3 shares =
                    glm::vec3(turn(at[1], at[2], here), turn(at[2], at[0], here), turn(at[0], at[1], here)) / area;
                if (shares.x < 0 || shares.y < 0 || shares.z < 0) continue;
                put(x, y, glm::dot(shares, glm::vec3(at[0].z, at[1].z, at[2].z)),
                    flat ? *flat : surface_color(subject, triangle, shares), static_cast<std::uint32_t>(triangle));
            }
        }
    }
}

void Canvas::draw_points(const Subject& subject, const pointsample::PointModel& model, std::size_t count, float radius,
                         float lift) {
    const float reach = radius * view_.pixels_per_unit * samples_per_side;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at = to_samples(model.positions[i]);
        const glm::vec3 color = lit(linear(model.colors[i]) * linear(subject.palette[model.slots[i]]), model.normals[i],
                                    subject.character.mesh.double_sided());
        const int last_x = std::min(static_cast<int>(std::floor(at.x + reach)), width_ - 1);
        const int last_y = std::min(static_cast<int>(std::floor(at.y + reach)), height_ - 1);
        for (int y = std::max(static_cast<int>(std::floor(at.y - reach)), 0); y <= last_y; ++y) {
            for (int x = std::max(static_cast<int>(std::floor(at.x - reach)), 0); x <= last_x; ++x) {
                const float dx = static_cast<float>(x) + 0.5f - at.x, dy = static_cast<float>(y) + 0.5f - at.y;
                if (dx * dx + dy * dy <= reach * reach) put(x, y, at.z + lift, color, no_triangle);
            }
        }
    }
}

bool Canvas::shows(const Subject& subject, std::uint32_t triangle, const glm::vec3& spot) const {
    const glm::ivec2 at = glm::floor(to_samples(spot));
    if (at.x < 0 || at.x >= width_ || at.y < 0 || at.y >= height_) return false;
    if (triangles_[static_cast<std::size_t>(at.y) * width_ + at.x] != triangle) return false;
    constexpr float grazing = 0.25f;  // sine
    const auto corner = [&](std::size_t k) {
        return subject.pose.positions[subject.character.mesh.indices[std::size_t{3} * triangle + k]];
    };
    const glm::vec3 normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    return std::abs(glm::dot(normal, view_.toward)) > grazing;
}

render::Image Canvas::image() const {
    render::Image out{view_.width, view_.height, {}};
    for (int y = 0; y < view_.height; ++y) {
        for (int x = 0; x < view_.width; ++x) {
            glm::vec3 sum(0);
            for (int row = y * samples_per_side; row < (y + 1) * samples_per_side; ++row)
                for (int column = x * samples_per_side; column < (x + 1) * samples_per_side; ++column)
                    sum += colors_[static_cast<std::size_t>(row) * width_ + column];
            sum /= samples_per_side * samples_per_side;
            for (int channel = 0; channel < 3; ++channel) out.pixels.push_back(model::srgb_of_linear(sum[channel]));
        }
    }
    return out;
}

std::vector<glm::vec3> seen_spots(const Subject& subject, const Spots& spots) {
    constexpr int directions = 96;
    constexpr float height_px = 300;
    std::vector<char> seen(spots.positions.size());
    for (int i = 0; i < directions; ++i) {
        // A spiral from pole to pole: nearly even on the sphere.
        const float elevation = std::asin((2 * static_cast<float>(i) + 1) / directions - 1);
        const float azimuth = static_cast<float>(i) * std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
        Canvas canvas(view_of(subject.bounds, azimuth, elevation, height_px / subject.height(), 1));
        canvas.draw_mesh(subject, glm::vec3(0));
        for (std::size_t k = 0; k < seen.size(); ++k)
            if (!seen[k]) seen[k] = canvas.shows(subject, spots.triangles[k], spots.positions[k]);
    }
    std::vector<glm::vec3> kept;
    for (std::size_t k = 0; k < seen.size(); ++k)
        if (seen[k]) kept.push_back(spots.positions[k]);
    return kept;
}

void paste(render::Image& sheet, const render::Image& part, int x, int y) {
    assert(x >= 0 && y >= 0 && x + part.width <= sheet.width && y + part.height <= sheet.height);
    for (int row = 0; row < part.height; ++row) {
        const auto from = part.pixels.begin() + std::ptrdiff_t{3} * row * part.width;
        std::copy(from, from + std::ptrdiff_t{3} * part.width,
                  sheet.pixels.begin() + std::ptrdiff_t{3} * ((y + row) * sheet.width + x));
    }
}

}  // namespace bench
