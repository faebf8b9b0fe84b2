#include "pointsample/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "motion/pose.h"
#include "pointsample/embree.h"

namespace pointsample {
namespace {

constexpr std::size_t direction_count = 128;  // over the whole sphere: half of them are above any surface
constexpr float least_cosine = 0.03f;         // rays nearer to the surface would hit what they start from
constexpr std::size_t run_length = 256;       // points whose tests know of each other
constexpr int packet = 8;
constexpr int rays_after_hidden = 8;

// Embree sees the mesh scaled to a diagonal of 1, as products of very large or small coordinates leave float's range.
// Rays start this far off the surface: well above float's rounding of positions (1e-7), well below the gap between a
// body and its clothes.
constexpr float offset = 1e-5f;

using Directions = std::array<glm::vec3, direction_count>;

// A spherical Fibonacci spread, in an order whose runs are spread as well.
Directions make_directions() {
    constexpr double golden_angle = 2.39996322972865332;
    constexpr std::size_t stride = direction_count * 5 / 8 - 1;                        // near the golden section
    static_assert(stride % 2 == 1 && (direction_count & (direction_count - 1)) == 0);  // so that all come once
    Directions directions;
    for (std::size_t i = 0; i < direction_count; ++i) {
        const double k = static_cast<double>(i * stride % direction_count);
        const double z = 1.0 - 2.0 * (k + 0.5) / static_cast<double>(direction_count);
        const double radius = std::sqrt(1.0 - z * z), angle = golden_angle * k;
        directions[i] = glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return directions;
}

// Eight rays from one point.
class Packet {
public:
    explicit Packet(const glm::vec3& from) : from_(from) { std::fill_n(valid_, packet, 0); }

    bool is_full() const { return count_ == packet; }
    int count() const { return count_; }

    void add(std::size_t number, const glm::vec3& direction) {
        rays_.org_x[count_] = from_.x, rays_.org_y[count_] = from_.y, rays_.org_z[count_] = from_.z;
        rays_.dir_x[count_] = direction.x, rays_.dir_y[count_] = direction.y, rays_.dir_z[count_] = direction.z;
        rays_.tnear[count_] = 0, rays_.tfar[count_] = std::numeric_limits<float>::infinity();
        rays_.time[count_] = 0, rays_.mask[count_] = ~0u, rays_.id[count_] = 0, rays_.flags[count_] = 0;
        number_[count_] = number;
        valid_[count_++] = -1;
    }

    // The number of the first direction that nothing is in the way of; direction_count if there is none.
    std::size_t first_open(RTCScene scene) {
        occluded(scene, valid_, rays_);
        for (int i = 0; i < count_; ++i)
            if (rays_.tfar[i] >= 0.0f) return number_[i];
        return direction_count;
    }

private:
    alignas(32) RTCRay8 rays_{};
    alignas(32) int valid_[packet];
    std::size_t number_[packet]{};
    int count_ = 0;
    glm::vec3 from_;
};

bool is_open(RTCScene scene, const glm::vec3& from, const glm::vec3& direction) {
    RTCRay ray{};
    ray.org_x = from.x, ray.org_y = from.y, ray.org_z = from.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = ~0u;
    occluded(scene, ray);
    return ray.tfar >= 0.0f;
}

// What the points of a run tell those after them.
struct Run {
    std::size_t last_open = 0;  // direction
    std::size_t next = 0;       // direction to begin with
    bool after_hidden = false;
};

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

struct Visibility::Scene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    glm::vec3 center{0.0f};
    float scale = 1.0f;
    InTheWay in_the_way;
    std::vector<std::uint32_t> triangle_of;  // of Embree's, its number among all
    std::vector<glm::vec3> normal_of;        // its own, of any length; both only if in_the_way

    Scene() : device(rtcNewDevice(nullptr)) {
        if (device == nullptr)
            throw std::runtime_error("found no Embree device (error " + std::to_string(rtcGetDeviceError(nullptr)) +
                                     "); expected a processor that Embree runs on");
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    }
    ~Scene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    glm::vec3 scaled(const glm::vec3& point) const { return (point - center) * scale; }
    bool sees(const glm::vec3& from, const glm::vec3& normal, Run& run) const;
    static void let_through(const RTCFilterFunctionNArguments* query);

    template <typename IsTwoSided>
    std::vector<char> look(std::span<const Place> places, IsTwoSided is_two_sided) const;

    void* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                     std::size_t count) {
        void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
        if (buffer == nullptr)
            throw std::runtime_error("found no memory for " + std::to_string(count) +
                                     " elements in Embree; expected it");
        return buffer;
    }
};

void Visibility::Scene::let_through(const RTCFilterFunctionNArguments* query) {
    const Scene& scene = *static_cast<const Scene*>(query->geometryUserPtr);
    for (unsigned i = 0; i < query->N; ++i) {
        if (query->valid[i] == 0) continue;
        const std::uint32_t number = RTCHitN_primID(query->hit, query->N, i);
        const glm::vec3 out(RTCRayN_dir_x(query->ray, query->N, i), RTCRayN_dir_y(query->ray, query->N, i),
                            RTCRayN_dir_z(query->ray, query->N, i));
        if (!scene.in_the_way(scene.triangle_of[number], RTCHitN_u(query->hit, query->N, i),
                              RTCHitN_v(query->hit, query->N, i), glm::dot(scene.normal_of[number], out) < 0.0f))
            query->valid[i] = 0;
    }
}

Visibility::Visibility(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                       InTheWay in_the_way)
    : scene_(std::make_unique<Scene>()) {
    scene_->in_the_way = std::move(in_the_way);
    std::vector<std::uint32_t> corners;
    corners.reserve(indices.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const auto finite = [&](std::size_t at) {
            assert(indices[at] < positions.size());
            return is_finite(positions[indices[at]]);
        };
        if (!finite(i) || !finite(i + 1) || !finite(i + 2)) continue;
        corners.insert(corners.end(), {indices[i], indices[i + 1], indices[i + 2]});
        if (scene_->in_the_way) scene_->triangle_of.push_back(static_cast<std::uint32_t>(i / 3));
    }
    if (corners.empty()) return;  // nothing is in anyone's way

    const motion::Bounds bounds = motion::bounds_of(positions);
    const double diagonal = glm::length(glm::dvec3(bounds.size()));
    scene_->center = bounds.center();
    if (diagonal > 0 && std::isfinite(diagonal)) scene_->scale = static_cast<float>(1 / diagonal);

    const RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        scene_->new_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i) vertices[i] = scene_->scaled(positions[i]);
    auto* triangles = static_cast<std::uint32_t*>(scene_->new_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                                     3 * sizeof(std::uint32_t), corners.size() / 3));
    std::copy(corners.begin(), corners.end(), triangles);
    if (scene_->in_the_way) {
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            const glm::vec3 a = vertices[corners[i]];
            scene_->normal_of.push_back(glm::cross(vertices[corners[i + 1]] - a, vertices[corners[i + 2]] - a));
        }
        rtcSetGeometryUserData(geometry, scene_.get());
        rtcSetGeometryOccludedFilterFunction(geometry, Scene::let_through);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_->scene);
}

