#include "apps/gallery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "apps/interrupt.h"
#include "apps/lettering.h"
#include "figures/representation.h"
#include "render/contact_shade.h"
#include "render/native/renderer.h"
#include "render/select.h"
#include "scene/gathering.h"
#include "scene/person.h"
#include "scene/static_mesh_builder.h"

namespace apps {

namespace {

constexpr int picture_width = 100, picture_height = 150;  // [px]
constexpr int pictures_a_part = 4;                        // front and side, as triangles and as points
constexpr int gap = 4;                                    // [px]
constexpr int part_width = pictures_a_part * picture_width + gap;
constexpr int title_height = 2 * letter_height + 2 * gap, caption_height = letter_height + gap;
constexpr int row_height = title_height + picture_height + caption_height;
constexpr int least_parts = 4;          // a row is as wide as these, so that titles fit
constexpr float person_height = 1.75f;  // [m]
constexpr glm::u8vec3 paper{245, 245, 242}, ink{30, 30, 34}, alarm{190, 20, 20};

// The floor, the pole and, for who sits, a seat as the stadium has it.
scene::StaticMesh scenery(bool with_seat) {
    constexpr scene::Color light_tile = scene::painted(196, 196, 190), dark_tile = scene::painted(168, 168, 164),
                           pole = scene::painted(225, 70, 50), seat = scene::painted(70, 96, 150);
    constexpr float tile = 0.5f;  // [m]
    constexpr int reach = 12;     // [tiles]
    scene::StaticMeshBuilder builder;
    for (int i = -reach; i < reach; ++i) {
        for (int j = -reach; j < reach; ++j) {
            const float x = tile * static_cast<float>(i), z = tile * static_cast<float>(j);
            builder.quad({x, 0, z + tile}, {x + tile, 0, z + tile}, {x + tile, 0, z}, {x, 0, z},
                         (i + j) % 2 == 0 ? light_tile : dark_tile);
        }
    }
    const float pole_at = -0.65f;  // [m] behind the person for both cameras
    builder.box({-pole_at, 0.5f * person_height, pole_at}, {0.015f, 0, 0}, {0, 0.5f * person_height, 0}, {0, 0, 0.015f},
                pole, pole);
    if (with_seat) {
        builder.box({0, scene::seat_height - 0.02f, 0}, {0.23f, 0, 0}, {0, 0.02f, 0}, {0, 0, 0.2f}, seat, seat);
        builder.box({0, scene::seat_height + 0.15f, -0.22f}, {0.23f, 0, 0}, {0, 0.15f, 0}, {0, 0, 0.02f}, seat, seat);
    }
    builder.close_sector();
    return std::move(builder.mesh);
}

// One character's people and what they are drawn by.
class Studio {
public:
    explicit Studio(const Troupe& troupe)
        : troupe_(troupe), figures_(troupe.figures()), floor_(renderer(false)), seat_(renderer(true)) {}

    // Front and side, as triangles and as points.
    std::vector<render::Image> shoot(const Part& part) {
        const bool sits = part.as == scene::Role::spectator && troupe_.cast[0].sits;
        std::vector<render::Image> pictures;
        for (const bool from_the_side : {false, true})
            for (const bool as_mesh : {true, false})
                pictures.push_back(shoot(part, sits, view_of(part, from_the_side), as_mesh));
        return pictures;
    }

private:
    render::native::Renderer renderer(bool with_seat) const {
        scene::Light light;
        light.glare = glm::vec3(0);
        return {scenery(with_seat), {}, light, figures_, picture_width, picture_height};
    }

    const motion::PoseTable& poses() const { return troupe_.poses[0]; }
    float scale() const { return person_height / poses().rest_height; }

    // Everybody at one scale, unless they need more room. From afar: each point covers what one in the body's middle
    // does, which is too little at a long body's near end.
    render::View view_of(const Part& part, bool from_the_side) const {
        constexpr double away = 45, eye = 6.8, high = 2.6, middle = 1.05;  // [m]
        constexpr double wide = high * picture_width / picture_height;
        const motion::Bounds& box = poses().clip_boxes[part.clip];
        const glm::dvec3 far = scale() * glm::max(glm::abs(box.min), glm::abs(box.max));
        const double top = static_cast<double>(scale() * (box.max.y - poses().floor));
        const double zoom = std::max({1.0, 2.2 * (from_the_side ? far.z : far.x) / wide, 1.1 * top / high});
        const double aside = from_the_side ? zoom * away : 0, ahead = from_the_side ? 0 : zoom * away;
        return render::make_view({{aside, zoom * eye, ahead}, {0, zoom * middle, 0}, 2 * std::atan(0.5 * high / away)},
                                 picture_width, picture_height);
    }

    // Where the stadium would put them.
    scene::Crowd crowd_of_one(scene::Role role, bool sits) const {
        const scene::Role where = scene::follows_path(role) ? scene::Role::standing : role;
        scene::Gathering gathering({1, troupe_.cast, troupe_.poses, 1}, nullptr);
        gathering.open_block();
        const float lift = sits ? gathering.seat_lift(0, person_height) : 0.0f;
        gathering.add({.position = {0, lift, 0}, .height = person_height, .role = where, .fans = {1, 0}});
        gathering.close_block();
        return std::move(gathering.crowd);
    }

