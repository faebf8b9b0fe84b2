#include "pointsample/model_key.h"

#include <cstdint>
#include <iomanip>
#include <memory>
#include <sstream>
#include <type_traits>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointsample {
namespace {

// Every array with its length before it, so that none can pass for a part of its neighbour.
class Hasher {
public:
    Hasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

    template <typename T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        XXH3_128bits_update(state_.get(), &value, sizeof value);
    }
    template <typename T>
    void add(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(static_cast<std::uint64_t>(values.size()));
        if (!values.empty()) XXH3_128bits_update(state_.get(), values.data(), values.size() * sizeof(T));
    }

    std::string text() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
        std::ostringstream text;
        text << std::hex << std::setfill('0') << std::setw(16) << hash.high64 << std::setw(16) << hash.low64;
        return text.str();
    }

private:
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

}  // namespace

std::string model_key(const model::Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options) {
    Hasher hasher;
    hasher.add(sampler_version);
    hasher.add(static_cast<std::uint64_t>(options.count));
    hasher.add(options.seed);
    hasher.add(static_cast<int>(options.order));
    hasher.add(options.visible_only);
    if (mesh.origin != glm::dvec3(0.0)) hasher.add(mesh.origin);
    for (const PosedMesh& pose : poses) {
        hasher.add(pose.positions);
        hasher.add(pose.normals);
    }
    hasher.add(mesh.indices);
    hasher.add(mesh.uvs);
    hasher.add(mesh.colors);
    hasher.add(mesh.slots);
    hasher.add(mesh.material_ids);
    hasher.add(mesh.joints);
    hasher.add(mesh.weights);
    if (!mesh.more_joints.empty()) {
        hasher.add(mesh.more_joints);
        hasher.add(mesh.more_weights);
    }
    hasher.add(static_cast<std::uint64_t>(mesh.materials.size()));
    for (const model::Material& material : mesh.materials) {
        hasher.add(material.texture);
        hasher.add(material.emissive_texture);
        hasher.add(material.sampler.across);
        hasher.add(material.sampler.down);
        hasher.add(material.sampler.nearest);
        hasher.add(material.emissive);
        hasher.add(material.alpha_cutoff);
        hasher.add(material.unlit);
        hasher.add(material.double_sided);
    }
    for (const model::Texture& texture : mesh.textures) {
        hasher.add(texture.width);
        hasher.add(texture.height);
        hasher.add(texture.texels);
    }
    return hasher.text();
}

}  // namespace pointsample
