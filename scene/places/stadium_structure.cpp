// build_structure: profiles swept from spoke to spoke, and what stands beside them.
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "scene/openness.h"
#include "scene/person.h"
#include "scene/places/stadium_layout.h"
#include "scene/static_mesh_builder.h"

namespace scene {

namespace {

constexpr Color tread_grey = painted(158, 157, 152), riser_grey = painted(132, 131, 127);
constexpr Color aisle_grey = painted(198, 196, 188), wall_grey = painted(176, 175, 170);
constexpr Color facade_dark = painted(92, 98, 108), facade_light = painted(196, 199, 203);
constexpr Color doorway = painted(38, 40, 44), coping = painted(222, 221, 216);
constexpr Color roof_white = painted(236, 238, 240), roof_under = painted(188, 192, 197);
constexpr Color steel = painted(214, 218, 222), lamp = painted(255, 252, 236);
constexpr Color screen_frame = painted(30, 32, 38), screen_light = painted(70, 120, 170);
constexpr std::array seat_colors{painted(24, 62, 122), painted(52, 104, 170), painted(206, 214, 224)};
constexpr std::array advert_colors{painted(190, 34, 46),  painted(242, 242, 238), painted(20, 92, 62),
                                   painted(240, 176, 32), painted(28, 54, 112),   painted(242, 242, 238)};

// Sections drawn as one: 16 to 24 sectors of the whole.
constexpr std::size_t target_sectors = 22;

// A corner of a profile: offset outward from the inner line, and height, both [m].
struct Corner {
    float offset, height;
};

// A place along a section's chord.
struct Along {
    float share;  // of the way from its first spoke to its second
    float shift;  // [m] further
};

glm::vec3 lift(glm::vec2 xz, float height) {
    return {xz.x, height, xz.y};
}

// A row's shell of a seat [m], around the hips and above the floor.
constexpr float seat_lip = 0.12f, seat_front = 0.22f, seat_back = 0.16f, seat_top = 0.8f;
constexpr float roof_thickness = 0.6f, rim_thickness = 0.3f;  // [m]

// What stands between the pieces of a section and the light, with people in every row.
class SectionLight {
public:
    explicit SectionLight(const StadiumPlan& plan) {
        add_stand(plan);
        bare_ = lines_;
        for (const Row& row : plan.rows) add_row(plan.room, row);
    }

    // openness() of a piece that is swept, of one in an aisle with nobody near: the same for all sections.
    float of(Corner from, Corner to) { return known(known_, lines_, from, to); }
    float of_aisle(Corner from, Corner to) { return known(known_in_aisles_, bare_, from, to); }

private:
    using Known = std::map<std::array<float, 4>, float>;

    static float known(Known& values, const std::vector<SectionLine>& lines, Corner from, Corner to) {
        const auto [value, is_new] = values.try_emplace({from.offset, from.height, to.offset, to.height});
        if (is_new) value->second = openness({from.offset, from.height}, {to.offset, to.height}, lines);
        return value->second;
    }

    void add(Corner from, Corner to, float stops = 1) {
        lines_.push_back({{from.offset, from.height}, {to.offset, to.height}, stops});
    }

