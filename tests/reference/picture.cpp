#include "tests/reference/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/reference/surroundings.h"

namespace reference {

namespace {

// Where a pixel is looked at, from its centre [px].
constexpr double off = 1.0 / 16;
constexpr std::array<glm::dvec2, 5> places = {glm::dvec2(0, 0), glm::dvec2(-off, -off), glm::dvec2(off, -off),
                                              glm::dvec2(-off, off), glm::dvec2(off, off)};

// Two surfaces so near to one another may be seen in either order: baked positions have 65,535 steps an axis.
double as_good_as_near(double depth) {
    return depth + 1e-3 + 1e-5 * depth;
}

// A normal so nearly at right angles to the ray may be taken to face either way: it is packed within 0.017 rad.
constexpr double edge_on = 0.02;

// What is seen where nobody is: structure, ground and sky.
struct Behind {
    Picture picture;
    std::vector<double> depth;  // [m] by pixel, then place
    std::vector<double> left;   // the same, of the colour as it is stored, where people stand around
};

// Two passes over everything: first how near the nearest is in each place, then who is that near.
class Canvas {
public:
    // `samples`: so many a pixel, across and down. `shift`: off every place, what is looked at there; it is shaded as
    // it is in the place.
    explicit Canvas(const Scene& scene, int samples = 1, glm::dvec2 shift = {})
        : scene_(scene), camera_(scene.camera), samples_(samples), shift_(shift) {
        camera_.width *= samples_;
        camera_.height *= samples_;
        const std::size_t pixels = static_cast<std::size_t>(camera_.width) * camera_.height;
        nearest_.assign(places.size() * pixels, INFINITY);
        picture_ = {camera_.width, camera_.height, std::vector<glm::dvec3>(pixels),
                    std::vector<std::vector<Shade>>(pixels), std::vector<bool>(pixels)};
    }

    Behind draw_behind() {
        for (const bool collecting : {false, true}) {
            collecting_ = collecting;
            if (scene_.structure) draw_structure();
        }
        draw_sky();
        return {std::move(picture_), std::move(nearest_), {}};
    }

    Picture draw_people(const Behind& behind) {
        for (const bool collecting : {false, true}) {
            collecting_ = collecting;
            for (const Person& person : scene_.people) person.points == 0 ? draw_mesh(person) : draw_splats(person);
            draw(behind);
        }
        return std::move(picture_);
    }

private:
    // Where on a triangle a place is: its corners' shares there, a pixel to the right and a pixel below.
    struct Spot {
        glm::dvec3 share, right, below;
        bool centre;  // of a pixel
        bool behind;  // seen from behind
    };

    enum class Existence { certain, uncertain, none };

    // Calls `shade(spot)` for each place that the triangle is nearest in.
    template <typename ShadeOf>
    void triangle(const std::array<glm::dvec3, 3>& corners, bool two_sided, ShadeOf shade) {
        triangle(
            corners, two_sided, [](const auto&) { return Existence::certain; }, shade);
    }

