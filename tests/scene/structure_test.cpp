// The structure: cut open, walked on, looked at, and kept clear of people.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>

#include "scene/crowd.h"
#include "scene/places/stadium.h"
#include "sfsm/random.h"
#include "tests/scene/fake_cast.h"

namespace {

using scene::StadiumPlan;
using scene::StaticMesh;
using scene::StaticVertex;

constexpr float wall_offset = 13.0f;  // [m] of the face of the wall between track and stands
constexpr float seat_height = 0.45f;  // [m] above the row's floor

struct Triangle {
    glm::vec3 a, b, c, normal;
    glm::u8vec4 color;
    float open;
};

double luma(glm::u8vec4 color) {
    return 0.299 * color.x + 0.587 * color.y + 0.114 * color.z;
}

// How far a colour is from grey.
int chroma(glm::u8vec4 color) {
    return std::max({color.x, color.y, color.z}) - std::min({color.x, color.y, color.z});
}

struct Stadium {
    StadiumPlan plan;
    StaticMesh mesh;
    std::vector<Triangle> triangles;

    explicit Stadium(std::int64_t people, const scene::Room& room = {})
        : plan(scene::plan_stadium(people, room)), mesh(scene::build_structure(plan)) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const StaticVertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                               &c = mesh.vertices[mesh.indices[i + 2]];
            triangles.push_back({a.position, b.position, c.position, a.normal, a.color, a.open});
        }
    }
    static bool is_ground(const Triangle& t) { return t.color.w == static_cast<int>(scene::Surface::ground); }
    bool has_roof() const { return plan.roof.inner_offset < plan.roof.outer_offset; }
};

const Stadium& stadium(std::int64_t people) {
    static std::map<std::int64_t, Stadium> all;
    return all.try_emplace(people, people).first->second;
}

// One tier without a roof and with one, two tiers, and the largest.
constexpr std::int64_t sizes[] = {1, 8'000, 20'000, 45'000, 1'000'000};

// ---- Cut open ----

// A piece of the outline where a section is cut: from and to are offset and height.
struct Piece {
    glm::vec2 from, to, normal;
    glm::u8vec4 color;
};

// The section's surfaces in the vertical plane at a share of the way from its first spoke to its second.
std::vector<Piece> cut(const Stadium& stadium, std::size_t section, float share) {
    const auto& spokes = stadium.plan.spokes;
    const scene::Spoke &first = spokes[section], &second = spokes[(section + 1) % spokes.size()];
    const glm::vec2 foot = glm::mix(first.foot, second.foot, share);
    const glm::vec2 step = glm::mix(first.outward, second.outward, share);  // per metre of offset
    const glm::vec2 across(step.y, -step.x);
    const auto side = [&](glm::vec3 at) { return glm::dot(glm::vec2(at.x, at.z) - foot, across); };
    const auto seen = [&](glm::vec3 at) {
        return glm::vec2(glm::dot(glm::vec2(at.x, at.z) - foot, step) / glm::dot(step, step), at.y);
    };
    std::vector<Piece> pieces;
    for (const Triangle& t : stadium.triangles) {
        if (Stadium::is_ground(t)) continue;
        std::vector<glm::vec2> ends;
        const glm::vec3 corners[] = {t.a, t.b, t.c};
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 p = corners[i], q = corners[(i + 1) % 3];
            const float at_p = side(p), at_q = side(q);
            if ((at_p < 0) != (at_q < 0)) ends.push_back(seen(glm::mix(p, q, at_p / (at_p - at_q))));
        }
        if (ends.size() != 2 || ends[0].x < 5) continue;
        const glm::vec2 normal(glm::dot(glm::vec2(t.normal.x, t.normal.z), step), t.normal.y);
        pieces.push_back({ends[0], ends[1], normal, t.color});
    }
    return pieces;
}

constexpr float weld = 0.004f;  // [m] rounding where a plane cuts a triangle at a small angle

// The outline from `start` on, piece by piece, each turned to lead on; ends where none does.
std::vector<Piece> follow(std::vector<Piece> pieces, glm::vec2 start) {
    std::vector<Piece> outline;
    glm::vec2 at = start;
    while (true) {
        const auto next = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& piece) {
            return glm::distance(piece.from, at) < weld || glm::distance(piece.to, at) < weld;
        });
        if (next == pieces.end()) return outline;
        Piece piece = *next;
        pieces.erase(next);
        if (glm::distance(piece.from, at) >= weld) std::swap(piece.from, piece.to);
        at = piece.to;
        outline.push_back(piece);
    }
}

// Between the aisles and through the doors, and close beside the aisles' steps.
constexpr float shares[] = {0.08f, 0.3f, 0.5f, 0.72f, 0.92f};