    void add_stand(const StadiumPlan& plan) {
        constexpr float far = 100.0f;  // [m]
        const Row& last = plan.rows.back();
        const float inner = plan.outer_offset - rim_thickness, rim = last.floor + rim_above_last_row;
        add({-far, 0}, {wall_offset, 0});
        add({wall_offset, 0}, {wall_offset, first_floor + parapet_height});
        add({wall_offset + parapet_depth, first_floor}, {first_row_offset, first_floor});
        for (std::size_t i = 0; i < plan.rows.size(); ++i) {
            const Row& row = plan.rows[i];
            const float end = row.offset + plan.room.depth;
            add({row.offset, row.floor}, {end, row.floor});
            if (i + 1 == plan.rows.size()) break;
            const Row& next = plan.rows[i + 1];
            const bool is_concourse = i + 1 == plan.lower_rows;
            const float face = is_concourse ? next.offset - parapet_depth : next.offset;
            if (is_concourse) add({end, row.floor}, {face, row.floor});
            add({face, row.floor}, {face, next.floor + (is_concourse ? parapet_height : 0)});
        }
        add({last.offset + plan.room.depth, last.floor}, {inner, last.floor});
        add({inner, last.floor}, {inner, rim});
        add({plan.outer_offset, rim}, {plan.outer_offset, 0});
        add({plan.outer_offset, 0}, {plan.outer_offset + far, 0});
        const Roof& roof = plan.roof;
        add({roof.outer_offset, roof.outer_height - roof_thickness / 2},
            {roof.inner_offset, roof.inner_height - roof_thickness / 2});
    }

    // Who sits leaves less open than who stands: beside them are shoulders, and gaps above.
    void add_row(const Room& room, const Row& row) {
        if (!room.seats) {
            constexpr float stander = 1.6f, stops = 0.6f;  // [m]
            const float feet = row.offset + room.depth / 2;
            return add({feet, row.floor}, {feet, row.floor + stander}, stops);
        }
        constexpr float knees = 0.37f, shoulders = 1.25f;  // [m] before the hips; above the floor
        constexpr float legs_stop = 0.5f, body_stops = 0.75f;
        const float hips = row.offset + hips_depth, surface = row.floor + seat_height;
        add({hips - seat_front, surface}, {hips + seat_back, surface});
        add({hips - seat_front, surface - seat_lip}, {hips - seat_front, surface});
        add({hips + seat_back, surface}, {hips + seat_back, row.floor + seat_top});
        add({hips - knees, row.floor}, {hips - knees, surface}, legs_stop);
        add({hips, surface}, {hips, row.floor + shoulders}, body_stops);
    }

    std::vector<SectionLine> lines_, bare_;
    Known known_, known_in_aisles_;
};

struct Builder : StaticMeshBuilder {
    const StadiumPlan& plan;
    SectionLight light;

    glm::vec2 on_chord(std::size_t section, Along along, float offset) const {
        const glm::vec2 from = plan.spokes[section].at(offset);
        const glm::vec2 to = plan.spokes[(section + 1) % plan.spokes.size()].at(offset);
        return glm::mix(from, to, along.share) + along.shift * glm::normalize(to - from);
    }

    // From `from` to `to` in profile, between `begin` and `end` along the section. Seen from the side that the
    // pitch sees when the profile climbs, from above when it goes outward.
    void sweep(std::size_t section, Corner from, Corner to, Along begin, Along end, Color color) {
        quad(lift(on_chord(section, end, from.offset), from.height),
             lift(on_chord(section, begin, from.offset), from.height),
             lift(on_chord(section, begin, to.offset), to.height), lift(on_chord(section, end, to.offset), to.height),
             color, light.of(from, to));
    }