    // The same of a triangle of which there is only what `exists` says of a function that makes the spot.
    template <typename Exists, typename ShadeOf>
    void triangle(const std::array<glm::dvec3, 3>& corners, bool two_sided, Exists exists, ShadeOf shade) {
        // Homogeneous pixel coordinates: x and y times depth, and depth (Olano and Greer 1997). No corner need be in
        // front of the camera.
        std::array<glm::dvec3, 3> h;
        glm::dvec2 low(INFINITY), high(-INFINITY);
        bool behind = false;
        for (int i = 0; i < 3; ++i) {
            h[i] = homogeneous(corners[i]);
            behind |= h[i].z < Camera::near;
            low = glm::min(low, glm::dvec2(h[i]) / h[i].z);
            high = glm::max(high, glm::dvec2(h[i]) / h[i].z);
        }
        if (std::max({h[0].z, h[1].z, h[2].z}) < Camera::near) return;
        if (behind) low = {0, 0}, high = {camera_.width, camera_.height};
        if (high.x < -1 || high.y < -1 || low.x > camera_.width + 1 || low.y > camera_.height + 1) return;
        const double determinant = glm::dot(h[0], glm::cross(h[1], h[2]));
        // Pixels count downward, so counter-clockwise is negative.
        if (determinant == 0 || (determinant > 0 && !two_sided)) return;
        const std::array<glm::dvec3, 3> share = {glm::cross(h[1], h[2]) / determinant,
                                                 glm::cross(h[2], h[0]) / determinant,
                                                 glm::cross(h[0], h[1]) / determinant};
        const auto at = [&](double x, double y) {
            const glm::dvec3 pixel(x, y, 1);
            return glm::dvec3(glm::dot(share[0], pixel), glm::dot(share[1], pixel), glm::dot(share[2], pixel));
        };
        for_each_pixel(low, high, [&](int x, int y) {
            for (std::size_t place = 0; place < places.size(); ++place) {
                const double px = x + 0.5 + places[place].x, py = y + 0.5 + places[place].y;
                const glm::dvec3 over_depth = at(px + shift_.x, py + shift_.y);
                if (over_depth.x < 0 || over_depth.y < 0 || over_depth.z < 0) continue;
                const double depth = 1 / (over_depth.x + over_depth.y + over_depth.z);
                if (!(depth >= Camera::near)) continue;
                const auto spot = [&] {
                    const auto share_at = [&](double sx, double sy) {
                        const glm::dvec3 there = at(sx, sy);
                        return there / (there.x + there.y + there.z);
                    };
                    return Spot{share_at(px, py), share_at(px + 1, py), share_at(px, py + 1), place == 0,
                                determinant > 0};
                };
                const Existence existence = exists(spot);
                if (existence == Existence::none) continue;
                put(x, y, place, depth, existence == Existence::certain, [&] { return shade(spot()); });
            }
        });
    }

    // x, y [px] times depth, and depth [m].
    glm::dvec3 homogeneous(const glm::dvec3& relative) const {
        const double depth = glm::dot(relative, camera_.forward);
        const double x = glm::dot(relative, camera_.right) / camera_.tan_x;
        const double y = glm::dot(relative, camera_.up) / camera_.tan_y;
        return {(depth + x) * camera_.width / 2, (depth - y) * camera_.height / 2, depth};
    }

    template <typename Visit>
    void for_each_pixel(glm::dvec2 low, glm::dvec2 high, Visit visit) const {
        const auto from = [](double v, int size) {
            return static_cast<int>(std::clamp(std::floor(v - 1), 0.0, 1.0 * size));
        };
        const auto to = [](double v, int size) {
            return static_cast<int>(std::clamp(std::ceil(v + 1), 0.0, 1.0 * size));
        };
        for (int y = from(low.y, camera_.height); y < to(high.y, camera_.height); ++y)
            for (int x = from(low.x, camera_.width); x < to(high.x, camera_.width); ++x) visit(x, y);
    }

    // What is not certain to be there hides nothing.
    template <typename ShadeOf>
    void put(int x, int y, std::size_t place, double depth, bool certain, ShadeOf shade) {
        const std::size_t pixel = static_cast<std::size_t>(y) * camera_.width + x;
        double& nearest = nearest_[pixel * places.size() + place];
        if (!collecting_) {
            if (certain) nearest = std::min(nearest, depth);
            return;
        }
        if (depth > as_good_as_near(nearest)) return;
        const Shade shown = shade();
        add(pixel, shown);
        if (place == 0 && depth <= nearest) picture_.colors[pixel] = shown.best;
    }

    void add(std::size_t pixel, const Shade& shade) {
        constexpr double same = 0.25;  // [of 255]
        for (Shade& known : picture_.shades[pixel]) {
            const glm::dvec3 low = glm::min(known.low, shade.low), high = glm::max(known.high, shade.high);
            if (glm::any(glm::greaterThan(known.low - low, glm::dvec3(same)))) continue;
            if (glm::any(glm::greaterThan(high - known.high, glm::dvec3(same)))) continue;
            return;
        }
        picture_.shades[pixel].push_back(shade);
    }

