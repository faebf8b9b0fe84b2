#include "tests/bench/stand_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/bench/fidelity.h"
#include "tests/bench/shooter.h"

namespace bench {

namespace {

constexpr std::size_t heights = std::size(stand_heights), splat_sizes = std::size(stand_splat_sizes),
                      elevations = std::size(stand_elevations);

struct Found {
    LightError error;
    double triangles = 0;
};

// What people add to a black picture, and hide of a white one [px], channel by channel.
struct Light {
    glm::dvec3 shown{0}, hidden{0};

    Light& operator+=(const Light& other) {
        shown += other.shown;
        hidden += other.hidden;
        return *this;
    }
};

Light operator*(double factor, const Light& light) {
    return {factor * light.shown, factor * light.hidden};
}

Light light_of(const render::Image& black, const render::Image& white) {
    const double pixels = static_cast<double>(black.width) * black.height;
    const glm::dvec3 shown = mean_light(black);
    return {pixels * shown, pixels * (1.0 - (mean_light(white) - shown))};
}

LightError apart(const Light& test, const Light& reference) {
    constexpr glm::dvec3 luma(0.2126, 0.7152, 0.0722);
    LightError error;
    error.brightness = glm::dot(luma, test.shown) / glm::dot(luma, reference.shown) - 1;
    error.channels = test.shown / reference.shown - 1.0;
    error.coverage = glm::dot(luma, test.hidden) / glm::dot(luma, reference.hidden) - 1;
    return error;
}

// One block of the stadium's people, alone in the world.
class Stand {
public:
    Stand()
        : stage_(stadium().stage),
          crowd_(block_of(stage_)),
          black_(stage_, crowd_, {}, {}, before(0)),
          white_(stage_, crowd_, {}, {}, before(1)) {
        for (std::size_t i = 0; i < crowd_.size(); ++i) {
            height_ += crowd_.height[i] / static_cast<double>(crowd_.size());
            facing_ += glm::dvec3(std::sin(crowd_.yaw[i]), 0, std::cos(crowd_.yaw[i]));
        }
        facing_ = glm::normalize(facing_);
    }

    std::vector<Found> measure(double elevation, double pixels) {
        const int shots = pixels < 10 ? 12 : pixels < 50 ? 4 : 2;
        // Small people need more samples than 16 a pixel to be known to a hundredth.
        constexpr double finest = 64;  // [px]
        const int factor = std::max(reference_factor, static_cast<int>(finest / pixels));
        Light reference;
        std::vector<Light> native(splat_sizes);
        std::vector<Found> found(splat_sizes);
        for (int shot = 0; shot < shots; ++shot) {
            const std::int64_t tick = 100 + 97 * shot;
            const View view = aim(elevation, pixels, shot);
            const render::View fine = view.enlarged(factor);
            reference +=
                1.0 / (factor * factor) *
                light_of(black_.gl.picture(fine, triangles(), tick), white_.gl.picture(fine, triangles(), tick));
            for (std::size_t i = 0; i < splat_sizes; ++i) {
                const sfsm::Decision decision = points_of(stand_splat_sizes[i]);
                native[i] += light_of(black_.native.picture(view.enlarged(1), decision, tick),
                                      white_.native.picture(view.enlarged(1), decision, tick));
                const render::Frame& frame = black_.native.choose(view.enlarged(1), decision, tick);
                const auto meshes = std::ranges::count(frame.people, 0u, &render::Person::representation);
                found[i].triangles += static_cast<double>(meshes) / static_cast<double>(frame.people.size()) / shots;
            }
        }
        for (std::size_t i = 0; i < splat_sizes; ++i) found[i].error = apart(native[i], reference);
        return found;
    }

private:
    struct View {
        scene::CameraPose pose;
        int width, height;
        render::View enlarged(int factor) const { return render::make_view(pose, factor * width, factor * height); }
    };

    static scene::Crowd block_of(const apps::Stage& stage) {
        const scene::CrowdBlock block = seated_block(stage.place.crowd);
        return some_of(stage.place.crowd, block.first, block.count);
    }

    static scene::Light before(float sky) {
        scene::Light light;
        light.haze = light.zenith = glm::vec3(sky);
        light.glare = glm::vec3(0);
        return light;
    }

    // As far as the demo's cameras must be for that size but, for a stand of one size, not nearer than 40 m: nearer
    // people are seen through a longer lens. Each shot is a fraction of a pixel beside the last.
    View aim(double elevation, double pixels, int shot) const {
        constexpr double nearest = 40, demo_fov = 0.9;
        constexpr int margin = 4, most_width = frame_width, most_height = frame_height;
        const double per_metre = pixels / height_;
        const double distance = std::max(nearest, 0.5 * frame_height / (std::tan(0.5 * demo_fov) * per_metre));
        const motion::Bounds& box = crowd_.blocks[0].box;
        const int side = 2 * margin + static_cast<int>(std::ceil(per_metre * glm::length(box.size())));
        View view;
        view.width = std::min(side, most_width);
        view.height = std::min(side, most_height);
        const glm::dvec3 beside(-facing_.z, 0, facing_.x);
        const double shift = 0.618034 * shot, rise = 0.754878 * shot;
        const glm::dvec3 off =
            ((shift - std::floor(shift)) * beside + (rise - std::floor(rise)) * glm::dvec3(0, 1, 0)) / per_metre;
        view.pose.target = glm::dvec3(box.center()) + off;
        view.pose.position =
            view.pose.target + distance * (std::cos(elevation) * facing_ + std::sin(elevation) * glm::dvec3(0, 1, 0));
        view.pose.fov_y = 2 * std::atan(0.5 * view.height / (per_metre * distance));
        return view;
    }

    const apps::Stage& stage_;
    const scene::Crowd crowd_;
    Shooting black_, white_;
    double height_ = 0;     // [m] mean
    glm::dvec3 facing_{0};  // unit
};

const Found& found(std::size_t elevation, std::size_t height, std::size_t splat_size) {
    static const std::vector<Found> all = [] {
        std::vector<Found> list;
        Stand stand;
        for (const double angle : stand_elevations)
            for (const double pixels : stand_heights)
                for (const Found& one : stand.measure(angle, pixels)) list.push_back(one);
        return list;
    }();
    return all[(elevation * heights + height) * splat_sizes + splat_size];
}

}  // namespace

const LightError& light_error(std::size_t elevation, std::size_t height, std::size_t splat_size) {
    return found(elevation, height, splat_size).error;
}

double share_of_triangles(std::size_t elevation, std::size_t height, std::size_t splat_size) {
    return found(elevation, height, splat_size).triangles;
}

}  // namespace bench