    void sweep(std::size_t section, Corner from, Corner to, Color color) {
        sweep(section, from, to, {0, 0}, {1, 0}, color);
    }
};

// Wall with advertising, coping, and the walkway behind it up to the first row.
void add_front_wall(Builder& builder, std::size_t section) {
    const float top = first_floor + parapet_height;
    const float back = wall_offset + parapet_depth;
    constexpr float band_bottom = 0.15f, band_top = 1.05f;  // [m]
    constexpr std::size_t panels = 2;
    builder.sweep(section, {wall_offset, 0}, {wall_offset, band_bottom}, wall_grey);
    for (std::size_t panel = 0; panel < panels; ++panel) {
        const float begin = static_cast<float>(panel) / panels, end = static_cast<float>(panel + 1) / panels;
        const Color color = advert_colors[(section * panels + panel) % advert_colors.size()];
        builder.sweep(section, {wall_offset, band_bottom}, {wall_offset, band_top}, {begin, 0}, {end, 0}, color);
    }
    builder.sweep(section, {wall_offset, band_top}, {wall_offset, top}, wall_grey);
    builder.sweep(section, {wall_offset, top}, {back, top}, coping);
    builder.sweep(section, {back, top}, {back, first_floor}, wall_grey);
    builder.sweep(section, {back, first_floor}, {first_row_offset, first_floor}, tread_grey);
}

Color seat_color(std::size_t section, std::size_t row) {
    constexpr std::size_t band = 7;  // rows: the pattern climbs the stand in steps
    return seat_colors[(section + row / band) % seat_colors.size()];
}

// A row's bench of shells: lip, surface, and the two faces of the back.
void add_seats(Builder& builder, std::size_t section, std::size_t row) {
    constexpr Along begin{0, aisle_width / 2}, end{1, -aisle_width / 2};
    const float hips = builder.plan.rows[row].offset + hips_depth, floor = builder.plan.rows[row].floor;
    const float surface = floor + seat_height;
    const Color color = seat_color(section, row);
    const float front = hips - seat_front, back = hips + seat_back, top = floor + seat_top;
    builder.sweep(section, {front, surface - seat_lip}, {front, surface}, begin, end, color);
    builder.sweep(section, {front, surface}, {back, surface}, begin, end, color);
    builder.sweep(section, {back, surface}, {back, top}, begin, end, color);
    builder.sweep(section, {back, top}, {back, floor + builder.plan.room.depth / 4}, begin, end, color);
}

// Half a step in the aisle, against the riser to the next row.
void add_aisle_step(Builder& builder, std::size_t spoke, std::size_t row) {
    const Row& here = builder.plan.rows[row];
    const float rise = (builder.plan.rows[row + 1].floor - here.floor) / 2;
    const glm::vec2 outward = builder.plan.spokes[spoke].outward;
    const glm::vec2 side = aisle_width / 2 * glm::vec2(outward.y, -outward.x);
    const float middle = here.offset + builder.plan.room.depth / 2, end = here.offset + builder.plan.room.depth;
    const glm::vec2 front = builder.plan.spokes[spoke].at(middle), back = builder.plan.spokes[spoke].at(end);
    const float top = here.floor + rise;
    builder.quad(lift(front + side, here.floor), lift(front - side, here.floor), lift(front - side, top),
                 lift(front + side, top), riser_grey, builder.light.of_aisle({middle, here.floor}, {middle, top}));
    builder.quad(lift(front + side, top), lift(front - side, top), lift(back - side, top), lift(back + side, top),
                 aisle_grey, builder.light.of_aisle({middle, top}, {end, top}));
}

// From one row's tread up to the next: a riser, or the walkway and wall between the tiers with a doorway.
void add_rise(Builder& builder, std::size_t section, std::size_t row) {
    const Row& here = builder.plan.rows[row];
    const Row& next = builder.plan.rows[row + 1];
    const float end = here.offset + builder.plan.room.depth;
    if (row + 1 != builder.plan.lower_rows) {
        builder.sweep(section, {end, here.floor}, {next.offset, next.floor}, riser_grey);
        return;
    }
    constexpr float door = 1.1f, door_height = 2.1f;  // [m] half the width
    const float face = next.offset - parapet_depth, top = next.floor + parapet_height;
    const float lintel = here.floor + door_height;
    builder.sweep(section, {end, here.floor}, {face, here.floor}, tread_grey);
    builder.sweep(section, {face, here.floor}, {face, lintel}, {0, 0}, {0.5f, -door}, wall_grey);
    builder.sweep(section, {face, here.floor}, {face, lintel}, {0.5f, -door}, {0.5f, door}, doorway);
    builder.sweep(section, {face, here.floor}, {face, lintel}, {0.5f, door}, {1, 0}, wall_grey);
    builder.sweep(section, {face, lintel}, {face, top}, seat_colors[0]);
    builder.sweep(section, {face, top}, {next.offset, top}, coping);
    builder.sweep(section, {next.offset, top}, {next.offset, next.floor}, wall_grey);
}

void add_rows(Builder& builder, std::size_t section) {
    const std::vector<Row>& rows = builder.plan.rows;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const float end = rows[row].offset + builder.plan.room.depth;
        builder.sweep(section, {rows[row].offset, rows[row].floor}, {end, rows[row].floor}, tread_grey);
        if (builder.plan.room.seats) add_seats(builder, section, row);
        if (row + 1 == rows.size()) break;
        add_rise(builder, section, row);
        if (row + 1 != builder.plan.lower_rows) add_aisle_step(builder, section, row);
    }
}

// The facade: a plinth with gates, and two ribbons of glass if there is room for them.
void add_facade(Builder& builder, std::size_t section, float top) {
    constexpr float plinth_height = 3.4f, ribbon = 2.2f;  // [m]
    const float outer = builder.plan.outer_offset;
    const float plinth = std::min(plinth_height, 0.6f * top);
    const float band = (top - plinth - 2 * ribbon) / 3;
    float height = top;
    const auto down_to = [&](float next, Color color) {
        builder.sweep(section, {outer, height}, {outer, next}, color);
        height = next;
    };
    if (band > ribbon / 4) {
        for (int i = 0; i < 2; ++i) {
            down_to(height - band, facade_light);
            down_to(height - ribbon, section % 4 == 0 ? seat_colors[0] : facade_dark);
        }
    }
    down_to(plinth, facade_light);
    if (section % 3 != 1) {
        down_to(0, wall_grey);
        return;
    }
    constexpr float gate = 2.6f;  // [m] half the width
    builder.sweep(section, {outer, plinth}, {outer, 0}, {0, 0}, {0.5f, -gate}, wall_grey);
    builder.sweep(section, {outer, plinth}, {outer, 0}, {0.5f, -gate}, {0.5f, gate}, doorway);
    builder.sweep(section, {outer, plinth}, {outer, 0}, {0.5f, gate}, {1, 0}, wall_grey);
}

// The walkway behind the last row, the wall at its back, and the facade down to the plaza.
void add_back(Builder& builder, std::size_t section) {
    const StadiumPlan& plan = builder.plan;
    const Row& last = plan.rows.back();
    const float inner = plan.outer_offset - rim_thickness, top = last.floor + rim_above_last_row;
    builder.sweep(section, {last.offset + plan.room.depth, last.floor}, {inner, last.floor}, tread_grey);
    builder.sweep(section, {inner, last.floor}, {inner, top}, wall_grey);
    builder.sweep(section, {inner, top}, {plan.outer_offset, top}, coping);
    add_facade(builder, section, top);
}

// The canopy: top, underside, both edges.
void add_roof(Builder& builder, std::size_t section) {
    const Roof& roof = builder.plan.roof;
    const Corner inner_top{roof.inner_offset, roof.inner_height}, outer_top{roof.outer_offset, roof.outer_height};
    const Corner inner{roof.inner_offset, roof.inner_height - roof_thickness};
    const Corner outer{roof.outer_offset, roof.outer_height - roof_thickness};
    builder.sweep(section, inner, inner_top, roof_white);
    builder.sweep(section, inner_top, outer_top, roof_white);
    builder.sweep(section, outer_top, outer, roof_white);
    builder.sweep(section, outer, inner, roof_under);
}

bool has_roof(const StadiumPlan& plan) {
    return plan.roof.inner_offset < plan.roof.outer_offset;
}

// A mast on the outer wall that holds the roof by a stay to its inner edge.
void add_roof_mast(Builder& builder, std::size_t spoke) {
    const StadiumPlan& plan = builder.plan;
    const Roof& roof = plan.roof;
    constexpr float above_roof = 5.0f, width = 0.5f, stay_width = 0.14f;  // [m]
    const Spoke& at = plan.spokes[spoke];
    const glm::vec3 side{at.outward.y, 0, -at.outward.x};
    const glm::vec2 foot = at.at(plan.outer_offset + width / 2);
    const glm::vec3 head = lift(foot, roof.outer_height + above_roof);
    builder.column(lift(foot, 0), head, side, width, width / 2, steel);
    builder.column(head, lift(at.at(roof.inner_offset + 1.0f), roof.inner_height), side, stay_width, stay_width, steel);
}

void add_floodlight(Builder& builder, int light) {
    const glm::vec2 foot = floodlight_foot(builder.plan, light);
    const float height = builder.plan.rim_height + floodlight_height;
    builder.column(lift(foot, 0), lift(foot, height), {1, 0, 0}, 1.4f, 0.7f, steel);
    const glm::vec3 head = lift(foot, height);
    const glm::vec3 front = glm::normalize(-head);  // the panel looks at the centre spot
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), front));
    const glm::vec3 up = glm::cross(front, right);
    constexpr float half_width = 3.6f, half_height = 2.4f, half_depth = 0.3f;  // [m]
    builder.box(head, half_width * right, half_height * up, half_depth * front, lamp, steel);
}

