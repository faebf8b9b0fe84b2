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

static_assert(sizeof(ContactShade) == 6 * sizeof(float));

template <typename T>
void upload_anew(const Buffer& buffer, std::span<const T> data, GLuint binding) {
    // A fresh store each frame: the device may still be reading the last one.
    glNamedBufferData(buffer.name(), static_cast<GLsizeiptr>(data.size_bytes()), data.data(), GL_STREAM_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

}  // namespace

ContactGrid::ContactGrid()
    : block_(Buffer::create()), cells_(Buffer::create()), feet_(Buffer::create()), sorted_(Buffer::create()) {}

void ContactGrid::fill(const Frame& frame) {
    find_contact_shades(frame, figures::by_opengl(), shades_);
    if (shades_.empty()) return;
    choose_cells();
    sort_into_cells();
    const ContactGridBlock block{glm::vec4(corner_, cells_a_metre_, 0), glm::vec4(columns_, rows_, 0, 0)};
    glNamedBufferData(block_.name(), sizeof block, &block, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, ContactGrid_binding, block_.name());
    upload_anew<std::uint32_t>(cells_, first_, contact_cells_binding);
    upload_anew<ContactShade>(feet_, shades_, contact_feet_binding);
    upload_anew<std::uint32_t>(sorted_, numbers_, contact_numbers_binding);
}

// Counting sort; within a cell people stay in their order.
void ContactGrid::sort_into_cells() {
    first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (const ContactShade& shade : shades_) for_each_cell(shade, [&](std::size_t cell) { ++first_[cell]; });
    std::uint32_t total = 0;
    for (std::uint32_t& first : first_) first = total += first;
    numbers_.resize(total);
    for (std::size_t i = shades_.size(); i-- > 0;)
        for_each_cell(shades_[i], [&](std::size_t cell) { numbers_[--first_[cell]] = static_cast<std::uint32_t>(i); });
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

ContactGrid::Cells ContactGrid::cells_of(glm::vec2 low, glm::vec2 high) const {
    const auto cell = [&](float at, float corner, int count) {
        return static_cast<int>(std::clamp((at - corner) * cells_a_metre_, 0.0f, static_cast<float>(count - 1)));
    };
    return {cell(low.x, corner_.x, columns_), cell(high.x, corner_.x, columns_), cell(low.y, corner_.y, rows_),
            cell(high.y, corner_.y, rows_)};
}

template <typename Visit>
void ContactGrid::for_each_cell(const ContactShade& shade, Visit visit) const {
    const glm::vec2 feet(shade.feet.x, shade.feet.z);
    const float reach = shade.radius + margin;
    const Cells cells = cells_of(feet - reach, feet + reach);
    for (int y = cells.y0; y <= cells.y1; ++y)
        for (int x = cells.x0; x <= cells.x1; ++x) visit(static_cast<std::size_t>(y) * columns_ + x);
}

bool ContactGrid::touches(const View& view, const motion::Bounds& box) const {
    if (shades_.empty()) return false;
    const glm::vec3 low = view.relative(box.min), high = view.relative(box.max);
    const auto touches_it = [&](std::uint32_t number) {
        const ContactShade& shade = shades_[number];
        const glm::vec3 away = shade.feet - glm::clamp(shade.feet, low, high);
        const float reach = shade.radius + margin;
        return glm::dot(away, away) < reach * reach;
    };
    // Whoever reaches into the box is in a cell that it lies in, or is beside all cells.
    const Cells cells = cells_of({low.x, low.z}, {high.x, high.z});
    for (int y = cells.y0; y <= cells.y1; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * columns_;
        const auto numbers =
            std::span(numbers_).subspan(first_[row + cells.x0], first_[row + cells.x1 + 1] - first_[row + cells.x0]);
        if (std::ranges::any_of(numbers, touches_it)) return true;
    }
    return false;
}

}  // namespace render::gl
