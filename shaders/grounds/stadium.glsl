// The stadium's ground: grass and markings, the track, its apron, and paving around the stands.
// Parameters: half straight, radius of the track's inner line, and from there to the stands [m].

#include "ground.glsl"

// The Laws of the Game's pitch [m]; halves are from the middle, depths from the goal line.
const vec2 pitch_half = vec2(52.5f, 34.0f);
const float circle_radius = 9.15f;  // around the middle, and around the penalty mark
const float penalty_depth = 16.5f, penalty_half_width = 20.16f;
const float goal_area_depth = 5.5f, goal_area_half_width = 9.16f;
const float penalty_mark = 11.0f;
const float mark_radius = 0.12f;
const float line_half_width = 0.06f;  // [m]
const float lane_width = 1.22f;       // [m]
const float lane_count = 8.0f;

// A box that reaches `depth` into the pitch from the goal line.
vec2 goal_box(vec2 m, float depth, float half_width) {
    return box(m - vec2(pitch_half.x - 0.5f * depth, 0.0f), vec2(0.5f * depth, half_width));
}

real markings(vec2 p) {
    vec2 m = vec2(abs(p.x), p.y);  // both halves are alike
    vec2 from_mark = vec2(p.x - sign(p.x) * (pitch_half.x - penalty_mark), p.y);
    real on_pitch = inside(outset(box(p, pitch_half), line_half_width));
    real marks = line(box(p, pitch_half), line_half_width);
    marks = max(marks, line(edge_x(p.x), line_half_width));
    marks = max(marks, ring(p, circle_radius, line_half_width));
    marks = max(marks, line(goal_box(m, penalty_depth, penalty_half_width), line_half_width));
    marks = max(marks, line(goal_box(m, goal_area_depth, goal_area_half_width), line_half_width));
    real arc = ring(from_mark, circle_radius, line_half_width);
    marks = max(marks, select(m.x < pitch_half.x - penalty_depth, arc, 0.0f));
    marks = max(marks, disc(from_mark, mark_radius));
    marks = max(marks, disc(p, mark_radius));
    return marks * on_pitch;
}

vec3 grass(vec2 p) {
    const float stripes = 1.0f / 5.25f;  // [1/m] twenty mown stripes on a pitch
    real pixel = footprint.x;
    real mown = clamp(0.5f + sin(p.x * (3.14159265f * stripes)) / max(pixel, 0.05f), 0.0f, 1.0f);
    mown = mix(mown, 0.5f, clamp(pixel * stripes, 0.0f, 1.0f));
    return mix(vec3(0.050f, 0.150f, 0.030f), vec3(0.068f, 0.190f, 0.040f), mown);
}

vec3 paving(vec2 p) {
    const float slab = 8.0f;  // [m]
    vec2 joint = abs(fract(p * (1.0f / slab) + 0.5f) - 0.5f) * slab;
    real joints = max(line(edge_x(joint.x), 0.05f), line(edge_z(joint.y), 0.05f));
    return mix(vec3(0.26f, 0.25f, 0.235f), vec3(0.19f, 0.185f, 0.18f), joints);
}

// Grass and track, up to the stands.
vec3 arena(vec2 p, vec2 track_edge) {
    vec2 outer_edge = outset(track_edge, lane_count * lane_width);
    real track = inside(other_side(track_edge)) * inside(outer_edge);
    real apron = inside(other_side(outer_edge));
    vec3 surface = vec3(0.0f);
    if (somewhere(max(track, apron) < 1.0f)) surface = mix(grass(p), vec3(0.80f), markings(p));
    if (somewhere(track > 0.0f)) {
        vec2 lane = outset(track_edge, lane_width * round(track_edge.x * (1.0f / lane_width)));
        vec3 tartan = mix(vec3(0.32f, 0.075f, 0.045f), vec3(0.75f), line(lane, 0.025f));
        real finish = line(edge_x(p.x - Frame.ground_parameters[0].x), 0.025f) * select(p.y > 0.0f, 1.0f, 0.0f);
        surface = mix(surface, mix(tartan, vec3(0.75f), finish), track);
    }
    return mix(surface, vec3(0.10f, 0.17f, 0.20f), apron);
}

vec3 surface_at(vec2 p) {
    float half_straight = Frame.ground_parameters[0].x, radius = Frame.ground_parameters[0].y;
    float stand_offset = Frame.ground_parameters[0].z;
    // Outward from the track's inner line.
    vec2 beyond = vec2(sign(p.x) * max(abs(p.x) - half_straight, 0.0f), p.y);
    vec2 track_edge = circle(beyond, radius);
    real paved = inside(other_side(outset(track_edge, stand_offset)));
    vec3 surface = vec3(0.0f);
    if (somewhere(paved < 1.0f)) surface = arena(p, track_edge);
    if (somewhere(paved > 0.0f)) surface = mix(surface, paving(p), paved);
    return surface;
}
