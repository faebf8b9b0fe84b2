// The stadium's ground: grass and markings, the track, its apron, and paving around the stands.
// Parameters: half straight, radius of the track's inner line, and from there to the stands [m].

#include "ground.glsl"

// The Laws of the Game's pitch [m]; halves are from the middle, depths from the goal line.
const vec2 pitch_half = vec2(52.5, 34.0);
const float circle_radius = 9.15;   // around the middle, and around the penalty mark
const float penalty_depth = 16.5, penalty_half_width = 20.16;
const float goal_area_depth = 5.5, goal_area_half_width = 9.16;
const float penalty_mark = 11.0;
const float mark_radius = 0.12;
const float line_half_width = 0.06;        // [m]
const float lane_width = 1.22;             // [m]
const float lane_count = 8.0;

// A box that reaches `depth` into the pitch from the goal line.
vec2 goal_box(vec2 m, float depth, float half_width) {
    return box(m - vec2(pitch_half.x - 0.5 * depth, 0.0), vec2(0.5 * depth, half_width));
}

float markings(vec2 p) {
    vec2 m = vec2(abs(p.x), p.y);  // both halves are alike
    vec2 from_mark = vec2(p.x - sign(p.x) * (pitch_half.x - penalty_mark), p.y);
    float on_pitch = inside(outset(box(p, pitch_half), line_half_width));
    float marks = line(box(p, pitch_half), line_half_width);
    marks = max(marks, line(edge_x(p.x), line_half_width));
    marks = max(marks, line(circle(p, circle_radius), line_half_width));
    marks = max(marks, line(goal_box(m, penalty_depth, penalty_half_width), line_half_width));
    marks = max(marks, line(goal_box(m, goal_area_depth, goal_area_half_width), line_half_width));
    float arc = line(circle(from_mark, circle_radius), line_half_width);
    marks = max(marks, m.x < pitch_half.x - penalty_depth ? arc : 0.0);
    marks = max(marks, inside(circle(from_mark, mark_radius)));
    marks = max(marks, inside(circle(p, mark_radius)));
    return marks * on_pitch;
}

vec3 grass(vec2 p) {
    const float stripe = 5.25;  // [m] twenty mown stripes on a pitch
    float pixel = footprint.x;
    float mown = clamp(0.5 + sin(p.x * 3.14159265 / stripe) / max(pixel, 0.05), 0.0, 1.0);
    mown = mix(mown, 0.5, clamp(pixel / stripe, 0.0, 1.0));
    return mix(vec3(0.050, 0.150, 0.030), vec3(0.068, 0.190, 0.040), mown);
}

vec3 paving(vec2 p) {
    const float slab = 8.0;  // [m]
    vec2 joint = abs(fract(p / slab + 0.5) - 0.5) * slab;
    float joints = max(line(edge_x(joint.x), 0.05), line(edge_z(joint.y), 0.05));
    return mix(vec3(0.26, 0.25, 0.235), vec3(0.19, 0.185, 0.18), joints);
}

vec3 surface_at(vec2 p) {
    float half_straight = Frame.ground_parameters[0].x, radius = Frame.ground_parameters[0].y;
    float stand_offset = Frame.ground_parameters[0].z;
    // Outward from the track's inner line.
    vec2 beyond = vec2(sign(p.x) * max(abs(p.x) - half_straight, 0.0), p.y);
    vec2 track_edge = circle(beyond, radius);

    vec3 surface = mix(grass(p), vec3(0.80), markings(p));
    float track = inside(other_side(track_edge)) * inside(outset(track_edge, lane_count * lane_width));
    vec2 lane = outset(track_edge, lane_width * round(track_edge.x / lane_width));
    vec3 tartan = mix(vec3(0.32, 0.075, 0.045), vec3(0.75), line(lane, 0.025));
    float finish = line(edge_x(p.x - half_straight), 0.025) * float(p.y > 0.0);
    surface = mix(surface, mix(tartan, vec3(0.75), finish), track);
    float apron = inside(other_side(outset(track_edge, lane_count * lane_width)));
    surface = mix(surface, vec3(0.10, 0.17, 0.20), apron);
    return mix(surface, paving(p), inside(other_side(outset(track_edge, stand_offset))));
}
