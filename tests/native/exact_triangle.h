// A triangle on a grid, in whole numbers and doubles: what tests hold rasterisers against, sample by sample.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace tests {

struct GridPoint {
    std::int64_t x = 0, y = 0;  // [grid steps], y down
};

struct ExactTriangle {
    std::array<GridPoint, 3> corners;
    std::array<double, 3> depth{};  // linear on the screen

    // Twice the area that is left of from -> to -> at; > 0: clockwise.
    static std::int64_t turn(const GridPoint& from, const GridPoint& to, const GridPoint& at) {
        return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
    }
    std::int64_t area() const { return turn(corners[0], corners[1], corners[2]); }

    // Of a clockwise one. A sample on an edge counts as lying a hair's breadth further right, and a much smaller one
    // further down: of all triangles around it, exactly one has it.
    bool covers(const GridPoint& sample) const {
        for (int i = 0; i < 3; ++i) {
            const GridPoint &from = corners[i], &to = corners[(i + 1) % 3];
            const std::int64_t here = turn(from, to, sample), to_the_right = from.y - to.y, down = to.x - from.x;
            if (here != 0 ? here < 0 : to_the_right != 0 ? to_the_right < 0 : down <= 0) return false;
        }
        return true;
    }

    double depth_at(const GridPoint& sample) const {
        double sum = 0;
        for (int i = 0; i < 3; ++i)
            sum += static_cast<double>(turn(corners[(i + 1) % 3], corners[(i + 2) % 3], sample)) * depth[i];
        return sum / static_cast<double>(area());
    }
    // How much depth changes from one grid step to the next, along x and y together.
    double steepness() const {
        double along = 0, down = 0;
        for (int i = 0; i < 3; ++i) {
            const GridPoint &from = corners[(i + 1) % 3], &to = corners[(i + 2) % 3];
            along += static_cast<double>(from.y - to.y) * depth[i];
            down += static_cast<double>(to.x - from.x) * depth[i];
        }
        return (std::abs(along) + std::abs(down)) / std::abs(static_cast<double>(area()));
    }
    double nearest() const { return std::max({depth[0], depth[1], depth[2]}); }
    double farthest() const { return std::min({depth[0], depth[1], depth[2]}); }

    void turn_around() {
        std::swap(corners[1], corners[2]);
        std::swap(depth[1], depth[2]);
    }
};

// The same numbers everywhere.
class Chance {
public:
    explicit Chance(unsigned seed) : bits_(seed) {}

    unsigned below(unsigned end) { return static_cast<unsigned>(bits_()) % end; }
    bool one_in(unsigned many) { return below(many) == 0; }
    // [low, high]
    std::int64_t whole(std::int64_t low, std::int64_t high) {
        const std::uint64_t both = std::uint64_t{static_cast<std::uint32_t>(bits_())} << 32 | bits_();
        return low + static_cast<std::int64_t>(both % static_cast<std::uint64_t>(high - low + 1));
    }
    double real(double low, double high) { return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0; }

private:
    std::mt19937 bits_;
};

// A step of whole numbers without a common factor, about (x, y), and one between which and it there is no area but the
// least that there is.
inline std::array<GridPoint, 2> neighbours(std::int64_t x, std::int64_t y) {
    // Euclid's way to the greatest common factor: it is a.x * x + a.y * y all along.
    GridPoint a{1, 0}, b{0, 1};
    std::int64_t of_a = x, of_b = y;
    while (of_b != 0) {
        const std::int64_t times = of_a / of_b;
        a = std::exchange(b, {a.x - times * b.x, a.y - times * b.y});
        of_a = std::exchange(of_b, of_a - times * of_b);
    }
    if (of_a == 0) return {GridPoint{1, 0}, GridPoint{0, 1}};
    return {GridPoint{x / of_a, y / of_a}, GridPoint{-a.y, a.x}};
}

// Where corners may be, [low, high], and what of it is looked at; how far apart samples are, the first half as far from
// 0. All in grid steps.
struct Field {
    GridPoint low, high;
    GridPoint seen_low, seen_high;
    std::int64_t sample = 1;
};