TEST(Outline, OfAStandHasNoGapFromWallToFacadeAndShowsItsFaceAllAlong) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan& plan = stadium(people).plan;
        for (std::size_t section = 0; section < plan.spokes.size(); ++section) {
            for (const float share : shares) {
                const std::vector<Piece> outline = follow(cut(stadium(people), section, share), {wall_offset, 0});
                ASSERT_FALSE(outline.empty());
                const glm::vec2 end = outline.back().to;
                ASSERT_LT(glm::distance(end, glm::vec2(plan.outer_offset, 0)), 0.01f)
                    << people << " people, section " << section << ": ends at " << end.x << ", " << end.y;
                for (const Piece& piece : outline) {
                    const glm::vec2 along = piece.to - piece.from;
                    if (glm::length(along) < 0.01f) continue;
                    ASSERT_GT(glm::dot(glm::vec2(-along.y, along.x), piece.normal), 0) << "seen from behind";
                }
            }
        }
    }
}

TEST(Outline, IsWholeRightUpToTheSpokes) {
    for (const std::int64_t people : {std::int64_t{8'000}, std::int64_t{45'000}}) {
        const StadiumPlan& plan = stadium(people).plan;
        for (std::size_t section = 0; section < plan.spokes.size(); section += 3) {
            for (const float share : {0.002f, 0.998f}) {
                // Steps and masts are cut too there, so that the way may branch: all of it must hang together.
                const std::vector<Piece> pieces = cut(stadium(people), section, share);
                std::vector<glm::vec2> reached{{wall_offset, 0}};
                for (std::size_t i = 0; i < reached.size(); ++i) {
                    for (const Piece& piece : pieces) {
                        for (const auto& [near, far] : {std::pair(piece.from, piece.to), {piece.to, piece.from}}) {
                            if (glm::distance(near, reached[i]) >= weld) continue;
                            const bool known = std::any_of(reached.begin(), reached.end(), [&](glm::vec2 at) {
                                return glm::distance(at, far) < weld / 4;
                            });
                            if (!known) reached.push_back(far);
                        }
                    }
                }
                const bool whole = std::any_of(reached.begin(), reached.end(), [&](glm::vec2 at) {
                    return glm::distance(at, glm::vec2(plan.outer_offset, 0)) < 0.01f;
                });
                ASSERT_TRUE(whole) << people << " people, section " << section;
            }
        }
    }
}

TEST(Outline, HasATreadForEveryRowAndAWallAtItsBack) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan& plan = stadium(people).plan;
        const std::vector<Piece> outline = follow(cut(stadium(people), 3, 0.3f), {wall_offset, 0});
        for (const scene::Row& row : plan.rows) {
            float depth = 0;
            for (const Piece& piece : outline) {
                if (std::abs(piece.from.y - row.floor) > weld || std::abs(piece.to.y - row.floor) > weld) continue;
                const float from = std::max(piece.from.x, row.offset);
                depth += std::max(0.0f, std::min(piece.to.x, row.offset + plan.room.depth) - from);
            }
            EXPECT_NEAR(depth, plan.room.depth, 3 * weld) << "row at " << row.offset;
        }
        float top = 0, parapet = 0;
        for (const Piece& piece : outline) {
            if (piece.from.x > plan.outer_offset - 0.5f) top = std::max(top, piece.from.y);
            if (piece.from.x < wall_offset + 0.5f) parapet = std::max(parapet, piece.from.y);
        }
        EXPECT_NEAR(top, plan.rows.back().floor + 1.4f, weld);
        EXPECT_NEAR(parapet, plan.rows.front().floor + 0.45f, weld);
    }
}