    // The model's axes in the world: what faces +z there faces (sin yaw, 0, cos yaw).
    static glm::dmat3 axes_of(const Person& person) {
        const glm::dvec3 ahead(std::sin(person.yaw), 0, std::cos(person.yaw)), up(0, 1, 0);
        return {glm::cross(up, ahead), up, ahead};
    }

    static glm::dvec3 linear(const glm::u8vec4& color) {
        const glm::dvec3 code = glm::dvec3(color) / 255.0;
        return code * code;
    }

    static glm::dvec3 tint_of(const Person& person, std::size_t slot) {
        return slot == 0 ? glm::dvec3(1) : linear(person.palette.colors[slot - 1]);
    }

    // Light on a point; of a surface that is seen from both sides, on the side that is seen.
    static Shade light_seen(const glm::dvec3& normal, const glm::dvec3& at, bool both_sides) {
        const double facing = -glm::dot(normal, glm::normalize(at));
        const glm::dvec3 front = light_on(normal), back = light_on(-normal);
        if (!both_sides || facing > edge_on) return Shade::exactly(front);
        if (facing < -edge_on) return Shade::exactly(back);
        return Shade::between(glm::min(front, back), glm::max(front, back));
    }

    // In sRGB's code, where it is a texture's factor.
    static glm::dvec3 emission_of(const model::Material& material) {
        if (material.unlit) return glm::dvec3(0);
        const auto code = [](double light) {
            return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
        };
        return {code(material.emissive.r), code(material.emissive.g), code(material.emissive.b)};
    }

    // What is seen of a surface whose colour is in part the same in any light.
    static Shade partly(double unlit, const Shade& light) {
        const auto seen = [&](const glm::dvec3& by) { return glm::mix(by, glm::dvec3(1), unlit); };
        return {seen(light.low), seen(light.high), seen(light.best)};
    }

    void draw_mesh(const Person& person) {
        const model::Mesh& mesh = person.figure->mesh();
        const Surface& surface = person.figure->pose(person.slot, person.tick);
        const glm::dmat3 axes = axes_of(person);
        const glm::dvec3 origin = person.origin - camera_.position;
        std::vector<glm::dvec3> at, albedo;
        std::array<std::vector<Shade>, 2> light;  // seen from before and from behind
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            at.push_back(origin + person.scale * (axes * surface.positions[v]));
            albedo.push_back(linear(mesh.colors[v]) * tint_of(person, mesh.slots[v]));
            const model::Material& material = mesh.materials[mesh.material_ids[v]];
            const glm::dvec3 normal = axes * surface.normals[v];
            for (const bool behind : {false, true})
                light[behind].push_back(partly(material.unlit, Shade::exactly(light_on(behind ? -normal : normal))));
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            const model::Material& material = mesh.materials[mesh.material_ids[c]];
            const auto blend = [](const auto& x, const auto& y, const auto& z, const glm::dvec3& by) {
                return by.x * x + by.y * y + by.z * z;
            };
            const auto texel_at = [&](const Spot& spot, std::uint8_t texture) -> Texel {
                if (texture == model::no_texture) return {glm::dvec4(1), glm::dvec4(1)};
                const auto uv = [&](const glm::dvec3& by) {
                    return blend(glm::dvec2(mesh.uvs[a]), glm::dvec2(mesh.uvs[b]), glm::dvec2(mesh.uvs[c]), by);
                };
                const glm::dvec2 here = uv(spot.share);
                return texels(mesh, texture, material.sampler, here, uv(spot.right) - here, uv(spot.below) - here);
            };
            const auto exists = [&](const auto& spot_of) {
                if (!(material.alpha_cutoff > 0)) return Existence::certain;
                const Spot spot = spot_of();
                const Texel texel = texel_at(spot, material.texture);
                const double own =
                    blend(mesh.colors[a].a / 255.0, mesh.colors[b].a / 255.0, mesh.colors[c].a / 255.0, spot.share);
                constexpr double uncertain = 0.02;  // texels are blended in steps of 1 / 256
                const double cutoff = static_cast<double>(material.alpha_cutoff);
                if (own * texel.high.a < cutoff - uncertain) return Existence::none;
                return own * texel.low.a < cutoff + uncertain ? Existence::uncertain : Existence::certain;
            };
            triangle({at[a], at[b], at[c]}, material.double_sided, exists, [&](const Spot& spot) {
                const Texel texel = texel_at(spot, material.texture);
                const glm::dvec3 low(texel.low), high(texel.high);
                const glm::dvec3 emission = emission_of(material);
                const Texel shown = emission == glm::dvec3(0) ? Texel{} : texel_at(spot, material.emissive_texture);
                const glm::dvec3 least = emission * glm::dvec3(shown.low), most = emission * glm::dvec3(shown.high);
                const glm::dvec3 own = blend(albedo[a], albedo[b], albedo[c], spot.share);
                const std::vector<Shade>& by = light[spot.behind];
                return Shade::between(
                    stored(own * low * low * blend(by[a].low, by[b].low, by[c].low, spot.share) + least * least),
                    stored(own * high * high * blend(by[a].high, by[b].high, by[c].high, spot.share) + most * most));
            });
        }
    }

