#include "render/gl/contact_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "shaders/layout.h"

namespace render::gl {

namespace {

constexpr float least_side = 1.0f;    // [m] of a cell
constexpr float most_cells = 256.0f;  // either way
constexpr float margin = 0.01f;       // [m] what rounding may move a place by

template <typename T>
void upload_anew(const Buffer& buffer, std::span<const T> data, GLuint binding) {
    // A fresh store each frame: the device may still be reading the last one.
    glNamedBufferData(buffer.name(), static_cast<GLsizeiptr>(data.size_bytes()), data.data(), GL_STREAM_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

}  // namespace

ContactGrid::ContactGrid() : block_(Buffer::create()), cells_(Buffer::create()), sorted_(Buffer::create()) {}

void ContactGrid::fill(const Frame& frame) {
    find_contact_shades(frame, figures::by_opengl(), shades_);
    if (shades_.empty()) return;
    choose_cells();
    // Counting sort; within a cell people stay in their order.
    first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (const ContactShade& shade : shades_) for_each_cell(shade, [&](std::size_t cell) { ++first_[cell]; });
    std::uint32_t total = 0;
    for (std::uint32_t& first : first_) first = total += first;
    feet_.resize(std::size_t{2} * total);
    for (std::size_t i = shades_.size(); i-- > 0;) {
        const ContactShade& shade = shades_[i];
        for_each_cell(shade, [&](std::size_t cell) {
            const std::size_t at = --first_[cell];
            feet_[2 * at] = glm::vec4(shade.feet, shade.peak);
            feet_[2 * at + 1] = glm::vec4(shade.fall, 0, 0, 0);
        });
    }
    const ContactGridBlock block{glm::vec4(corner_, cells_a_metre_, 0), glm::vec4(columns_, rows_, 0, 0)};
    glNamedBufferData(block_.name(), sizeof block, &block, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, ContactGrid_binding, block_.name());
    upload_anew<std::uint32_t>(cells_, first_, contact_cells_binding);
    upload_anew<glm::vec4>(sorted_, feet_, contact_feet_binding);
}

void ContactGrid::choose_cells() {
    glm::vec2 low(INFINITY), high(-INFINITY);
    for (const ContactShade& shade : shades_) {
        const glm::vec2 xz(shade.feet.x, shade.feet.z);
        low = glm::min(low, xz - shade.radius - margin);
        high = glm::max(high, xz + shade.radius + margin);
    }
    const glm::vec2 reach = high - low;
    cells_a_metre_ = 1 / std::max(least_side, std::max(reach.x, reach.y) / most_cells);
    corner_ = glm::floor(low * cells_a_metre_) / cells_a_metre_;  // so that one person's, too, lie in several cells
    const glm::vec2 size = high - corner_;
    columns_ = static_cast<int>(size.x * cells_a_metre_) + 1;
    rows_ = static_cast<int>(size.y * cells_a_metre_) + 1;
}

template <typename Visit>
void ContactGrid::for_each_cell(const ContactShade& shade, Visit visit) const {
    const float reach = shade.radius + margin;
    const auto cell = [&](float at, float corner, int count) {
        return std::clamp(static_cast<int>((at - corner) * cells_a_metre_), 0, count - 1);
    };
    const int x0 = cell(shade.feet.x - reach, corner_.x, columns_),
              x1 = cell(shade.feet.x + reach, corner_.x, columns_);
    const int y0 = cell(shade.feet.z - reach, corner_.y, rows_), y1 = cell(shade.feet.z + reach, corner_.y, rows_);
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) visit(static_cast<std::size_t>(y) * columns_ + x);
}

bool ContactGrid::touches(const View& view, const motion::Bounds& box) const {
    const glm::vec3 low = view.relative(box.min), high = view.relative(box.max);
    return std::ranges::any_of(shades_, [&](const ContactShade& shade) {
        const glm::vec3 away = shade.feet - glm::clamp(shade.feet, low, high);
        const float reach = shade.radius + margin;
        return glm::dot(away, away) < reach * reach;
    });
}

}  // namespace render::gl