TEST(Outline, OfTheRoofIsAClosedSlabThatRisesTowardsThePitch) {
    constexpr float thickness = 0.6f;
    for (const std::int64_t people : {std::int64_t{45'000}, std::int64_t{1'000'000}}) {
        const Stadium& of = stadium(people);
        ASSERT_TRUE(of.has_roof());
        const glm::vec2 inner(of.plan.roof.inner_offset, of.plan.roof.inner_height);
        const glm::vec2 outer(of.plan.roof.outer_offset, of.plan.roof.outer_height);
        for (std::size_t section = 0; section < of.plan.spokes.size(); section += 2) {
            const std::vector<Piece> outline = follow(cut(of, section, 0.3f), inner);
            ASSERT_FALSE(outline.empty());
            ASSERT_LT(glm::distance(outline.back().to, inner), 2 * weld) << "an open slab";
            double area = 0;  // signed by the sense of the walk
            std::set<double> shades_up, shades_down;
            for (const Piece& piece : outline) {
                area += 0.5 * (piece.from.x * piece.to.y - piece.to.x * piece.from.y);
                if (piece.normal.y > 0.5f) shades_up.insert(luma(piece.color));
                if (piece.normal.y < -0.5f) shades_down.insert(luma(piece.color));
            }
            for (const Piece& piece : outline) {
                const glm::vec2 along = piece.to - piece.from;
                if (glm::length(along) < 0.01f) continue;
                const double outward = glm::dot(glm::vec2(along.y, -along.x), piece.normal);
                ASSERT_GT(area > 0 ? outward : -outward, 0) << "seen from inside";
            }
            EXPECT_NEAR(std::abs(area), thickness * (outer.x - inner.x), 0.05);
            ASSERT_EQ(shades_up.size(), 1u);
            ASSERT_EQ(shades_down.size(), 1u);
            EXPECT_GT(*shades_up.begin(), *shades_down.begin() + 20) << "the underside is in the shade";
        }
    }
}

// ---- Colours ----

TEST(Colours, TellTreadsRisersCopingAndAdvertsApart) {
    for (const std::int64_t people : {std::int64_t{8'000}, std::int64_t{45'000}}) {
        std::set<int> adverts;
        for (std::size_t section = 0; section < stadium(people).plan.spokes.size(); ++section) {
            for (const float share : {0.3f, 0.72f}) {
                const std::vector<Piece> outline = follow(cut(stadium(people), section, share), {wall_offset, 0});
                const StadiumPlan& plan = stadium(people).plan;
                double tread = 0, riser = 255, wall = 0, coping = 0;
                for (const Piece& piece : outline) {
                    const float middle = (piece.from.y + piece.to.y) / 2;
                    const bool flat = piece.normal.y > 0.9f, at_front = piece.from.x < wall_offset + 0.01f;
                    if (at_front && !flat) {
                        if (middle > 0.15f && middle < 1.05f) {
                            adverts.insert(piece.color.x << 16 | piece.color.y << 8 | piece.color.z);
                        } else {
                            EXPECT_LT(chroma(piece.color), 10) << "the wall itself is grey";
                            wall = luma(piece.color);
                        }
                    }
                    if (at_front && flat) coping = luma(piece.color);
                    if (piece.from.x < plan.rows[0].offset || piece.from.x > plan.rows[5].offset) continue;
                    (flat ? tread : riser) = luma(piece.color);
                    EXPECT_LT(chroma(piece.color), 10) << "concrete is grey";
                }
                EXPECT_GT(tread, riser + 15);
                EXPECT_GT(coping, wall + 25);
            }
        }
        EXPECT_EQ(adverts.size(), 5u);
    }
}

TEST(Colours, NeighbouringAdvertsDiffer) {
    const Stadium& of = stadium(20'000);
    std::vector<glm::u8vec4> around;
    for (std::size_t section = 0; section < of.plan.spokes.size(); ++section)
        for (const float share : {0.25f, 0.75f})
            for (const Piece& piece : follow(cut(of, section, share), {wall_offset, 0}))
                if (piece.from.x < wall_offset + 0.01f && std::abs((piece.from.y + piece.to.y) / 2 - 0.6f) < 0.3f &&
                    (around.empty() || around.size() < 2 * section + (share < 0.5f ? 1 : 2)))
                    around.push_back(piece.color);
    ASSERT_EQ(around.size(), 2 * of.plan.spokes.size());
    for (std::size_t i = 1; i < around.size(); ++i) EXPECT_NE(around[i - 1], around[i]) << "panel " << i;
}

bool has_dark(const Stadium& of, std::size_t section, float share, float from, float to, float least_height) {
    for (const Piece& piece : follow(cut(of, section, share), {wall_offset, 0})) {
        const bool there = piece.from.x > from && piece.from.x < to && std::abs(piece.normal.y) < 0.1f;
        if (there && luma(piece.color) < 60 && chroma(piece.color) < 10)
            least_height -= std::abs(piece.to.y - piece.from.y);
    }
    return least_height <= 0;
}

TEST(Doors, LeadToEverySectionOfTheUpperTier) {
    constexpr float height = 2.0f;  // [m] to walk through
    const Stadium& of = stadium(1'000'000);
    const float lower = of.plan.rows[of.plan.lower_rows - 1].offset, upper = of.plan.rows[of.plan.lower_rows].offset;
    for (std::size_t section = 0; section < of.plan.spokes.size(); ++section) {
        EXPECT_TRUE(has_dark(of, section, 0.5f, lower, upper, height));
        for (const float share : {0.3f, 0.7f}) EXPECT_FALSE(has_dark(of, section, share, lower, upper, 0.1f));
    }
}

TEST(Doors, GatesLeadThroughEveryThirdSectionOfTheFacade) {
    for (const std::int64_t people : {std::int64_t{1}, std::int64_t{45'000}}) {
        const Stadium& of = stadium(people);
        int gates = 0;
        for (std::size_t section = 0; section < of.plan.spokes.size(); ++section) {
            const float outer = of.plan.outer_offset;
            gates += has_dark(of, section, 0.5f, outer - 0.1f, outer + 0.1f, 2.0f);
            EXPECT_FALSE(has_dark(of, section, 0.08f, outer - 0.1f, outer + 0.1f, 0.1f));
        }
        EXPECT_NEAR(gates, static_cast<double>(of.plan.spokes.size()) / 3, 1);
    }
}

// ---- Walked on ----

// Of surfaces that face up: the highest below `from` at a place, if any.
class Footing {
public:
    explicit Footing(const Stadium& of) {
        for (const Triangle& t : of.triangles) {
            if (t.normal.y < 0.5f || Stadium::is_ground(t)) continue;
            const glm::vec3 low = glm::min(t.a, glm::min(t.b, t.c)), high = glm::max(t.a, glm::max(t.b, t.c));
            for (int x = cell(low.x); x <= cell(high.x); ++x)
                for (int z = cell(low.z); z <= cell(high.z); ++z) cells_[key(x, z)].push_back(t);
        }
    }

    std::optional<Triangle> below(glm::vec3 from) const {
        const auto found = cells_.find(key(cell(from.x), cell(from.z)));
        if (found == cells_.end()) return std::nullopt;
        std::optional<Triangle> best;
        for (const Triangle& t : found->second) {
            if (!holds(t, from)) continue;
            const float height = height_of(t, from);
            if (height < from.y && (!best || height > height_of(*best, from))) best = t;
        }
        return best;
    }

    static float height_of(const Triangle& t, glm::vec3 at) {
        return t.a.y - (t.normal.x * (at.x - t.a.x) + t.normal.z * (at.z - t.a.z)) / t.normal.y;
    }

private:
    static int cell(float at) { return static_cast<int>(std::floor(at / 2)); }
    static std::int64_t key(int x, int z) { return std::int64_t{x} * 100'000 + z; }
    static bool holds(const Triangle& t, glm::vec3 at) {
        const auto left = [&](glm::vec3 p, glm::vec3 q) {
            return (q.z - p.z) * (at.x - p.x) - (q.x - p.x) * (at.z - p.z) >= -1e-4f;
        };
        return left(t.a, t.b) && left(t.b, t.c) && left(t.c, t.a);
    }
    std::unordered_map<std::int64_t, std::vector<Triangle>> cells_;
};

TEST(Benches, AreUnderEverySeatAndColouredInBlocks) {
    for (const std::int64_t people : {std::int64_t{1}, std::int64_t{45'000}}) {
        const Stadium& of = stadium(people);
        const Footing footing(of);
        std::map<std::pair<int, int>, std::set<double>> shades;  // by section and row
        for (std::size_t i = 0; i < of.plan.seats.size(); i += 3) {
            const scene::Seat& seat = of.plan.seats[i];
            const auto bench = footing.below(seat.position + glm::vec3(0, 1, 0));
            ASSERT_TRUE(bench.has_value());
            ASSERT_NEAR(Footing::height_of(*bench, seat.position), seat.position.y + seat_height, 2e-3f);
            shades[{seat.section, seat.row}].insert(luma(bench->color));
        }
        std::set<double> all;
        for (const auto& [where, shade] : shades) {
            ASSERT_EQ(shade.size(), 1u) << "a row of one section has two colours";
            all.insert(*shade.begin());
            const auto next = shades.find({where.first + 1, where.second});
            if (next != shades.end()) {
                EXPECT_NE(shade, next->second) << "sections beside each other";
            }
        }
        EXPECT_EQ(all.size(), 3u);
        EXPECT_NE((shades[{5, 0}]), (shades[{5, 7}])) << "the pattern climbs";
        EXPECT_EQ((shades[{5, 0}]), (shades[{5, 6}]));
        EXPECT_EQ((shades[{6, 0}]), (shades[{5, 7}]));
    }
}

// ---- How much light from around reaches it ----

TEST(Openness, IsAShareAndWholeOfWhatStandsFree) {
    for (const std::int64_t people : sizes) {
        float least = 1;
        for (const Triangle& t : stadium(people).triangles) {
            EXPECT_GT(t.open, 0.05f);
            EXPECT_LE(t.open, 1.0f);
            least = std::min(least, t.open);
            EXPECT_TRUE(t.open == 1.0f || !Stadium::is_ground(t));
        }
        EXPECT_LT(least, 0.5f) << "nothing is dark";
    }
}

TEST(Openness, IsLessBetweenRowsThanBeforeThemAndLeastUnderTheRoof) {
    const Stadium& of = stadium(45'000);
    ASSERT_TRUE(of.has_roof());
    const Footing footing(of);
    // Of a bench, and of the tread before it, by row; sections are alike.
    std::map<int, std::pair<float, float>> rows;
    for (const scene::Seat& seat : of.plan.seats) {
        const glm::vec3 ahead(std::sin(seat.yaw), 0, std::cos(seat.yaw));
        const auto bench = footing.below(seat.position + glm::vec3(0, 1, 0));
        const auto tread = footing.below(seat.position + 0.4f * ahead + glm::vec3(0, 0.2f, 0));
        ASSERT_TRUE(bench && tread);
        const std::pair found(bench->open, tread->open);
        EXPECT_EQ(rows.try_emplace(seat.row, found).first->second, found);
    }
    const int last = static_cast<int>(of.plan.rows.size()) - 1, middle = static_cast<int>(of.plan.lower_rows) / 2;
    EXPECT_LT(rows[middle].first, 0.75f);
    EXPECT_LT(rows[middle].second, 0.6f);
    EXPECT_LT(rows[last].first, 0.8f * rows[middle].first);
    EXPECT_LT(rows[last].second, 0.9f * rows[middle].second);
    // On the way up to the roof it only gets darker.
    for (int row = static_cast<int>(of.plan.lower_rows) + 2; row <= last; ++row)
        EXPECT_LE(rows[row].first, rows[row - 1].first + 0.02f) << row;
}

TEST(Benches, AreLeftOutOnTerraces) {
    const Stadium terraces(20'000, {1.0f, 1.2f, false});
    const Footing footing(terraces);
    for (std::size_t i = 0; i < terraces.plan.seats.size(); i += 11) {
        const glm::vec3 feet = terraces.plan.seats[i].position;
        const auto tread = footing.below(feet + glm::vec3(0, 1, 0));
        ASSERT_TRUE(tread.has_value());
        ASSERT_NEAR(Footing::height_of(*tread, feet), feet.y, 2e-3f);
    }
}

TEST(Aisles, ClimbInHalfStepsWithNothingInTheWay) {
    constexpr float tallest = 0.28f, stride = 0.05f, half_width = 0.5f;  // [m]
    for (const std::int64_t people : {std::int64_t{20'000}, std::int64_t{1'000'000}}) {
        const Stadium& of = stadium(people);
        const Footing footing(of);
        for (const scene::Spoke& spoke : of.plan.spokes) {
            const glm::vec2 sideways(spoke.outward.y, -spoke.outward.x);
            for (const float beside : {-half_width, 0.01f, half_width}) {
                float previous = of.plan.rows[0].floor;
                for (float offset = of.plan.rows[0].offset + stride; offset < of.plan.rows.back().offset;
                     offset += stride) {
                    const glm::vec2 xz = spoke.at(offset) + beside * sideways;
                    const auto ground = footing.below({xz.x, previous + 1.5f, xz.y});
                    ASSERT_TRUE(ground.has_value());
                    const float height = Footing::height_of(*ground, {xz.x, 0, xz.y});
                    // The upper tier is reached by the doors.
                    if (of.plan.lower_rows < of.plan.rows.size() &&
                        offset > of.plan.rows[of.plan.lower_rows - 1].offset &&
                        offset < of.plan.rows[of.plan.lower_rows].offset + stride) {
                        previous = of.plan.rows[of.plan.lower_rows].floor;
                        continue;
                    }
                    ASSERT_GE(height, previous - 2e-3f) << "at offset " << offset;
                    ASSERT_LE(height, previous + tallest) << "at offset " << offset;
                    previous = height;
                }
            }
        }
    }
}

// ---- Columns and boxes ----

struct Solid {
    std::vector<Triangle> triangles;
    std::set<std::array<float, 3>> corners;

    glm::vec3 centre() const {
        glm::vec3 sum(0);
        for (const auto& corner : corners) sum += glm::vec3(corner[0], corner[1], corner[2]);
        return sum / static_cast<float>(corners.size());
    }
    float top() const {
        float result = -1;
        for (const auto& corner : corners) result = std::max(result, corner[1]);
        return result;
    }
    float bottom() const {
        float result = 1e6f;
        for (const auto& corner : corners) result = std::min(result, corner[1]);
        return result;
    }
};

// Triangles that hang together by their corners.
std::vector<Solid> solids(const Stadium& of) {
    std::map<std::array<float, 3>, std::size_t> ids;
    std::vector<std::size_t> parent;
    const auto root = [&](std::size_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    // To the centimetre: corners of a turned box are rounded one way on one face and another on the next.
    const auto rounded = [](glm::vec3 p) {
        return std::array{std::round(100 * p.x) / 100, std::round(100 * p.y) / 100, std::round(100 * p.z) / 100};
    };
    const auto id = [&](glm::vec3 p) {
        const auto [at, is_new] = ids.try_emplace(rounded(p), parent.size());
        if (is_new) parent.push_back(parent.size());
        return at->second;
    };
    for (const Triangle& t : of.triangles)
        for (const glm::vec3& p : {t.b, t.c}) {
            const std::size_t a = root(id(t.a)), b = root(id(p));
            parent[a] = b;
        }
    std::map<std::size_t, Solid> result;
    for (const Triangle& t : of.triangles) {
        Solid& solid = result[root(id(t.a))];
        solid.triangles.push_back(t);
        for (const glm::vec3& p : {t.a, t.b, t.c}) solid.corners.insert(rounded(p));
    }
    std::vector<Solid> list;
    for (auto& [which, solid] : result) list.push_back(std::move(solid));
    return list;
}

bool is_four_sided(const Solid& solid) {
    return solid.corners.size() == 8 && solid.triangles.size() >= 8;
}

TEST(Masts, ShowTheirFacesAllAround) {
    for (const std::int64_t people : {std::int64_t{8'000}, std::int64_t{45'000}}) {
        const Stadium& of = stadium(people);
        int columns = 0, boxes = 0;
        for (const Solid& solid : solids(of)) {
            if (!is_four_sided(solid)) continue;
            (solid.triangles.size() == 8 ? columns : boxes) += 1;
            for (const Triangle& t : solid.triangles)
                ASSERT_GT(glm::dot((t.a + t.b + t.c) / 3.0f - solid.centre(), t.normal), 0.02f);
        }
        const int roof_masts = of.has_roof() ? static_cast<int>(of.plan.spokes.size() + 1) / 2 : 0;
        // A roof's mast has a stay, and each of two screens two posts.
        EXPECT_EQ(columns, 4 + 2 * roof_masts + (of.has_roof() ? 4 : 0));
        EXPECT_EQ(boxes, 4 + (of.has_roof() ? 2 : 0));
    }
}

TEST(Masts, OfTheFloodlightsStandInTheFourCornersOfThePlazaAndLightThePitch) {
    for (const std::int64_t people : sizes) {
        const Stadium& of = stadium(people);
        std::set<std::pair<bool, bool>> corners, lit;
        for (const Solid& solid : solids(of)) {
            const glm::vec3 at = solid.centre();
            if (!is_four_sided(solid) || solid.top() < of.plan.rim_height + 10) continue;
            const float beyond = of.plan.oval.offset_of({at.x, at.z}) - of.plan.outer_offset;
            EXPECT_GT(beyond, 6.0f);
            EXPECT_LT(beyond, 8.0f);
            if (solid.bottom() == 0) {
                corners.insert({at.x > 0, at.z > 0});
                EXPECT_NEAR(solid.top(), of.plan.rim_height + 20, 0.01f);
                continue;
            }
            EXPECT_NEAR(at.y, of.plan.rim_height + 20, 0.01f);
            const auto lamp = std::max_element(solid.triangles.begin(), solid.triangles.end(),
                                               [](auto& a, auto& b) { return luma(a.color) < luma(b.color); });
            EXPECT_GT(luma(lamp->color), 245);
            EXPECT_GT(glm::dot(lamp->normal, glm::normalize(-at)), 0.999f);
            lit.insert({at.x > 0, at.z > 0});
            int bright = 0;
            for (const Triangle& t : solid.triangles) bright += luma(t.color) > 245;
            EXPECT_EQ(bright, 2) << "one face is lamps";
        }
        EXPECT_EQ(corners.size(), 4u);
        EXPECT_EQ(lit.size(), 4u);
    }
}

TEST(Masts, OfTheRoofReachFromGroundToStayAndStaysToItsInnerEdge) {
    const Stadium& of = stadium(45'000);
    int masts = 0, stays = 0;
    for (const Solid& solid : solids(of)) {
        if (!is_four_sided(solid) || solid.triangles.size() != 8) continue;
        const float head = of.plan.roof.outer_height + 5;
        if (std::abs(solid.top() - head) > 0.3f) continue;
        if (solid.bottom() < 0.01f) {
            ++masts;
            const float beyond = of.plan.oval.offset_of({solid.centre().x, solid.centre().z}) - of.plan.outer_offset;
            EXPECT_NEAR(beyond, 0.25f, 0.15f) << "on the wall";
        } else {
            ++stays;
            EXPECT_NEAR(solid.bottom(), of.plan.roof.inner_height, 0.3f);
            float innermost = 1e6f;
            for (const auto& corner : solid.corners)
                innermost = std::min(innermost, of.plan.oval.offset_of({corner[0], corner[2]}));
            EXPECT_NEAR(innermost, of.plan.roof.inner_offset + 1, 0.4f);
        }
    }
    EXPECT_EQ(masts, static_cast<int>(of.plan.spokes.size() + 1) / 2);
    EXPECT_EQ(stays, masts);
}

TEST(Screens, OfBothEndsShowTheirPictureToThePitch) {
    const Stadium& of = stadium(45'000);
    int glasses = 0;
    for (const Solid& solid : solids(of)) {
        const glm::vec3 at = solid.centre();
        const bool wide = solid.triangles.size() == 2 && at.y > of.plan.roof.inner_height && std::abs(at.z) < 1;
        if (!wide) continue;
        ++glasses;
        EXPECT_NEAR(glm::dot(solid.triangles[0].normal, glm::vec3(at.x > 0 ? -1 : 1, 0, 0)), 1, 1e-5f);
        EXPECT_GT(chroma(solid.triangles[0].color), 60);
        // Nothing is between the glass and the pitch: its frame is behind it, by less than a forearm.
        for (const Solid& other : solids(of)) {
            if (other.triangles.size() != 12 || glm::distance(other.centre(), at) > 3) continue;
            EXPECT_GT(std::abs(other.centre().x), std::abs(at.x));
            EXPECT_LT(glm::distance(other.centre(), at), 0.6f);
            const glm::vec3 frame = other.centre();
            float near_face = 1e6f;
            for (const auto& corner : other.corners) near_face = std::min(near_face, std::abs(corner[0]));
            EXPECT_LT(std::abs(at.x), near_face) << "the glass is inside its frame";
            EXPECT_NEAR(frame.y, at.y, 0.01f);
        }
    }
    EXPECT_EQ(glasses, 2);
}

// ---- Ground and sectors ----

TEST(Ground, CoversEveryPlaceWithinTwoKilometresOnce) {
    std::uint64_t bits = 1;
    for (int trial = 0; trial < 3000; ++trial) {
        const auto draw = [&] { return 3999.9f * (sfsm::upper_unit(bits = sfsm::mix(bits)) - 0.5f); };
        const glm::vec2 at(draw(), draw());
        int covers = 0;
        for (const Triangle& t : stadium(20'000).triangles) {
            if (!Stadium::is_ground(t)) continue;
            const auto left = [&](glm::vec3 p, glm::vec3 q) {
                return (q.z - p.z) * (at.x - p.x) - (q.x - p.x) * (at.y - p.z) > 0;
            };
            covers += left(t.a, t.b) && left(t.b, t.c) && left(t.c, t.a);
        }
        ASSERT_EQ(covers, 1) << at.x << ' ' << at.y;
    }
}

TEST(Ground, IsFinestWhereCamerasAre) {
    float near = 0, far = 0;  // [m] longest edges
    for (const Triangle& t : stadium(20'000).triangles) {
        if (!Stadium::is_ground(t)) continue;
        const float edge = glm::distance(t.a, t.b);
        const glm::vec3 middle = (t.a + t.b + t.c) / 3.0f;
        if (std::abs(middle.x) < 100 && std::abs(middle.z) < 100) near = std::max(near, edge);
        far = std::max(far, edge);
    }
    EXPECT_LE(near, 57) << "the diagonal of 40 m";
    EXPECT_GE(far, 500);
}

TEST(Sectors, HaveTightBoxesAndSharesAlike) {
    for (const std::int64_t people : sizes) {
        const StaticMesh& mesh = stadium(people).mesh;
        std::vector<std::uint32_t> counts;
        for (const scene::StaticSector& sector : mesh.sectors) {
            std::vector<glm::vec3> positions;
            for (std::uint32_t i = sector.first_index; i < sector.first_index + sector.index_count; ++i)
                positions.push_back(mesh.vertices[mesh.indices[i]].position);
            const motion::Bounds tight = motion::bounds_of(positions);
            EXPECT_EQ(sector.box.min, tight.min);
            EXPECT_EQ(sector.box.max, tight.max);
            counts.push_back(sector.index_count);
        }
        // The last two are the masts and the ground.
        ASSERT_EQ(counts.size(), 24u);
        const auto [least, most] = std::minmax_element(counts.begin(), counts.end() - 2);
        EXPECT_LE(*most, *least * 2.3) << "sectors are of one section or two, or of two or three";
        EXPECT_LT(mesh.sectors[22].index_count, 1000u);
        EXPECT_EQ(mesh.sectors[23].box.size().y, 0);
    }
}

TEST(Sectors, AreCompactSoThatMostCanBeSkipped) {
    for (const scene::StaticSector& sector : stadium(20'000).mesh.sectors) {
        if (&sector - stadium(20'000).mesh.sectors.data() >= 22) break;
        EXPECT_LT(std::max(sector.box.size().x, sector.box.size().z), 70);
    }
}

TEST(Structures, VerticesAreAllUsed) {
    const StaticMesh& mesh = stadium(20'000).mesh;
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const std::uint32_t index : mesh.indices) used[index] = true;
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

// ---- People and structure ----

// Triangles by place, for the question of how near a body comes to one.
class Obstacles {
public:
    explicit Obstacles(const Stadium& of) {
        for (const Triangle& t : of.triangles) {
            if (Stadium::is_ground(t)) continue;
            const glm::vec3 low = glm::min(t.a, glm::min(t.b, t.c)), high = glm::max(t.a, glm::max(t.b, t.c));
            for (int x = cell(low.x - reach); x <= cell(high.x + reach); ++x)
                for (int z = cell(low.z - reach); z <= cell(high.z + reach); ++z) cells_[key(x, z)].push_back(t);
        }
    }

    // [m] sideways from the upright line at x, z between two heights to the nearest surface; at most `reach`.
    float clearance(glm::vec2 xz, float low, float high) const {
        float least = reach;
        const auto found = cells_.find(key(cell(xz.x), cell(xz.y)));
        if (found == cells_.end()) return least;
        for (const Triangle& t : found->second) {
            const std::vector<glm::vec3> slice = above(above({t.a, t.b, t.c}, low, 1), high, -1);
            bool inside = !slice.empty();
            int side = 0;
            float area = 0;
            for (std::size_t i = 0; i < slice.size(); ++i) {
                const glm::vec2 p(slice[i].x, slice[i].z),
                    q(slice[(i + 1) % slice.size()].x, slice[(i + 1) % slice.size()].z);
                const glm::vec2 along = q - p, to = xz - p;
                const float length2 = glm::dot(along, along);
                const float share = length2 > 0 ? std::clamp(glm::dot(to, along) / length2, 0.0f, 1.0f) : 0.0f;
                least = std::min(least, glm::distance(to, share * along));
                area += p.x * q.y - q.x * p.y;
                const int turn = along.x * to.y - along.y * to.x >= 0 ? 1 : -1;
                inside = inside && (side == 0 || turn == side);
                side = turn;
            }
            if (inside && std::abs(area) > 1e-6f) least = 0;  // not of a wall, which seen from above is a line
        }
        return least;
    }

private:
    static constexpr float reach = 0.5f;
    static int cell(float at) { return static_cast<int>(std::floor(at / 2)); }
    static std::int64_t key(int x, int z) { return std::int64_t{x} * 100'000 + z; }

    // The part of a convex polygon above a height, or below it for sign -1.
    static std::vector<glm::vec3> above(const std::vector<glm::vec3>& polygon, float height, float sign) {
        std::vector<glm::vec3> result;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
            const float at_p = sign * (p.y - height), at_q = sign * (q.y - height);
            if (at_p >= 0) result.push_back(p);
            if ((at_p < 0) != (at_q < 0)) result.push_back(glm::mix(p, q, at_p / (at_p - at_q)));
        }
        return result;
    }
    std::unordered_map<std::int64_t, std::vector<Triangle>> cells_;
};

TEST(People, AreNeverInsideTheStructure) {
    constexpr float shoulders = 0.25f;  // [m] half of a pair, of who stands free
    constexpr float chest = 0.14f;      // [m] half of its depth: a row's benches are as near as that
    constexpr float ankle = 0.1f, head = 1.7f, backrest = 0.82f, seated_head = 1.25f;  // [m] above the floor
    const tests::FakeCast cast = tests::sitters_and_standers();
    for (const std::int64_t people : {std::int64_t{45'000}, std::int64_t{140'000}}) {
        const Stadium& of = stadium(people);
        const Obstacles obstacles(of);
        const scene::Crowd crowd = scene::populate(of.plan, {people, cast.members, cast.poses, 1});
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            const glm::vec3 at = scene::place(crowd, i, cast.members[crowd.character[i]], 0).position;
            const bool watches = crowd.role[i] == scene::Role::spectator;
            if (watches && i % 9 != 0) continue;
            float low = at.y + ankle, high = at.y + head;
            if (watches && cast.members[crowd.character[i]].sits) {
                // Their origin is where the seat's surface puts it.
                const float scale = crowd.height[i] / cast.poses[crowd.character[i]].rest_height;
                const float floor = at.y + seat_height * (scale - 1);
                low = floor + backrest;
                high = floor + seated_head;
            }
            ASSERT_GT(obstacles.clearance({at.x, at.z}, low, high), watches ? chest : shoulders)
                << "person " << i << " of " << people << " at " << at.x << ' ' << at.y << ' ' << at.z;
        }
    }
}

TEST(People, SeeTheTrackPastAllThatIsBuilt) {
    constexpr float eye_height = 1.2f, focus = 8 * 1.22f / 2;  // [m]
    for (const std::int64_t people : {std::int64_t{8'000}, std::int64_t{1'000'000}}) {
        const Stadium& of = stadium(people);
        const Obstacles obstacles(of);
        for (std::size_t s = 0; s < of.plan.seats.size(); s += 211) {
            const scene::Seat& seat = of.plan.seats[s];
            const glm::vec3 eye = seat.position + glm::vec3(0, eye_height, 0);
            const glm::vec2 ahead(std::sin(seat.yaw), std::cos(seat.yaw));
            const float distance = of.plan.oval.offset_of({eye.x, eye.z}) - focus;
            // Along the line of sight in steps, each as an upright line that the line passes through.
            constexpr float step = 0.1f;  // [m]
            for (float gone = step; gone + step < distance; gone += step) {
                const float high = eye.y * (1 - gone / distance), low = eye.y * (1 - (gone + step) / distance);
                ASSERT_GT(obstacles.clearance(glm::vec2(eye.x, eye.z) + gone * ahead, low, high), 0.04f)
                    << "seat in row " << seat.row << " after " << gone << " m";
            }
        }
    }
}

}  // namespace