    // A texture's mipmaps: square, a power of two, as large as the figure's largest, each half the one before.
    struct Level {
        int side;
        std::vector<glm::dvec4> texels;  // [0, 1] as stored
        const glm::dvec4& own(int x, int y) const { return texels[static_cast<std::size_t>(y) * side + x]; }
        // What is shown in the place of a texel that there may not be.
        int shown(model::Wrap wrap, int v) const {
            if (wrap == model::Wrap::clamp) return std::clamp(v, 0, side - 1);
            const int period = wrap == model::Wrap::mirror ? 2 * side : side, within = (v % period + period) % period;
            return within < side ? within : period - 1 - within;
        }
        // The nearest, or between the four texels whose middles surround it; v counts from the top row.
        glm::dvec4 seen(const model::Sampler& sampler, const glm::dvec2& uv) const {
            const auto at = [&](int x, int y) { return own(shown(sampler.across, x), shown(sampler.down, y)); };
            if (sampler.nearest)
                return at(static_cast<int>(std::floor(uv.x * side)), static_cast<int>(std::floor(uv.y * side)));
            const double x = uv.x * side - 0.5, y = uv.y * side - 0.5;
            const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
            return glm::mix(glm::mix(at(left, top), at(left + 1, top), x - left),
                            glm::mix(at(left, top + 1), at(left + 1, top + 1), x - left), y - top);
        }
    };

