#include "tests/bench/frame_errors.h"

#include <map>

#include "render/view.h"
#include "tests/bench/fidelity.h"
#include "tests/bench/flip.h"
#include "tests/bench/shooter.h"

namespace bench {

Errors errors_of(const render::Image& reference, const render::Image& test) {
    return {mean_flip_error(reference, test), psnr(reference, test), ssim(reference, test)};
}

std::size_t PresetErrors::chosen() const {
    for (std::size_t i = 0; i < native.size(); ++i)
        if (native[i].as_good_as(triangles)) return i;
    return native.size() - 1;
}

const PresetErrors& errors_of_preset(const std::string& name) {
    static std::map<std::string, PresetErrors> known;
    const auto [at, is_new] = known.try_emplace(name);
    PresetErrors& errors = at->second;
    if (!is_new) return errors;
    constexpr std::int64_t tick = 100;
    const scene::CameraPose pose = preset(name);
    const render::View view = render::make_view(pose, frame_width, frame_height);
    Shooting& here = stadium();
    const render::Image reference = bench::reference(here.gl, pose, frame_width, frame_height, tick);
    errors.triangles = errors_of(reference, here.gl.picture(view, bench::triangles(), tick));
    for (const double splat_size : tried_splat_sizes)
        errors.native.push_back(errors_of(reference, here.native.picture(view, points_of(splat_size), tick)));
    const render::Image empty = bench::reference(here.gl_nobody, pose, frame_width, frame_height, tick);
    errors.triangles_nobody = errors_of(empty, here.gl_nobody.picture(view, bench::triangles(), tick));
    errors.native_nobody = errors_of(empty, here.native_nobody.picture(view, bench::triangles(), tick));
    return errors;
}

}  // namespace bench
