#include "pointsample/visibility.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "motion/pose.h"
#include "pointsample/embree.h"

namespace pointsample {
namespace {

constexpr std::size_t direction_count = 96;

// Embree sees the mesh scaled to a diagonal of 1, as products of very large or small coordinates leave float's range.
// Rays start this far off the surface: well above float's rounding of positions (1e-7), well below the gap between a
// body and its clothes.
constexpr float offset = 1e-5f;

using Directions = std::array<glm::vec3, direction_count>;

// A spherical Fibonacci spread over the hemisphere of +z, from the pole down to the horizon: most points see something
// near their normal, so that the first ray settles them.
Directions make_directions() {
    constexpr double golden_angle = 2.39996322972865332;
    Directions directions;
    for (std::size_t i = 0; i < direction_count; ++i) {
        const double z = 1.0 - (static_cast<double>(i) + 0.5) / static_cast<double>(direction_count);
        const double radius = std::sqrt(1.0 - z * z), angle = golden_angle * static_cast<double>(i);
        directions[i] = glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return directions;
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

struct Visibility::Scene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    glm::vec3 center{0.0f};
    float scale = 1.0f;

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

    void* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                     std::size_t count) {
        void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
        if (buffer == nullptr)
            throw std::runtime_error("found no memory for " + std::to_string(count) +
                                     " elements in Embree; expected it");
        return buffer;
    }
};

Visibility::Visibility(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices)
    : scene_(std::make_unique<Scene>()) {
    std::vector<std::uint32_t> corners;
    corners.reserve(indices.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const auto finite = [&](std::size_t at) {
            assert(indices[at] < positions.size());
            return is_finite(positions[indices[at]]);
        };
        if (finite(i) && finite(i + 1) && finite(i + 2))
            corners.insert(corners.end(), {indices[i], indices[i + 1], indices[i + 2]});
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
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_->scene);
}

Visibility::~Visibility() = default;

bool Visibility::sees_outside(glm::vec3 point, glm::vec3 normal, bool two_sided) const {
    static const Directions directions = make_directions();
    // Any two axes across the normal (Duff et al. 2017, "Building an orthonormal basis, revisited").
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z), b = normal.x * normal.y * a;
    const glm::vec3 tangent(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    const glm::vec3 start = scene_->scaled(point);
    for (int side = 0; side < (two_sided ? 2 : 1); ++side) {
        const glm::vec3 pole = side == 0 ? normal : -normal;
        const glm::vec3 origin = start + offset * pole;
        for (const glm::vec3& local : directions) {
            const glm::vec3 direction = local.x * tangent + local.y * bitangent + local.z * pole;
            RTCRay ray{};
            ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
            ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
            ray.tfar = std::numeric_limits<float>::infinity();
            ray.mask = ~0u;
            occluded(scene_->scene, ray);
            if (ray.tfar >= 0.0f) return true;
        }
    }
    return false;
}

}  // namespace pointsample