Visibility::~Visibility() = default;

bool Visibility::Scene::sees(const glm::vec3& from, const glm::vec3& normal, Run& run) const {
    static const Directions directions = make_directions();
    if (glm::dot(directions[run.last_open], normal) > least_cosine && is_open(scene, from, directions[run.last_open]))
        return true;
    int rays = 0;
    for (std::size_t asked = 0; asked < direction_count;) {
        Packet rays8(from);
        for (; !rays8.is_full() && asked < direction_count; ++asked) {
            const std::size_t number = (run.next + asked) % direction_count;
            if (glm::dot(directions[number], normal) > least_cosine) rays8.add(number, directions[number]);
        }
        const std::size_t open = rays8.count() > 0 ? rays8.first_open(scene) : direction_count;
        if (open < direction_count) {
            run.last_open = open;
            return true;
        }
        rays += rays8.count();
        if (run.after_hidden && rays >= rays_after_hidden) {
            run.next = (run.next + asked) % direction_count;
            return false;
        }
    }
    return false;
}

template <typename IsTwoSided>
std::vector<char> Visibility::Scene::look(std::span<const Place> places, IsTwoSided is_two_sided) const {
    std::vector<char> seen(places.size());
    const std::size_t runs = (places.size() + run_length - 1) / run_length;
    tbb::parallel_for(std::size_t{0}, runs, [&](std::size_t number) {
        Run run;
        const std::size_t first = number * run_length, last = std::min(first + run_length, places.size());
        for (std::size_t i = first; i < last; ++i) {
            const glm::vec3 at = scaled(places[i].position), normal = places[i].normal;
            seen[i] = sees(at + offset * normal, normal, run) ||
                      (is_two_sided(i) && sees(at - offset * normal, -normal, run));
            run.after_hidden = seen[i] == 0;
        }
    });
    return seen;
}

std::vector<char> Visibility::look(std::span<const Place> places, bool two_sided) const {
    return scene_->look(places, [&](std::size_t) { return two_sided; });
}

std::vector<char> Visibility::look(std::span<const Place> places, std::span<const char> two_sided) const {
    return scene_->look(places, [&](std::size_t i) { return two_sided[i] != 0; });
}

}  // namespace pointsample