    static std::vector<Level> levels_of(const model::Mesh& mesh, int id) {
        constexpr int largest_side = 1024;
        int side = 1;
        for (const model::Texture& texture : mesh.textures)
            while (side < std::max(texture.width, texture.height) && side < largest_side) side *= 2;
        const model::Texture& texture = mesh.textures[static_cast<std::size_t>(id)];
        Level level{side, {}};
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const int x0 = x * texture.width / side, x1 = std::max(x0 + 1, (x + 1) * texture.width / side);
                const int y0 = y * texture.height / side, y1 = std::max(y0 + 1, (y + 1) * texture.height / side);
                glm::dvec4 sum(0);
                for (int v = y0; v < y1; ++v)
                    for (int u = x0; u < x1; ++u)
                        sum += glm::dvec4(texture.texels[static_cast<std::size_t>(v) * texture.width + u]) / 255.0;
                level.texels.push_back(sum / (1.0 * (x1 - x0) * (y1 - y0)));
            }
        }
        std::vector<Level> levels{level};
        while (levels.back().side > 1) {
            const Level& finer = levels.back();
            Level coarser{finer.side / 2, {}};
            for (int y = 0; y < coarser.side; ++y)
                for (int x = 0; x < coarser.side; ++x)
                    coarser.texels.push_back((finer.own(2 * x, 2 * y) + finer.own(2 * x + 1, 2 * y) +
                                              finer.own(2 * x, 2 * y + 1) + finer.own(2 * x + 1, 2 * y + 1)) /
                                             4.0);
            levels.push_back(coarser);
        }
        return levels;
    }

    struct Texel {
        glm::dvec4 low, high;
    };

    // The mipmap is the one whose texels are nearest to pixels in size. Drivers measure that as they like, within a
    // factor of the square root of two.
    Texel texels(const model::Mesh& mesh, int id, const model::Sampler& sampler, const glm::dvec2& uv,
                 const glm::dvec2& per_x, const glm::dvec2& per_y) {
        std::vector<Level>& levels = mipmaps_[{&mesh, id}];
        if (levels.empty()) levels = levels_of(mesh, id);
        const int last = static_cast<int>(levels.size()) - 1;
        const double side = levels[0].side;
        const double shortest = std::log2(side * std::max(glm::length(per_x), glm::length(per_y)) / std::sqrt(2.0));
        const double longest = std::log2(side * (glm::length(per_x) + glm::length(per_y)));
        const int from = static_cast<int>(std::clamp(std::round(shortest - 0.1), 0.0, 1.0 * last));
        const int to = static_cast<int>(std::clamp(std::round(longest + 0.1), 0.0, 1.0 * last));
        constexpr double uv_steps = 1.0 / 2048;  // half floats have eleven bits
        Texel shown{glm::dvec4(INFINITY), glm::dvec4(-INFINITY)};
        for (int level = from; level <= to; ++level) {
            for (const glm::dvec2& shift : places) {
                const glm::dvec4 texel = levels[static_cast<std::size_t>(level)].seen(
                    sampler, uv + shift / off * (uv_steps * glm::max(glm::abs(uv), glm::dvec2(0.25))));
                shown.low = glm::min(shown.low, texel);
                shown.high = glm::max(shown.high, texel);
            }
        }
        return shown;
    }

    void draw_splats(const Person& person) {
        constexpr std::size_t few = 8;  // none of so few may happen to face the camera: they are seen from behind too
        const model::Mesh& mesh = person.figure->mesh();
        const Surface& surface = person.figure->pose(person.slot, person.tick);
        const std::vector<Figure::Look>& looks = person.figure->looks(person.points);
        const glm::dmat3 axes = axes_of(person);
        for (std::size_t p = 0; p < person.points; ++p) {
            const motion::SurfacePoint& spot = person.figure->points().surface[p];
            const std::uint32_t last = mesh.indices[3 * std::size_t{spot.triangle} + 2];
            const bool both_sides = mesh.material_of(last).double_sided || person.points <= few;
            glm::dvec3 position(0), normal(0);
            const double share[] = {1.0 - spot.u - spot.v, spot.u, spot.v};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = mesh.indices[3 * std::size_t{spot.triangle} + corner];
                position += share[corner] * surface.positions[vertex];
                normal += share[corner] * surface.normals[vertex];
            }
            const glm::dvec3 at = person.origin - camera_.position + person.scale * (axes * position);
            const glm::dvec3 facing = axes * glm::normalize(normal);
            const double away = glm::dot(facing, glm::normalize(at));
            if (!both_sides && away > edge_on) continue;
            glm::dvec3 tint(0);
            for (std::size_t slot = 0; slot <= model::slot_count; ++slot)
                tint += looks[p].slots[slot] * tint_of(person, slot);
            const Shade light = partly(looks[p].unlit, light_seen(facing, at, both_sides));
            splat(person, at, both_sides || away < -edge_on,
                  Shade::between(stored(looks[p].albedo * tint * light.low + looks[p].emitted),
                                 stored(looks[p].albedo * tint * light.high + looks[p].emitted)));
        }
    }

    // A square around the point's place in the picture, S pixels wide but no wider than a square as large as the
    // person, of whom a quarter of the surface is seen.
    void splat(const Person& person, const glm::dvec3& at, bool certain, const Shade& shade) {
        const glm::dvec3 h = homogeneous(at);
        if (h.z < Camera::near) return;
        const glm::dvec2 middle = glm::dvec2(h) / h.z;
        const double whole = std::sqrt(person.figure->area() / 4) * person.scale * camera_.pixels_per_metre(h.z);
        const double side = std::clamp(whole, 1.0, std::max(1.0, scene_.splat_size));
        // Software rasterisers round squares to whole pixels.
        constexpr double exact = 1e-3;
        // Each square is snapped by itself: two whose edges meet may overlap, or leave a line open between them.
        const double least = std::floor(side + exact) / 2 - off, most = std::ceil(side - exact) / 2 + off;
        for_each_pixel(middle - most, middle + most, [&](int x, int y) {
            const glm::dvec2 away = glm::abs(glm::dvec2(x + 0.5, y + 0.5) - middle);
            const double reach = std::max(away.x, away.y);
            if (reach >= most) return;
            for (std::size_t place = 0; place < places.size(); ++place)
                put(x, y, place, h.z, certain && reach < least, [&] { return shade; });
        });
    }

    void draw_structure() {
        const scene::StaticMesh& mesh = *scene_.structure;
        const glm::dvec3 eye = camera_.position - mesh.origin;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const scene::StaticVertex* corner[3];
            for (std::size_t k = 0; k < 3; ++k) corner[k] = &mesh.vertices[mesh.indices[i + k]];
            std::array<glm::dvec3, 3> at;
            for (std::size_t k = 0; k < 3; ++k) at[k] = glm::dvec3(corner[k]->position) - eye;
            const bool is_ground = corner[2]->color.a == static_cast<std::uint8_t>(scene::Surface::ground);
            const glm::dvec3 painted = stored(linear(corner[2]->color) * light_on(corner[2]->normal, corner[2]->open));
            triangle(at, false, [&](const Spot& spot) {
                if (!is_ground) return Shade::exactly(painted);
                const auto xz = [&](const glm::dvec3& by) {
                    const glm::dvec3 place = eye + by.x * at[0] + by.y * at[1] + by.z * at[2];
                    return glm::dvec2(place.x, place.z);
                };
                const glm::dvec2 here = xz(spot.share);
                const glm::dvec2 to_right = xz(spot.right) - here, to_below = xz(spot.below) - here;
                const glm::dvec2 footprint = glm::abs(to_right) + glm::abs(to_below);
                Shade shown = ground(scene_, here, footprint_share * std::max(footprint.x, footprint.y));
                if (spot.centre) shown.best = ground_seen(scene_, here, to_right, to_below);
                return shown;
            });
        }
    }

    // How far a line's fading may reach, in footprints of a pixel.
    static constexpr double footprint_share = 1.5;

    void draw_sky() {
        for (int y = 0; y < camera_.height; ++y) {
            for (int x = 0; x < camera_.width; ++x) {
                const std::size_t pixel = static_cast<std::size_t>(y) * camera_.width + x;
                picture_.sky[pixel] = picture_.shades[pixel].empty();
                for (std::size_t place = 0; place < places.size(); ++place) {
                    if (nearest_[pixel * places.size() + place] < INFINITY) continue;
                    const Shade shown = sky(camera_.ray(x + 0.5 + places[place].x, y + 0.5 + places[place].y));
                    add(pixel, shown);
                    if (place == 0) picture_.colors[pixel] = shown.best;
                }
            }
        }
    }

    void draw(const Behind& behind) {
        for (int y = 0; y < camera_.height; ++y)
            for (int x = 0; x < camera_.width; ++x) {
                const std::size_t pixel = static_cast<std::size_t>(y) * camera_.width + x;
                const std::size_t there = static_cast<std::size_t>(y / samples_) * behind.picture.width + x / samples_;
                if (collecting_) picture_.sky[pixel] = picture_.shades[pixel].empty() && behind.picture.sky[there];
                for (std::size_t place = 0; place < places.size(); ++place)
                    for (const Shade& shade : behind.picture.shades[there]) {
                        const double left = behind.left[there * places.size() + place];
                        const Shade shown{left * shade.low, left * shade.high, left * behind.picture.colors[there]};
                        put(x, y, place, behind.depth[there * places.size() + place], true, [&] { return shown; });
                    }
            }
    }

    const Scene& scene_;
    Camera camera_;  // of samples
    int samples_;
    glm::dvec2 shift_;
    bool collecting_ = false;
    std::vector<double> nearest_;  // [m] by pixel, then place
    std::map<std::pair<const model::Mesh*, int>, std::vector<Level>> mipmaps_;
    Picture picture_;
};