// A video screen on the roof over the middle of each bend, facing the pitch.
void add_screen(Builder& builder, float side) {
    const StadiumPlan& plan = builder.plan;
    constexpr float half_width = 8.0f, half_height = 3.0f, half_depth = 0.4f, frame = 0.4f, above_roof = 1.2f;  // [m]
    const float x = side * (plan.oval.half_straight + plan.oval.radius + plan.roof.inner_offset + 1.5f);
    const glm::vec3 center(x, plan.roof.inner_height + above_roof + half_height, 0);
    const glm::vec3 right(0, 0, side), up(0, 1, 0), front(-side, 0, 0);
    builder.box(center, half_width * right, half_height * up, half_depth * front, screen_frame, screen_frame);
    const glm::vec3 glass = center + (half_depth + 0.05f) * front;
    const glm::vec3 to_right = (half_width - frame) * right, to_top = (half_height - frame) * up;
    builder.quad(glass - to_right - to_top, glass + to_right - to_top, glass + to_right + to_top,
                 glass - to_right + to_top, screen_light);
    for (const float post : {-0.6f, 0.6f}) {
        const glm::vec3 head = center + post * half_width * right - half_height * up;
        builder.column(head - (above_roof + 1.0f) * up, head, right, 0.5f, 0.5f, steel);
    }
}

