#include "tests/bench/shooter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/bench/fidelity.h"

namespace bench {

sfsm::Decision triangles() {
    return {};
}

sfsm::Decision points_of(double splat_size) {
    constexpr double everywhere = 1e9;  // [m]
    return splat_size > 0 ? sfsm::Decision{sfsm::State::points, everywhere, splat_size} : triangles();
}

namespace {

render::SelectOptions options_of(const figures::Way& way, float density) {
    render::SelectOptions options;
    options.density = density;
    options.way = &way;
    return options;
}

}  // namespace

Shooter::Shooter(render::Renderer& renderer, const scene::Crowd& crowd, const apps::Stage& stage,
                 const figures::Way& way, float density)
    : renderer_(renderer),
      selector_(crowd, stage.cast, stage.figures(), options_of(way, density)),
      needs_finish_(way.drawing == sfsm::Drawing::opengl) {}

const render::Survey& Shooter::survey(const render::View& view, std::int64_t tick) {
    return selector_.survey(view, tick, renderer_.begin(view));
}

const render::Frame& Shooter::select(const sfsm::Decision& decision, std::int64_t tick) {
    return selector_.select(decision, tick - 1);
}

const render::Frame& Shooter::select(const render::DrawingRule& rule, std::int64_t tick) {
    return selector_.select(rule, tick - 1);
}

const render::Frame& Shooter::choose(const render::View& view, const sfsm::Decision& decision, std::int64_t tick) {
    survey(view, tick);
    return select(decision, tick);
}

void Shooter::draw(const render::Frame& frame) {
    renderer_.draw(frame);
    if (needs_finish_) glFinish();
}

const render::Frame& Shooter::shoot(const render::View& view, const sfsm::Decision& decision, std::int64_t tick) {
    const render::Frame& frame = choose(view, decision, tick);
    draw(frame);
    return frame;
}

render::Image Shooter::picture(const render::View& view, const sfsm::Decision& decision, std::int64_t tick) {
    renderer_.resize(view.width, view.height);
    shoot(view, decision, tick);
    return renderer_.read_image();
}

Shooting::Shooting(const apps::Stage& shown, const scene::Crowd& crowd, const scene::StaticMesh& structure,
                   const scene::Ground& ground, const scene::Light& light)
    : stage(shown),
      native_renderer(structure, ground, light, stage.figures(), frame_width, frame_height),
      gl_renderer(structure, ground, light, stage.figures(), frame_width, frame_height),
      native(native_renderer, crowd, stage, figures::natively()),
      native_nobody(native_renderer, nobody, stage, figures::natively()),
      gl(gl_renderer, crowd, stage, figures::by_opengl()),
      gl_nobody(gl_renderer, nobody, stage, figures::by_opengl()) {}

render::Image reference(Shooter& gl, const scene::CameraPose& pose, int width, int height, std::int64_t tick) {
    const render::View view = render::make_view(pose, reference_factor * width, reference_factor * height);
    return box_filtered(gl.picture(view, triangles(), tick), reference_factor);
}

Shooting& stadium() {
    constexpr std::int64_t people = 20000;
    constexpr std::uint64_t seed = 1;
    static const render::gl::HeadlessContext context;
    static const std::unique_ptr<apps::Stage> stage =
        apps::build_stage({}, people, seed, apps::PointCache(apps::default_cache()), figures::natively());
    const scene::Place& place = stage->place;
    static Shooting shooting(*stage, place.crowd, place.structure, place.ground, place.light);
    return shooting;
}

scene::CameraPose preset(std::string_view name) {
    return stadium().stage.place.cameras.named(name).at(0);
}

scene::CameraPose panned(scene::CameraPose pose, double pixels, int height) {
    const glm::dvec3 ahead = pose.target - pose.position;
    const double angle = pixels * 2 * std::tan(0.5 * pose.fov_y) / height;  // [rad]
    const double c = std::cos(angle), s = std::sin(angle);
    pose.target = pose.position + glm::dvec3(c * ahead.x + s * ahead.z, ahead.y, c * ahead.z - s * ahead.x);
    return pose;
}

scene::Crowd some_of(const scene::Crowd& crowd, std::uint32_t first, std::uint32_t count) {
    scene::Crowd some;
    const auto copy = [&](const auto& from, auto& to) {
        to.assign(from.begin() + first, from.begin() + first + count);
    };
    copy(crowd.position, some.position);
    copy(crowd.yaw, some.yaw);
    copy(crowd.height, some.height);
    copy(crowd.character, some.character);
    copy(crowd.role, some.role);
    copy(crowd.around, some.around);
    copy(crowd.hash, some.hash);
    copy(crowd.palette, some.palette);
    some.path = crowd.path;
    scene::CrowdBlock block{0, count, {}};
    for (const scene::CrowdBlock& one : crowd.blocks)
        if (one.first <= first && first < one.first + one.count) block = {0, count, one.box, one.origin};
    some.blocks = {block};
    return some;
}

scene::CrowdBlock seated_block(const scene::Crowd& crowd) {
    constexpr int wanted = 200;
    const auto all_sit = [&](const scene::CrowdBlock& block) {
        return std::all_of(crowd.role.begin() + block.first, crowd.role.begin() + block.first + block.count,
                           [](scene::Role role) { return role == scene::Role::spectator; });
    };
    scene::CrowdBlock best;
    for (const scene::CrowdBlock& block : crowd.blocks) {
        const auto off = [](const scene::CrowdBlock& one) { return std::abs(static_cast<int>(one.count) - wanted); };
        if (all_sit(block) && off(block) < off(best)) best = block;
    }
    return best;
}

}  // namespace bench