// Corners as hostile as they may be: everywhere, far outside, tiny, thin, of no area, through samples.
inline std::array<GridPoint, 3> hostile_corners(const Field& field, Chance& chance) {
    const auto anywhere = [&] {
        return GridPoint{chance.whole(field.low.x, field.high.x), chance.whole(field.low.y, field.high.y)};
    };
    const auto seen = [&] {
        return GridPoint{chance.whole(field.seen_low.x, field.seen_high.x),
                         chance.whole(field.seen_low.y, field.seen_high.y)};
    };
    const auto near_to = [&](const GridPoint& at, std::int64_t reach) {
        return GridPoint{std::clamp(at.x + chance.whole(-reach, reach), field.low.x, field.high.x),
                         std::clamp(at.y + chance.whole(-reach, reach), field.low.y, field.high.y)};
    };
    const auto on_sample = [&](const GridPoint& at) {
        const auto snap = [&](std::int64_t value, std::int64_t low, std::int64_t high) {
            const std::int64_t on = value - ((value - field.sample / 2) % field.sample + field.sample) % field.sample;
            return on < low || on > high ? value : on;
        };
        return GridPoint{snap(at.x, field.low.x, field.high.x), snap(at.y, field.low.y, field.high.y)};
    };
    std::array<GridPoint, 3> p{seen(), seen(), seen()};
    switch (chance.below(12)) {
        case 0:
            return p;
        case 1:
            return {anywhere(), anywhere(), anywhere()};
        case 2:
            return {p[0], anywhere(), anywhere()};
        case 3:
            return {p[0], near_to(p[0], 4 * field.sample), near_to(p[0], 4 * field.sample)};
        case 4:
            return {p[0], near_to(p[0], field.sample), near_to(p[0], field.sample)};
        case 5: {  // thin, and of any length
            const GridPoint a = chance.one_in(2) ? p[0] : anywhere(), b = chance.one_in(2) ? p[1] : anywhere();
            const std::int64_t share = chance.whole(0, 256);
            const GridPoint between{a.x + (b.x - a.x) / 256 * share, a.y + (b.y - a.y) / 256 * share};
            return {a, b, near_to(between, chance.below(4))};
        }
        case 6:
            return {p[0], p[1], p[chance.below(2)]};
        case 7: {  // all its edges go through samples
            for (GridPoint& corner : p) corner = on_sample(chance.one_in(3) ? anywhere() : corner);
            return p;
        }
        case 8: {  // upright and level edges
            const GridPoint far = chance.one_in(2) ? anywhere() : p[1];
            const GridPoint a = on_sample(p[0]), b{on_sample(far).x, a.y}, c{a.x, on_sample(far).y};
            return {a, b, c};
        }
        case 9:
        case 10: {  // as thin as can be, along an edge that goes through a sample
            const GridPoint at = on_sample(p[0]);
            const std::int64_t reach = std::int64_t{1} << chance.below(21);
            const auto [step, beside] = neighbours(chance.whole(-reach, reach), chance.whole(-reach, reach));
            const auto moved = [&](std::int64_t steps, bool aside) {
                const GridPoint to{at.x + steps * step.x + aside * beside.x, at.y + steps * step.y + aside * beside.y};
                return GridPoint{std::clamp(to.x, field.low.x, field.high.x),
                                 std::clamp(to.y, field.low.y, field.high.y)};
            };
            const std::int64_t ahead = 1 + chance.below(3), back = -static_cast<std::int64_t>(chance.below(3));
            return {moved(ahead, false), moved(back, false), moved(chance.whole(back, ahead), true)};
        }
        default: {  // the field's own corners
            const auto corner = [&] {
                return GridPoint{chance.one_in(2) ? field.low.x : field.high.x,
                                 chance.one_in(2) ? field.low.y : field.high.y};
            };
            return {corner(), corner(), chance.one_in(2) ? corner() : p[0]};
        }
    }
}

}  // namespace tests