    render::Image shoot(const Part& part, bool sits, const render::View& view, bool as_mesh) {
        const scene::Crowd crowd = crowd_of_one(part.as, sits);
        const motion::ClipPoses& clip = poses().clips[part.clip];
        const glm::vec3 position = view.relative(crowd.position[0]);
        render::Frame frame;
        frame.view = view;
        frame.splat_size = 1;
        frame.batch_numbers = 1;
        render::Person person{};
        person.instance = {position, scale(), {0, 32767}, crowd.palette[0]};
        person.pose = static_cast<std::uint32_t>(clip.pose_at(clip.ticks() / 4));
        person.depth = view.depth(position);
        person.shade_radius = sits ? 0.0f : render::contact_reach * person_height;
        person.last_share = 1;
        represent(as_mesh, frame, person);
        frame.people.push_back(person);
        render::native::Renderer& renderer = sits ? seat_ : floor_;
        renderer.begin(view);
        renderer.draw(frame);
        return renderer.read_image();
    }

    // Points finer than the picture, or all there are.
    void represent(bool as_mesh, render::Frame& frame, render::Person& person) const {
        const figures::Way& way = figures::natively();
        const auto found = std::ranges::find_if(way.representations, [&](const figures::Representation& one) {
            return one.is_mesh == as_mesh && !one.is_by_block;
        });
        person.representation = static_cast<std::uint32_t>(found - way.representations.begin());
        const std::vector<figures::Level> levels = found->levels(figures_[0]);
        const figures::Level& finest = levels.back();
        person.first = finest.first;
        person.count = finest.count;
        if (!finest.by_ones) return;
        const float pixels = scale() * frame.view.pixels_per_metre(person.depth);
        const float demand = render::SelectOptions{}.density * poses().area * pixels * pixels;
        constexpr float dense = 4;  // so that there is no gap between points to tell from one in the surface
        const figures::Part part = figures::part_of(finest, dense * demand);
        person.count = part.count;
        person.last_share = part.last_share;
        frame.splat_size = std::max(1.0, std::sqrt(static_cast<double>(demand) / part.count));
    }

    const Troupe& troupe_;
    std::vector<figures::Figure> figures_;
    render::native::Renderer floor_, seat_;
};

// A file's line of the sheet, before it is laid out.
struct Row {
    std::string title;
    std::string failure;  // instead of parts
    std::vector<Part> parts;
    std::vector<std::string> captions;
    std::vector<std::vector<render::Image>> pictures;
};

std::string caption_of(const Part& part, const std::vector<std::string>& clips) {
    return part.role + ": " + (clips.empty() ? "no clip" : "'" + clips[part.clip] + "'");
}

Row draw_row(const CharacterFile& character, const Preparation& preparation) {
    Row row;
    row.title = character.file.string();
    Troupe troupe;
    add_character(troupe, character, preparation);
    Studio studio(troupe);
    row.parts = parts_of(troupe.cast[0]);
    for (const Part& part : row.parts) {
        row.captions.push_back(caption_of(part, troupe.clip_names[0]));
        row.pictures.push_back(studio.shoot(part));
    }
    return row;
}

Row row_of(const CharacterFile& character, const Preparation& preparation) {
    throw_if_interrupted();
    try {
        return draw_row(character, preparation);
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "stadium: %s\n", error.what());
        return {character.file.string(), error.what(), {}, {}, {}};
    }
}

void put(const render::Image& picture, int left, int top, render::Image& sheet) {
    for (int y = 0; y < picture.height; ++y) {
        const auto from = picture.pixels.begin() + std::ptrdiff_t{3} * y * picture.width;
        const auto to = sheet.pixels.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{top + y} * sheet.width + left);
        std::copy_n(from, std::ptrdiff_t{3} * picture.width, to);
    }
}

void put_row(const Row& row, int top, render::Image& sheet) {
    write_text(sheet, gap, top + gap, 2, ink, row.title);
    if (!row.failure.empty()) write_text(sheet, gap, top + title_height, 1, alarm, row.failure);
    for (std::size_t i = 0; i < row.parts.size(); ++i) {
        const int left = gap + static_cast<int>(i) * part_width;
        for (std::size_t j = 0; j < row.pictures[i].size(); ++j)
            put(row.pictures[i][j], left + static_cast<int>(j) * picture_width, top + title_height, sheet);
        write_text(sheet, left, top + title_height + picture_height + gap / 2, 1, ink, row.captions[i]);
    }
}

render::Image lay_out(const std::vector<Row>& rows) {
    std::size_t most_parts = least_parts;
    for (const Row& row : rows) most_parts = std::max(most_parts, row.parts.size());
    render::Image sheet;
    sheet.width = gap + static_cast<int>(most_parts) * part_width;
    sheet.height = gap + static_cast<int>(rows.size()) * row_height;
    const auto pixels = static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height);
    sheet.pixels.reserve(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) sheet.pixels.insert(sheet.pixels.end(), {paper.r, paper.g, paper.b});
    for (std::size_t i = 0; i < rows.size(); ++i) put_row(rows[i], static_cast<int>(i) * row_height, sheet);
    return sheet;
}

}  // namespace

Gallery draw_gallery(const std::vector<CharacterFile>& characters, const Preparation& preparation) {
    std::vector<Row> rows;
    for (const CharacterFile& character : characters) rows.push_back(row_of(character, preparation));
    const auto failed = std::ranges::count_if(rows, [](const Row& row) { return !row.failure.empty(); });
    return {lay_out(rows), static_cast<int>(failed)};
}

}  // namespace apps