double beyond(const Shade& shade, const glm::dvec3& color) {
    const glm::dvec3 by = glm::max(glm::max(shade.low - color, color - shade.high), glm::dvec3(0));
    return std::max({by.x, by.y, by.z});
}

glm::dvec3 light_of(const glm::dvec3& code) {
    return code / 255.0 * (code / 255.0);
}

// Each pixel the mean light of side x side.
Picture filtered(const Picture& fine, int side) {
    Picture picture{fine.width / side, fine.height / side, {}, {}, {}};
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            glm::dvec3 low(0), high(0), best(0);
            bool sky = true;
            for (int i = 0; i < side * side; ++i) {
                const std::size_t sample =
                    static_cast<std::size_t>(side * y + i / side) * fine.width + side * x + i % side;
                glm::dvec3 least(INFINITY), most(-INFINITY);
                for (const Shade& shade : fine.shades[sample]) {
                    least = glm::min(least, shade.low);
                    most = glm::max(most, shade.high);
                }
                low += light_of(least) / (1.0 * side * side);
                high += light_of(most) / (1.0 * side * side);
                best += light_of(fine.colors[sample]) / (1.0 * side * side);
                sky = sky && fine.sky[sample];
            }
            picture.colors.push_back(stored(best));
            picture.shades.push_back({{stored(low), stored(high), stored(best)}});
            picture.sky.push_back(sky);
        }
    }
    return picture;
}

