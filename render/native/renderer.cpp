#include "render/native/renderer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "figures/way.h"

namespace render::native {

namespace {

template <typename Work>
void for_each_tile(std::size_t count, Work work) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const auto& range) {
            for (std::size_t tile = range.begin(); tile < range.end(); ++tile) work(tile);
        },
        tbb::simple_partitioner());
}

// Of all that is said of them: other people have another one, but for one time in 2^64. A copy of a million people to
// compare with would take as much memory as they do.
std::uint64_t digest_of(std::span<const Person> people) {
    static_assert(sizeof(Person) == sizeof(Instance) + 36 && sizeof(Person) % 8 == 0);  // nothing in it is padding
    constexpr std::size_t words = sizeof(Person) / 8;
    std::uint64_t digest = people.size();
    for (const Person& person : people) {
        std::array<std::uint64_t, words> word;
        std::memcpy(word.data(), &person, sizeof person);
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < words; ++i) {
            const std::uint64_t mixed =
                (word[i] ^ std::rotl(0x9e3779b97f4a7c15u, static_cast<int>(7 * i))) * 0xff51afd7ed558ccdu;
            sum += mixed ^ mixed >> 32;
        }
        digest = std::rotl(digest ^ sum, 23) * 0xc4ceb9fe1a85ec53u;
    }
    return digest;
}

}  // namespace

Renderer::Renderer(const scene::StaticMesh& structure, const scene::Ground& ground, const scene::Light& light,
                   std::span<const figures::Figure> figures, int width, int height)
    : origin_(structure.origin),
      backdrop_(structure, ground, light),
      triangles_(figures, light),
      points_(figures, light),
      far_(figures, light) {
    resize(width, height);
}

void Renderer::resize(int width, int height) {
    width_ = width;
    height_ = height;
    grid_ = TileGrid(width, height);
    behind_.width = width;
    behind_.height = height;
    behind_.color = Plane<std::uint32_t>(width, height);
    behind_.depth = Plane<float>(width, height);
    behind_.farthest = Plane<float>(blocks_across(width), blocks_across(height));
    behind_.error = Plane<float>(blocks_across(width), blocks_across(height));
    picture_ = Plane<std::uint32_t>(width, height);
    has_backdrop_ = has_picture_ = false;
}

Surroundings Renderer::begin(const View& view) {
    Surroundings out;
    if (!has_backdrop_ || !same_view(view, view_)) {
        view_ = view;
        backdrop_.aim(view.from(origin_));
        for_each_tile(grid_.count(), [&](std::size_t tile) { backdrop_.paint(grid_.tile(tile), behind_); });
        out.work[sfsm::WorkKind::structure_triangle] = backdrop_.triangles();
        out.work[sfsm::WorkKind::pixel] = std::int64_t{width_} * height_;
        background_error_ = mean_error(behind_);
        has_backdrop_ = true;
        has_picture_ = false;
    }
    out.background_error = background_error_;
    static_assert(Occlusion::block_side == block_side);
    occlusion_ = {behind_.farthest.row(0), behind_.farthest.stride(), blocks_across(width_), blocks_across(height_)};
    out.occlusion = &occlusion_;
    return out;
}

bool Renderer::is_drawn_already(const Frame& frame, std::uint64_t people) const {
    return has_picture_ && frame.splat_size == drawn_splat_size_ && frame.far_blocks == drawn_far_ &&
           frame.far_people.crowd == drawn_crowd_ && people == drawn_people_;
}

void Renderer::draw(const Frame& frame) {
    const std::uint64_t people = digest_of(frame.people);
    if (is_drawn_already(frame, people)) return;
    part_people(frame);
    triangles_.prepare(frame.view, near_people_);
    points_.prepare(frame.view, frame.splat_size, point_people_);
    prepare_far(frame);
    find_contact_shades(frame, figures::natively(), shades_);
    fill_lists();
    for_each_tile(grid_.count(), [&](std::size_t tile) { draw_tile(tile); });
    drawn_people_ = people;
    drawn_far_ = frame.far_blocks;
    drawn_crowd_ = frame.far_people.crowd;
    drawn_splat_size_ = frame.splat_size;
    has_picture_ = true;
}

// Near ones, the nearest first, and others as they come: so they lie side by side when they are made ready.
void Renderer::part_people(const Frame& frame) {
    unsorted_.clear();
    point_people_.clear();
    for (const Person& person : frame.people) {
        const bool is_mesh = figures::natively().representations[person.representation].is_mesh;
        (is_mesh ? unsorted_ : point_people_).push_back(&person);
        if (!is_mesh) points_.model(person.character);
    }
    near_people_.clear();
    order_.sort(unsorted_);
    for (const std::uint32_t number : order_.numbers()) near_people_.push_back(unsorted_[number]);
    order_.sort(point_people_);
}

void Renderer::prepare_far(const Frame& frame) {
    if (!frame.far_blocks.empty() && !far_.knows()) {
        std::vector<const SplatModel*> models;
        for (std::uint32_t character = 0; character < far_.characters(); ++character)
            models.push_back(far_.can_draw(character) ? &points_.model(character) : nullptr);
        far_.learn(models);
    }
    far_.prepare(frame, points_.cell());
}

