#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "model/io/gltf_file.h"

namespace model {
namespace {

Interpolation interpolation_of(const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
    if (name == "LINEAR") return Interpolation::linear;  // tinygltf says so where the file says nothing
    fail("the interpolation " + name, "LINEAR, STEP or CUBICSPLINE");
}

// False for what moves no surface (pointers into materials, say).
bool path_of(const std::string& name, Path& path) {
    if (name == "translation")
        path = Path::translation;
    else if (name == "rotation")
        path = Path::rotation;
    else if (name == "scale")
        path = Path::scale;
    else if (name == "weights")
        path = Path::morph_weights;
    else
        return false;
    return true;
}

std::vector<float> read_times(GltfFile& file, int accessor) {
    const Accessor keys(file, accessor, 1);
    file.budget.spend(keys.count());
    std::vector<float> times(keys.count());
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = keys.finite(i, 0);
        if (times[i] < (i == 0 ? 0.0f : times[i - 1]))
            fail("a key at " + std::to_string(times[i]) + " s out of order", "ascending times from 0");
    }
    return times;
}

std::vector<float> read_values(GltfFile& file, int accessor, int width) {
    const Accessor keys(file, accessor, width);
    const std::size_t components = static_cast<std::size_t>(width);
    file.budget.spend(keys.count());
    std::vector<float> values(keys.count() * components);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = keys.finite(i / components, static_cast<int>(i % components));
    return values;
}

Channel read_channel(GltfFile& file, const tinygltf::AnimationSampler& sampler, Path path, std::int32_t node) {
    Channel channel{node, path, interpolation_of(sampler.interpolation), read_times(file, sampler.input), {}};
    const int width = path == Path::rotation ? 4 : path == Path::morph_weights ? 1 : 3;
    channel.values = read_values(file, sampler.output, width);
    const std::size_t parts = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const std::size_t least = channel.times.size() * parts * static_cast<std::size_t>(width);
    if (channel.values.size() < least)
        fail(std::to_string(channel.values.size()) + " values for " + std::to_string(channel.times.size()) + " keys",
             "at least " + std::to_string(least));
    return channel;
}

// Names that tell clips apart: those without one are told by their place in the file, from 0 on; of several of one name
// the others are numbered.
class ClipNames {
public:
    std::string operator()(const std::string& own, std::size_t place) {
        const std::string base = own.empty() ? "clip " + std::to_string(place) : own;
        std::string name = base;
        for (int& count = given_[base]; !taken_.insert(name).second; name = base + " (" + std::to_string(count) + ")")
            count = std::max(count + 1, 2);
        return name;
    }

private:
    std::unordered_map<std::string, int> given_;  // how far the others of a name are numbered
    std::unordered_set<std::string> taken_;
};

Clip read_clip(GltfFile& file, const tinygltf::Animation& animation, const NodeOrder& nodes, std::string name,
               Warnings& warnings) {
    Clip clip;
    clip.name = std::move(name);
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
        Path path;
        if (!path_of(channel.target_path, path)) {
            warnings.add(moves_nothing, clip.name);
            continue;
        }
        if (channel.target_node < 0) continue;
        if (static_cast<std::size_t>(channel.target_node) >= nodes.in_skeleton.size())
            fail("an animation of node " + std::to_string(channel.target_node), "one that exists");
        if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
            fail("an animation's sampler " + std::to_string(channel.sampler), "one that exists");
        const std::int32_t node = nodes.in_skeleton[static_cast<std::size_t>(channel.target_node)];
        clip.channels.push_back(
            read_channel(file, animation.samplers[static_cast<std::size_t>(channel.sampler)], path, node));
        if (!clip.channels.back().times.empty())
            clip.duration = std::max(clip.duration, static_cast<double>(clip.channels.back().times.back()));
    }
    return clip;
}

}  // namespace

void build_clips(GltfFile& file, const NodeOrder& nodes, Character& character) {
    ClipNames names;
    for (std::size_t i = 0; i < file.model.animations.size(); ++i) {
        const tinygltf::Animation& animation = file.model.animations[i];
        const std::string name = names(animation.name, i);
        try {
            character.clips.push_back(read_clip(file, animation, nodes, name, character.warnings));
        } catch (const BudgetError&) {
            throw;
        } catch (const std::runtime_error&) {
            character.warnings.add("clip with keys that can't be played, left out", name);
        }
    }
}

}  // namespace model
