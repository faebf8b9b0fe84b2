#include "tests/reference/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reference {

namespace {

const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.45, 0.72, 0.38));
constexpr glm::dvec3 sunlight(0.72, 0.66, 0.55), from_sky(0.32, 0.37, 0.45), from_ground(0.14, 0.14, 0.12);

// Gathers what a pixel may show.
struct Hull {
    glm::dvec3 low{INFINITY}, high{-INFINITY};
    void add(const glm::dvec3& color) {
        low = glm::min(low, color);
        high = glm::max(high, color);
    }
    void clear() { *this = {}; }
};

// The white lines of a football pitch, as distances [m] from their middles and half widths; Laws of the Game, law 1.
struct Stroke {
    double distance, half_width;
};

double to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a));
}

// Corners are square, as they are painted.
double to_rectangle(glm::dvec2 p, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 beyond = glm::abs(p - (from + to) / 2.0) - glm::abs(to - from) / 2.0;
    return std::abs(std::max(beyond.x, beyond.y));
}

std::vector<Stroke> pitch_lines(glm::dvec2 p) {
    constexpr double half_line = 0.06, half_length = 52.5, half_width = 34, spot = 0.12, ring = 9.15;
    std::vector<Stroke> strokes = {
        {to_rectangle(p, {-half_length, -half_width}, {half_length, half_width}), half_line},
        {to_segment(p, {0, -half_width}, {0, half_width}), half_line},
        {std::abs(glm::length(p) - ring), half_line},
        {glm::length(p), spot},
    };
    for (const double end : {-1.0, 1.0}) {
        for (const glm::dvec2 box : {glm::dvec2(16.5, 20.16), glm::dvec2(5.5, 9.16)})
            strokes.push_back(
                {to_rectangle(p, {end * half_length, -box.y}, {end * (half_length - box.x), box.y}), half_line});
        const glm::dvec2 mark(end * (half_length - 11), 0);
        strokes.push_back({glm::length(p - mark), spot});
        // The arc outside the penalty area: where the ring around the mark is beyond the area's line.
        if (end * p.x < half_length - 16.5) strokes.push_back({std::abs(glm::length(p - mark) - ring), half_line});
    }
    return strokes;
}

// Adds what lies under and beside lines of one colour: the line where it may be, and `beneath` unless it is all line.
void add_lined(Hull& hull, const std::vector<Stroke>& strokes, double blur, const glm::dvec3& line,
               const Hull& beneath) {
    bool covered = false;
    for (const Stroke& stroke : strokes) {
        if (stroke.distance < stroke.half_width + blur) hull.add(line);
        covered |= stroke.distance < stroke.half_width - blur;
    }
    if (covered) return;
    hull.add(beneath.low);
    hull.add(beneath.high);
}

Hull grass(glm::dvec2 p, double blur) {
    constexpr double stripe = 5.25, soft = 0.1;  // [m] wide; on each side of its edge mown and unmown meet
    const glm::dvec3 dark(0.050, 0.150, 0.030), bright(0.068, 0.190, 0.040);
    const double index = std::floor(p.x / stripe), inside = p.x - index * stripe;
    const bool near_edge = std::min(inside, stripe - inside) < soft + blur;
    const bool is_bright = std::fmod(std::abs(index), 2.0) == 0;
    // Stripes narrower than a pixel run together.
    const double together = 0.5 * std::min(1.0, blur / stripe);
    Hull hull;
    for (const bool shown : {false, true}) {
        if (shown != is_bright && !near_edge) continue;
        hull.add(glm::mix(dark, bright, shown ? 1.0 : 0.0));
        hull.add(glm::mix(dark, bright, shown ? 1.0 - together : together));
    }
    return hull;
}

Hull of_one(const glm::dvec3& color) {
    return {color, color};
}

}  // namespace

glm::dvec3 light_on(const glm::dvec3& normal, double open) {
    const double upward = (1 + normal.y) / 2;
    return open * (upward * from_sky + (1 - upward) * from_ground) + std::max(glm::dot(normal, to_sun), 0.0) * sunlight;
}

glm::dvec3 stored(const glm::dvec3& linear) {
    return 255.0 * glm::min(glm::sqrt(linear), glm::dvec3(1));
}

Shade sky(const glm::dvec3& ray) {
    const glm::dvec3 haze(0.62, 0.76, 0.88), zenith(0.13, 0.31, 0.63), glare(1.0, 0.93, 0.75);
    const glm::dvec3 along = glm::normalize(ray);
    const double height = std::sqrt(std::max(along.y, 0.0)), facing = std::max(glm::dot(along, to_sun), 0.0);
    const double disc = facing > 0.9996 ? 1 : 0;
    const glm::dvec3 color = haze + height * (zenith - haze) + (0.35 * std::pow(facing, 64) + disc) * glare;
    const glm::dvec3 shown = 255.0 * glm::clamp(color, 0.0, 1.0);
    return Shade::exactly(shown);
}

Shade ground(const Scene& scene, const glm::dvec2& xz, double blur) {
    constexpr double lane = 1.22, lanes = 8, half_lane_line = 0.025;
    const glm::dvec3 white(0.80), lane_white(0.75), tartan(0.32, 0.075, 0.045), apron(0.10, 0.17, 0.20);
    const double half_straight = scene.oval.half_straight;
    // [m] from the track's inner line, outward.
    const double out = glm::length(glm::dvec2(std::max(std::abs(xz.x) - half_straight, 0.0), xz.y)) - scene.oval.radius;
    const auto may_be_within = [&](double from, double to) { return out > from - blur && out < to + blur; };
    Hull hull;
    if (may_be_within(-INFINITY, 0)) add_lined(hull, pitch_lines(xz), blur, white, grass(xz, blur));
    if (may_be_within(0, lanes * lane)) {
        std::vector<Stroke> strokes;
        for (int line = 0; line <= static_cast<int>(lanes); ++line)
            strokes.push_back({std::abs(out - line * lane), half_lane_line});
        if (xz.y > 0) strokes.push_back({std::abs(xz.x - half_straight), half_lane_line});  // the finish
        add_lined(hull, strokes, blur, lane_white, of_one(tartan));
    }
    if (may_be_within(lanes * lane, scene.stand_offset)) hull.add(apron);
    if (may_be_within(scene.stand_offset, INFINITY)) {
        constexpr double slab = 8, half_joint = 0.05;
        const auto to_joint = [&](double x) { return std::abs(x - slab * std::round(x / slab)); };
        const std::vector<Stroke> joints = {{to_joint(xz.x), half_joint}, {to_joint(xz.y), half_joint}};
        add_lined(hull, joints, blur, {0.19, 0.185, 0.18}, of_one({0.26, 0.25, 0.235}));
    }
    const glm::dvec3 light = from_sky + to_sun.y * sunlight;
    return Shade::between(stored(hull.low * light), stored(hull.high * light));
}

glm::dvec3 ground_seen(const Scene& scene, const glm::dvec2& xz, const glm::dvec2& to_right,
                       const glm::dvec2& to_below) {
    constexpr int samples = 6;  // a side
    glm::dvec3 sum(0);
    for (int i = 0; i < samples * samples; ++i) {
        const double x = (i % samples + 0.5) / samples - 0.5, y = (i / samples + 0.5) / samples - 0.5;
        const glm::dvec3 code = ground(scene, xz + x * to_right + y * to_below, 0).best / 255.0;
        sum += code * code / (1.0 * samples * samples);
    }
    return stored(sum);
}

}  // namespace reference
