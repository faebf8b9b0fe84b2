#include "render/native/renderer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace render::native {

Renderer::Renderer(std::span<const figures::Figure> figures, const scene::Light& light, int width, int height)
    : points_(figures, light) {
    resize(width, height);
}

void Renderer::resize(int width, int height) {
    width_ = width;
    height_ = height;
    columns_ = (width + tile_side - 1) / tile_side;
    rows_ = (height + tile_side - 1) / tile_side;
    behind_.width = width;
    behind_.height = height;
    behind_.color = Plane<std::uint32_t>(width, height);
    behind_.depth = Plane<float>(width, height);
    picture_ = Plane<std::uint32_t>(width, height);
}

Tile Renderer::tile_at(std::size_t index) const {
    const int x0 = static_cast<int>(index) % columns_ * tile_side, y0 = static_cast<int>(index) / columns_ * tile_side;
    return {x0, y0, std::min(x0 + tile_side, width_), std::min(y0 + tile_side, height_)};
}

void Renderer::draw(const Frame& frame) {
    sort_by_depth(frame);
    points_.prepare(frame.view, frame.splat_size, point_people_);
    bin_people();
    tbb::parallel_for(std::size_t{0}, tile_count(), [&](std::size_t tile) { draw_tile(tile); });
}

// Stable, by the bits of the depth: a positive float's rise with it.
void Renderer::sort_by_depth(const Frame& frame) {
    constexpr int digit_bits = 11;
    constexpr std::uint32_t digits = 1u << digit_bits;
    unsorted_.clear();
    for (const Person& person : frame.people) unsorted_.push_back(&person);
    point_people_.resize(unsorted_.size());
    for (const int shift : {31 - 2 * digit_bits, 31 - digit_bits}) {
        keys_.assign(digits + 1, 0);
        const auto digit = [&](const Person* person) {
            return std::bit_cast<std::uint32_t>(person->depth) >> shift & (digits - 1);
        };
        for (const Person* person : unsorted_) ++keys_[digit(person) + 1];
        for (std::uint32_t i = 0; i < digits; ++i) keys_[i + 1] += keys_[i];
        for (const Person* person : unsorted_) point_people_[keys_[digit(person)]++] = person;
        unsorted_.swap(point_people_);
    }
    unsorted_.swap(point_people_);
}

void Renderer::bin_people() {
    const auto people = points_.people();
    const auto for_each_tile = [&](const SplatPerson& person, auto visit) {
        const auto at = [&](std::int16_t cell, int most) {
            return std::clamp(static_cast<int>(static_cast<float>(cell) * person.cell) / tile_side, 0, most - 1);
        };
        if (person.x1 <= 0 || person.y1 <= 0) return;
        if (static_cast<float>(person.x0) * person.cell >= static_cast<float>(width_)) return;
        if (static_cast<float>(person.y0) * person.cell >= static_cast<float>(height_)) return;
        for (int y = at(person.y0, rows_); y <= at(person.y1, rows_); ++y)
            for (int x = at(person.x0, columns_); x <= at(person.x1, columns_); ++x) visit(y * columns_ + x);
    };
    tile_begin_.assign(tile_count() + 1, 0);
    for (const SplatPerson& person : people) for_each_tile(person, [&](int tile) { ++tile_begin_[tile + 1]; });
    for (std::size_t i = 0; i < tile_count(); ++i) tile_begin_[i + 1] += tile_begin_[i];
    tile_people_.resize(tile_begin_.back());
    for (std::uint32_t i = 0; i < people.size(); ++i)
        for_each_tile(people[i], [&](int tile) { tile_people_[tile_begin_[tile]++] = i; });
    for (std::size_t i = tile_count(); i > 0; --i) tile_begin_[i] = tile_begin_[i - 1];
    tile_begin_[0] = 0;
}

void Renderer::draw_tile(std::size_t index) {
    const Tile tile = tile_at(index);
    Bench& bench = benches_.local();
    bench.cover.begin(tile);
    for (std::uint32_t i = tile_begin_[index]; i < tile_begin_[index + 1]; ++i) {
        const SplatPerson& person = points_.people()[tile_people_[i]];
        Patch patch;
        patch.x0 = std::max<int>(person.x0, tile.x0 - 1);
        patch.y0 = std::max<int>(person.y0, tile.y0 - 1);
        patch.width = std::min<int>(person.x1, tile.x1 + 1) - patch.x0;
        patch.height = std::min<int>(person.y1, tile.y1 + 1) - patch.y0;
        if (patch.width < 2 || patch.height < 2) continue;
        patch.stride = (patch.width + group_cells - 1) / group_cells * group_cells;
        patch.cells = bench.cells.data();
        patch.used = bench.used.data();
        splat(person, points_.light(), patch);
        bench.cover.lay(person, patch, behind_);
    }
    bench.cover.resolve(behind_, picture_);
}

Image Renderer::read_image() const {
    Image image{width_, height_, std::vector<std::uint8_t>(std::size_t{3} * width_ * height_)};
    std::uint8_t* to = image.pixels.data();
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            for (int channel = 0; channel < 3; ++channel)
                *to++ = static_cast<std::uint8_t>(picture_.row(y)[x] >> (8 * channel));
    return image;
}

}  // namespace render::native
