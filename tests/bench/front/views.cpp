#include "tests/bench/front/views.h"

#include <cmath>
#include <stdexcept>

#include "motion/schedule.h"
#include "tests/bench/shooter.h"

namespace bench::front {

namespace {

Shot preset(const std::string& name, const scene::CameraPose& pose, int height) {
    constexpr double pan = 1.5;  // [px] a frame
    constexpr std::int64_t tick = 100;
    return {name, true, panned(pose, -pan, height), pose, tick};
}

Shot moment(const scene::CameraPath& roam, int number) {
    const double time = (number + 0.5) / moments * tour_seconds;
    const std::int64_t tick = std::llround(time * motion::ticks_per_second);
    const auto pose = [&](std::int64_t at) { return roam.at(static_cast<double>(at) / motion::ticks_per_second); };
    return {"roam-" + std::to_string(std::lround(time)) + "s", false, pose(tick - 1), pose(tick), tick};
}

}  // namespace

std::vector<Shot> shots(const scene::Cameras& cameras, int height) {
    if (cameras.roam.keys.back().time != tour_seconds) throw std::logic_error("the tour takes another time");
    std::vector<Shot> all;
    for (const char* name : {"still", "close", "medium", "remote"})
        all.push_back(preset(name, cameras.named(name).at(0), height));
    all.push_back(preset("wide", scene::load_camera_path(GRANDSTAND_BENCH "/wide.json").at(0), height));
    for (int number = 0; number < moments; ++number) all.push_back(moment(cameras.roam, number));
    return all;
}

}  // namespace bench::front