void add_section(Builder& builder, std::size_t section) {
    add_front_wall(builder, section);
    add_rows(builder, section);
    add_back(builder, section);
    if (has_roof(builder.plan)) {
        add_roof(builder, section);
        if (section % 2 == 0) add_roof_mast(builder, section);
    }
}

}  // namespace

StaticMesh build_structure(const StadiumPlan& plan) {
    Builder builder{StaticMeshBuilder(), plan, SectionLight(plan)};
    const std::size_t sections = plan.spokes.size();
    const std::size_t sectors = std::min(sections, target_sectors);
    for (std::size_t sector = 0; sector < sectors; ++sector) {
        for (std::size_t i = sector * sections / sectors; i < (sector + 1) * sections / sectors; ++i) {
            add_section(builder, i);
        }
        builder.close_sector();
    }
    for (int light = 0; light < floodlight_count; ++light) add_floodlight(builder, light);
    if (has_roof(plan)) {
        for (const float side : {-1.0f, 1.0f}) add_screen(builder, side);
    }
    builder.close_sector();
    builder.ground();
    builder.close_sector();
    StaticMesh mesh = std::move(builder.mesh);
    mesh.vertices.shrink_to_fit();
    mesh.indices.shrink_to_fit();
    return mesh;
}

}  // namespace scene