void Renderer::fill_lists() {
    near_lists_.fill(grid_, triangles_.bounds());
    point_lists_.fill(grid_, points_.bounds(), order_.numbers());
    far_lists_.fill(grid_, far_.bounds());
    shade_bounds_.clear();
    for (const ContactShade& shade : shades_) shade_bounds_.push_back(bounds_of(view_, shade));
    shade_lists_.fill(grid_, shade_bounds_);
}

void Renderer::draw_tile(std::size_t index) {
    const Tile tile = grid_.tile(index);
    std::span<const std::uint32_t> others = point_lists_.of(index);
    Easel& easel = easels_.local();
    const float far_end = draw_near(index, easel);  // 0: nobody is near
    std::span<const std::uint32_t> far = far_lists_.of(index);
    if (others.empty() && far.empty() && far_end == 0) return show(tile, shade_backdrop(index, easel));
    easel.cover.begin(tile, behind_, points_.cell(), far_end > 0 ? &easel.near : nullptr);
    if (far_end > 0) {
        // Who may be in front of somebody near comes before them and, for what is behind, once more after them.
        std::size_t mixed = 0, mixed_far = 0;
        while (mixed < others.size() && points_.people()[others[mixed]].nearest() < far_end) ++mixed;
        while (mixed_far < far.size() && far_.blocks()[far[mixed_far]].nearest() < far_end) ++mixed_far;
        draw_others(others.first(mixed), far.first(mixed_far), easel, Layers::before_near);
        easel.cover.lay_near();
        draw_others(others.first(mixed), far.first(mixed_far), easel, Layers::behind_near);
        others = others.subspan(mixed);
        far = far.subspan(mixed_far);
    }
    draw_others(others, far, easel, Layers::all);
    easel.cover.resolve(shade_backdrop(index, easel), picture_);
}

// By depth.
void Renderer::draw_others(std::span<const std::uint32_t> people, std::span<const std::uint32_t> far, Easel& easel,
                           Layers layers) const {
    const auto draw_block = [&] {
        if (far.size() > 1) far_.prefetch(far_.blocks()[far[1]]);
        draw_far_block(far_.blocks()[far.front()], easel, layers);
        far = far.subspan(1);
    };
    for (std::size_t i = 0; i < people.size(); ++i) {
        constexpr std::size_t soon = 6, very_soon = 2;
        if (i + soon < people.size()) points_.people()[people[i + soon]].prefetch();
        if (i + very_soon < people.size()) points_.people()[people[i + very_soon]].prefetch_points();
        const SplatPerson& person = points_.people()[people[i]];
        while (!far.empty() && far_.blocks()[far.front()].depth < person.depth) draw_block();
        draw_point_person(person, easel, layers);
    }
    while (!far.empty()) draw_block();
}

// With the shade of who stands there. It isn't painted into what is behind, which is kept while they move.
TileColors Renderer::shade_backdrop(std::size_t index, Easel& easel) const {
    return easel.contact.darken(view_, grid_.tile(index), behind_, shades_, shade_bounds_, shade_lists_.of(index));
}

void Renderer::show(const Tile& tile, const TileColors& colors) {
    for (int y = tile.y0; y < tile.y1; ++y)
        std::copy_n(colors.row(y - tile.y0), tile.x1 - tile.x0, picture_.row(y) + tile.x0);
}

// Returns how far back [m] they reach; 0: there is nobody.
float Renderer::draw_near(std::size_t tile, Easel& easel) const {
    const std::span<const std::uint32_t> people = near_lists_.of(tile);
    if (people.empty()) return 0;
    easel.near.begin(grid_.tile(tile), behind_);
    float far_end = 0;
    for (const std::uint32_t i : people) {
        triangles_.draw(i, easel.near);
        far_end = std::max(far_end, near_people_[i]->depth + points_.reach_of(*near_people_[i]));
    }
    easel.near.resolve();
    return far_end;
}

void Renderer::draw_point_person(const SplatPerson& person, Easel& easel, Layers layers) const {
    const Patch patch = patch_for(person.cells(), easel);
    if (!patch.cells) return;
    splat(person, points_.light(), patch);
    easel.cover.lay(person, patch, layers);
}

void Renderer::draw_far_block(const FarBlockOnScreen& block, Easel& easel, Layers layers) const {
    const Patch patch = patch_for(block.cells(), easel);
    if (!patch.cells) return;
    far_.splat(block, patch);
    easel.cover.lay(block, patch, layers);
}

// For what of these cells can be seen; without cells if there is none.
Patch Renderer::patch_for(const Rect& cells, Easel& easel) {
    const Rect open = easel.cover.open_part(cells);
    if (open.empty()) return {};
    // A cell gets from points up to a cell before it, and those share it with the one after it.
    const int x0 = std::max(cells.x0, open.x0 - 1), y0 = std::max(cells.y0, open.y0 - 1);
    const int width = std::min(cells.x1, open.x1 + 1) - x0, height = std::min(cells.y1, open.y1 + 1) - y0;
    if (width < 2 || height < 2) return {};
    return easel.room.patch(x0, y0, width, height);
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