// Of four samples in a pixel, in a square that is turned: the mean of their light, and the second farthest's depth.
Behind draw_smoothly(const Scene& scene) {
    constexpr std::array<glm::dvec2, 4> samples = {glm::dvec2(-1, -3) / 8.0, glm::dvec2(3, -1) / 8.0,
                                                   glm::dvec2(-3, 1) / 8.0, glm::dvec2(1, 3) / 8.0};
    std::array<Behind, 4> of;
    for (std::size_t i = 0; i < samples.size(); ++i) of[i] = Canvas(scene, 1, samples[i]).draw_behind();
    // Side by side, a pixel's four make it.
    const int width = scene.camera.width, height = scene.camera.height;
    Picture fine{2 * width, 2 * height, {}, {}, {}};
    for (int y = 0; y < 2 * height; ++y)
        for (int x = 0; x < 2 * width; ++x) {
            const Picture& from = of[static_cast<std::size_t>(2 * (y % 2) + x % 2)].picture;
            const std::size_t pixel = static_cast<std::size_t>(y / 2) * width + x / 2;
            fine.colors.push_back(from.colors[pixel]);
            fine.shades.push_back(from.shades[pixel]);
            fine.sky.push_back(from.sky[pixel]);
        }
    Behind behind{filtered(fine, 2), {}, {}};
    for (std::size_t i = 0; i < of[0].depth.size(); ++i) {
        std::array<double, 4> depths = {of[0].depth[i], of[1].depth[i], of[2].depth[i], of[3].depth[i]};
        std::sort(depths.begin(), depths.end());
        behind.depth.push_back(depths[2]);
    }
    return behind;
}

// Where people stand: a soft dark round, as large as they say, weaker where it is small in the picture.
void darken(const Scene& scene, Behind& behind) {
    constexpr double strength = 0.55, whole = 4, least = 1.5;  // [px]
    struct Round {
        glm::dvec3 middle;
        double radius, strength;
    };
    const Camera& camera = scene.camera;
    std::vector<Round> rounds;
    for (const Person& person : scene.people) {
        const double depth = std::max(glm::dot(person.origin - camera.position, camera.forward), Camera::near);
        const double pixels = person.shade * camera.pixels_per_metre(depth);
        const double share = scene.fades_shade ? std::clamp((pixels - least) / (whole - least), 0.0, 1.0) : 1.0;
        if (person.shade > 0 && share > 0) rounds.push_back({person.origin, person.shade, strength * share});
    }
    behind.left.assign(behind.depth.size(), 1);
    for (std::size_t i = 0; i < behind.depth.size(); ++i) {
        if (behind.depth[i] == INFINITY) continue;
        const std::size_t pixel = i / places.size(), width = static_cast<std::size_t>(camera.width);
        const glm::dvec2 at = glm::dvec2(pixel % width, pixel / width) + 0.5 + places[i % places.size()];
        const glm::dvec3 there = camera.position + behind.depth[i] * camera.ray(at.x, at.y);
        for (const Round& round : rounds) {
            const double out = glm::length(there - round.middle) / round.radius;
            if (out < 1) behind.left[i] *= 1 - round.strength * std::pow(1 - out * out, 2);
        }
    }
}

}  // namespace

