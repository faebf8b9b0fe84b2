#include "tests/precision/people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "render/native/person_triangles.h"
#include "render/select.h"
#include "scene/gathering.h"
#include "scene/places/oval.h"
#include "sfsm/random.h"
#include "tests/reference/surface.h"

namespace precision {

namespace {

constexpr int standing = 24, walking = 24;  // people
constexpr double arm = 0.4;                 // [m] from a body's axis: what a turn moves

double unit(int number, int axis) {
    return static_cast<double>(sfsm::hash(static_cast<std::uint64_t>(number), static_cast<std::uint64_t>(axis)) >> 11) *
           0x1p-53;
}

// Half way around a bend, or along a straight, of the track's parallel `offset` [m] outward.
Party::Whereabouts on_track(const scene::Oval& oval, double arc, double offset) {
    const double pi = std::numbers::pi, half = oval.half_straight, radius = oval.radius + offset;
    const double half_lap = 2 * half + pi * radius;
    const double side = arc < half_lap ? 1 : -1, rest = arc < half_lap ? arc : arc - half_lap;
    if (rest <= 2 * half) return {{side * (rest - half), 0, side * radius}, side * pi / 2};
    const double angle = (rest - 2 * half) / radius;
    const glm::dvec2 outward = side * glm::dvec2(std::sin(angle), std::cos(angle));
    return {{side * half + radius * outward.x, 0, radius * outward.y}, std::atan2(outward.y, -outward.x)};
}

double yaw_of(const render::Turn& turn) {
    return std::atan2(turn.sin_yaw, turn.cos_yaw);
}

double apart(double yaw, double other) {
    return std::abs(std::remainder(yaw - other, 2 * std::numbers::pi));
}

glm::dvec3 turned(const glm::dvec3& v, double sine, double cosine) {
    return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x};
}

const motion::PoseTable& poses() {
    return cast_of_one().poses[0];
}

glm::dvec3 unpacked(const motion::PosedVertex& vertex) {
    const motion::Bounds& box = poses().box;
    return glm::dvec3(box.min) +
           glm::dvec3(vertex.x, vertex.y, vertex.z) / 65535.0 * (glm::dvec3(box.max) - glm::dvec3(box.min));
}

std::span<const motion::PosedVertex> posed(std::uint32_t pose) {
    const auto count = static_cast<std::size_t>(poses().vertex_count);
    return std::span(poses().vertices).subspan(pose * count, count);
}

const reference::Surface& skinned(const scene::Action& action) {
    static std::map<std::pair<int, std::int64_t>, reference::Surface> known;
    static const std::vector<int> clips = scene::cast(cast_of_one().person).clips;
    const auto [at, is_new] = known.try_emplace({action.clip, action.clip_tick});
    if (is_new)
        at->second = reference::surface_at(cast_of_one().person, clips[action.clip],
                                           static_cast<double>(action.clip_tick) / motion::ticks_per_second);
    return at->second;
}

// The frame's pixels of vertices, as render/native/person_triangles.cpp finds them.
std::vector<glm::dvec2> native_pixels(const render::View& view, const render::Person& person) {
    using namespace render::native;
    const auto vertices = posed(person.pose);
    const std::size_t room = (vertices.size() + group - 1) / group * group;
    std::vector<LitVertex> lit(room);
    std::vector<std::int32_t> across(room), down(room);
    const glm::vec3 to_sun(0, 1, 0);
    const auto placement = placement_of(view, to_sun, poses().box, person.instance);
    place_vertices(placement.value(), daylight_of({}), vertices, false, lit.data(), across.data(), down.data());
    constexpr double a_pixel = grid_per_sample * samples_across;
    std::vector<glm::dvec2> pixels;
    for (std::size_t i = 0; i < vertices.size(); ++i) pixels.emplace_back(across[i] / a_pixel, down[i] / a_pixel);
    return pixels;
}

// As shaders/person.glsl does, in float32.
glm::dvec2 opengl_pixel(const render::View& view, const render::Instance& instance, const motion::PosedVertex& vertex) {
    const motion::Bounds& box = poses().box;
    const glm::vec3 model = box.min + glm::vec3(vertex.x, vertex.y, vertex.z) / 65535.0f * box.size();
    const float sine = instance.turn.sin_yaw / 32767.0f, cosine = instance.turn.cos_yaw / 32767.0f;
    const glm::vec3 at = instance.position + instance.scale * glm::vec3(cosine * model.x + sine * model.z, model.y,
                                                                        cosine * model.z - sine * model.x);
    const glm::vec4 clip = view.clip_from_camera_relative * glm::vec4(at, 1.0f);
    const glm::vec2 ndc = glm::vec2(clip) / clip.w;
    return {0.5f * static_cast<float>(view.width) * (1 + ndc.x), 0.5f * static_cast<float>(view.height) * (1 - ndc.y)};
}

// Whom the frame has at that place.
const render::Person& person_at(const render::Frame& frame, const glm::dvec3& from_eye) {
    return *std::ranges::min_element(frame.people, {}, [&](const render::Person& person) {
        return glm::distance(glm::dvec3(person.instance.position), from_eye);
    });
}

// One person, seen.
struct Sitting {
    const Party& party;
    std::size_t person;
    const Setting& setting;
    Party::Whereabouts truth;
    Eye eye;
    render::View view;
    const render::Person& drawn;

