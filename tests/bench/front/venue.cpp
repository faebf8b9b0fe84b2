#include "tests/bench/front/venue.h"

#include <stdexcept>

#include "apps/point_cache.h"
#include "tests/bench/front/digest.h"
#include "tests/bench/front/settings.h"

namespace bench::front {

namespace {

constexpr std::uint64_t seed = 1;

void add_crowd(Digest& digest, const scene::Crowd& crowd) {
    digest.add(crowd.position);
    digest.add(crowd.yaw);
    digest.add(crowd.height);
    digest.add(crowd.character);
    digest.add(crowd.role);
    digest.add(crowd.around);
    digest.add(crowd.hash);
    for (const scene::Palette& palette : crowd.palette) digest.add(std::as_bytes(std::span(&palette, 1)));
}

}  // namespace

Venue::Venue(std::int64_t people, Size size, bool with_opengl)
    : size_(size),
      stage_(apps::build_stage({}, people, seed, apps::PointCache(apps::default_cache()), figures::natively())),
      native_(stage_->place.structure, stage_->place.ground, stage_->place.light, stage_->figures(), size.width,
              size.height) {
    if (!with_opengl) return;
    gl_ = std::make_unique<render::gl::Renderer>(stage_->place.structure, stage_->place.ground, stage_->place.light,
                                                 stage_->figures(), size.width, size.height);
}

render::Renderer& Venue::renderer(sfsm::Drawing drawing) {
    if (drawing == sfsm::Drawing::native) return native_;
    if (!gl_) throw std::logic_error("a venue without OpenGL draws by it");
    return *gl_;
}

Shooter& Venue::shooter(sfsm::Drawing drawing, float density) {
    std::unique_ptr<Shooter>& kept = shooters_[{drawing, density}];
    if (!kept)
        kept = std::make_unique<Shooter>(renderer(drawing), stage_->place.crowd, *stage_, way_of(drawing), density);
    return *kept;
}

Shooter& Venue::nobody() {
    if (!nobody_) nobody_ = std::make_unique<Shooter>(native_, empty_, *stage_, figures::natively());
    return *nobody_;
}

const std::string& Venue::key() {
    if (key_.empty()) key_ = find_key();
    return key_;
}

// A close view of few people, and the structure from afar: whatever changes in how either is drawn shows in one of
// them.
std::string Venue::find_key() {
    constexpr Size small{320, 180};
    constexpr std::int64_t tick = 100;
    const auto view = [&](const char* preset) {
        return render::make_view(stage_->place.cameras.named(preset).at(0), small.width, small.height);
    };
    Digest digest;
    add_crowd(digest, stage_->place.crowd);
    for (const motion::PoseTable& poses : stage_->poses) digest.add(poses.vertices);
    digest.add(shooter(sfsm::Drawing::native).picture(view("close"), triangles(), tick).pixels);
    digest.add(nobody().picture(view("remote"), triangles(), tick).pixels);
    native_.resize(size_.width, size_.height);
    return digest.text();
}

}  // namespace bench::front