Picture draw(const Scene& scene) {
    Behind behind = scene.samples == 1 ? Canvas(scene).draw_behind() : draw_smoothly(scene);
    darken(scene, behind);
    if (scene.samples == 1) return Canvas(scene).draw_people(behind);
    return filtered(Canvas(scene, scene.samples).draw_people(behind), scene.samples);
}

render::Image Picture::image() const {
    render::Image image{width, height, {}};
    for (const glm::dvec3& color : colors)
        for (int channel = 0; channel < 3; ++channel)
            image.pixels.push_back(static_cast<std::uint8_t>(std::lround(color[channel])));
    return image;
}

double distance(const render::Image& image, const Picture& picture, int x, int y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * picture.width + x;
    const std::uint8_t* rgb = &image.pixels[3 * pixel];
    double least = INFINITY;
    for (const Shade& shade : picture.shades[pixel])
        least = std::min(least, beyond(shade, glm::dvec3(rgb[0], rgb[1], rgb[2])));
    return least;
}

double mean_error(const render::Image& image, const Picture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.colors.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            sum += std::abs(image.pixels[3 * i + channel] - picture.colors[i][channel]);
    return sum / (3.0 * static_cast<double>(picture.colors.size()));
}

double worst_mean(const render::Image& image, const Picture& picture, int side) {
    double worst = 0;
    for (int top = 0; top + side <= picture.height; top += side) {
        for (int left = 0; left + side <= picture.width; left += side) {
            glm::dvec3 error(0);
            for (int i = 0; i < side * side; ++i) {
                const std::size_t pixel = static_cast<std::size_t>(top + i / side) * picture.width + left + i % side;
                const std::uint8_t* rgb = &image.pixels[3 * pixel];
                error += (glm::dvec3(rgb[0], rgb[1], rgb[2]) - picture.colors[pixel]) / (1.0 * side * side);
            }
            worst = std::max({worst, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
        }
    }
    return worst;
}

Comparison compare(const render::Image& image, const Picture& picture) {
    Comparison result;
    result.pixels = picture.width * picture.height;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::vector<Shade>& shades = picture.shades[static_cast<std::size_t>(y) * picture.width + x];
            glm::dvec3 low(INFINITY), high(-INFINITY);
            for (const Shade& shade : shades) {
                low = glm::min(low, shade.low);
                high = glm::max(high, shade.high);
            }
            const glm::dvec3 spread = high - low;
            const bool plain = std::max({spread.x, spread.y, spread.z}) < tolerance;
            const double error = distance(image, picture, x, y);
            const bool sky = picture.sky[static_cast<std::size_t>(y) * picture.width + x];
            result.plain += plain;
            result.surface += !sky;
            result.plain_surface += plain && !sky;
            result.wrong += error > tolerance;
            result.wrong_plain += plain && error > tolerance;
            result.mean += error / result.pixels;
            if (error <= result.worst) continue;
            result.worst = error;
            result.worst_x = x;
            result.worst_y = y;
        }
    }
    return result;
}

std::string Comparison::text() const {
    char line[240];
    std::snprintf(
        line, sizeof line,
        "%d of %d pixels wrong, %d of the %d plain ones, worst by %.0f of 255 at (%d, %d), mean %.3f; surface in "
        "%d, plain in %d",
        wrong, pixels, wrong_plain, plain, worst, worst_x, worst_y, mean, surface, plain_surface);
    return line;
}

}  // namespace reference