    double metre() const { return setting.pixels_per_metre(setting.distance()); }  // [px]
    glm::dvec3 from_eye() const { return truth.at - eye.position; }
    double place_error() const {
        const double moved = glm::distance(glm::dvec3(drawn.instance.position), from_eye());
        return metre() * (moved + arm * apart(yaw_of(drawn.instance.turn), truth.yaw));
    }
};

double depth_error(const Sitting& sitting) {
    const double scale = sitting.party.crowd.height[sitting.person] / double(poses().rest_height);
    const double middle = scale * 0.5 * (double(poses().box.min.y) + double(poses().box.max.y));
    const double depth = sitting.eye.depth(sitting.from_eye() + glm::dvec3(0, middle, 0));
    return sitting.metre() * std::abs(double(sitting.drawn.depth) - depth);
}

void add_vertices(const Sitting& sitting, PeopleErrors& errors) {
    const render::Instance& instance = sitting.drawn.instance;
    const double scale = sitting.party.crowd.height[sitting.person] / double(poses().rest_height);
    const auto packed = posed(sitting.drawn.pose);
    const std::vector<glm::dvec2> native = native_pixels(sitting.view, sitting.drawn);
    const scene::Action action =
        scene::act(sitting.party.crowd, sitting.person, cast_of_one().cast[0], poses(), sitting.setting.tick);
    const reference::Surface& surface = skinned(action);
    for (std::size_t i = 0; i < packed.size(); ++i) {
        const glm::dvec3 model = unpacked(packed[i]);
        errors.skinning.add(sitting.metre() * scale * glm::distance(model, surface.positions[i]));
        const glm::dvec3 given =
            glm::dvec3(instance.position) +
            double(instance.scale) * turned(model, instance.turn.sin_yaw / 32767.0, instance.turn.cos_yaw / 32767.0);
        const glm::dvec2 pixel = sitting.eye.pixel(given);
        if (!sitting.eye.shows(pixel)) continue;
        errors.native.add(glm::distance(native[i], pixel));
        errors.opengl.add(glm::distance(opengl_pixel(sitting.view, instance, packed[i]), pixel));
        const glm::dvec3 whole =
            scale * turned(surface.positions[i], std::sin(sitting.truth.yaw), std::cos(sitting.truth.yaw));
        errors.all.add(glm::distance(native[i], sitting.eye.pixel(sitting.from_eye() + whole)));
    }
}

template <typename Look>
void for_each_sitting(const Setting& setting, const Party& party, std::size_t first, std::size_t count, Look look) {
    const std::vector<figures::Figure> figures = cast_of_one().figures();
    render::Selector selector(party.crowd, cast_of_one().cast, figures);
    for (std::size_t person = first; person < first + count; ++person) {
        const Party::Whereabouts truth = party.whereabouts(person, setting.tick);
        const scene::CameraPose pose = aim(setting, truth.at + glm::dvec3(0, 0.9, 0), static_cast<int>(person));
        const render::View view = render::make_view(pose, setting.width, setting.height);
        selector.survey(view, setting.tick);
        const render::Frame& frame = selector.select({}, setting.tick - 1);
        const glm::dvec3 from_eye = truth.at - pose.position;
        if (frame.people.empty()) continue;
        look(Sitting{party, person, setting, truth, Eye(pose, setting.width, setting.height), view,
                     person_at(frame, from_eye)});
    }
}

}  // namespace

const tests::SmallScene& cast_of_one() {
    static const tests::SmallScene scene(60);
    return scene;
}

Party::Party(const glm::dvec3& place) {
    constexpr double spread = 16;  // [m]
    scene::Gathering gathering({standing + walking, cast_of_one().cast, cast_of_one().poses, 1},
                               std::make_shared<scene::Oval>());
    gathering.open_block(place);
    for (int i = 0; i < standing; ++i) {
        const glm::dvec3 local(spread * (2 * unit(i, 0) - 1), 0.1 * spread * unit(i, 1), spread * (2 * unit(i, 2) - 1));
        const auto height = static_cast<float>(1.5 + 0.5 * unit(i, 3));
        gathering.add({.position = glm::vec3(local),
                       .yaw = static_cast<float>(2 * std::numbers::pi * unit(i, 4)),
                       .height = height,
                       .role = scene::Role::standing});
        stand_at.push_back(place + local - glm::dvec3(0, double(height) / poses().rest_height * poses().floor, 0));
    }
    gathering.close_block();
    gathering.open_block(place);
    for (int i = 0; i < walking; ++i)
        gathering.add({.position = {0.5f + 0.3f * static_cast<float>(i), 0, static_cast<float>(380 * unit(i, 5))},
                       .height = static_cast<float>(1.5 + 0.5 * unit(i, 6)),
                       .role = i % 2 == 0 ? scene::Role::walker : scene::Role::runner});
    gathering.close_block();
    crowd = std::move(gathering.crowd);
}

void Party::tell_from_afar(double away) {
    const glm::vec3 by(away * glm::dvec3(0.6, 0, 0.8));
    scene::CrowdBlock& block = crowd.blocks[0];
    block.origin -= glm::dvec3(by);
    block.box = {block.box.min + by - 1.0f, block.box.max + by + 1.0f};
    for (std::size_t i = 0; i < stand_at.size(); ++i) crowd.position[i] += by;
}

Party::Whereabouts Party::whereabouts(std::size_t person, std::int64_t tick) const {
    if (person < stand_at.size()) return {stand_at[person], crowd.yaw[person]};
    const glm::vec3 at = crowd.position[person];
    const auto role = static_cast<std::size_t>(crowd.role[person]);
    const long double speed = static_cast<long double>(cast_of_one().cast[0].gait_speed[role]) *
                              static_cast<long double>(crowd.height[person]) / 1.75L;
    const long double run = static_cast<long double>(at.z) + speed * static_cast<long double>(tick) / 60;
    const auto arc = static_cast<double>(std::fmod(run, static_cast<long double>(crowd.path->length(at.x))));
    Whereabouts where = on_track(dynamic_cast<const scene::Oval&>(*crowd.path), arc, at.x);
    where.at += crowd.blocks[1].origin + glm::dvec3(0, at.y, 0);
    return where;
}

PeopleErrors errors_of_people(const Setting& setting) {
    const Party party(setting.place());
    PeopleErrors errors;
    for_each_sitting(setting, party, 0, standing, [&](const Sitting& sitting) {
        errors.standing.add(sitting.place_error());
        errors.depth.add(depth_error(sitting));
        add_vertices(sitting, errors);
    });
    for_each_sitting(setting, party, standing, walking, [&](const Sitting& sitting) {
        errors.walking.add(sitting.place_error());
        errors.depth.add(depth_error(sitting));
        add_vertices(sitting, errors);
    });
    return errors;
}

Errors errors_of_standing(const Setting& setting, double away) {
    Party party(setting.place());
    party.tell_from_afar(away);
    Errors errors;
    for_each_sitting(setting, party, 0, standing, [&](const Sitting& sitting) { errors.add(sitting.place_error()); });
    return errors;
}

Errors errors_of_walking(const Setting& setting) {
    const Party party(setting.place());
    Errors errors;
    for_each_sitting(setting, party, standing, walking,
                     [&](const Sitting& sitting) { errors.add(sitting.place_error()); });
    return errors;
}

}  // namespace precision
