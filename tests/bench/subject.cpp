#include "tests/bench/subject.h"

#include <algorithm>
#include <stdexcept>

#include "model/io/mesh_file.h"
#include "scene/person.h"

namespace bench {
namespace {

const model::Clip& find_clip(const model::Character& character, const std::string& name) {
    const auto found = std::find_if(character.clips.begin(), character.clips.end(),
                                    [&](const model::Clip& clip) { return clip.name == name; });
    if (found == character.clips.end())
        throw std::runtime_error(character.name + ": found no clip '" + name + "', expected the name of one");
    return *found;
}

}  // namespace

Subject load_subject(std::span<const std::string> arguments) {
    if (arguments.size() == 2 || arguments.size() > 3)
        throw std::runtime_error("found " + std::to_string(arguments.size()) +
                                 " arguments, expected FILE CLIP SECONDS");
    Subject subject;
    const bool built_in = arguments.empty();
    subject.character = built_in ? scene::make_person() : model::load_mesh(arguments[0]);
    motion::Pose pose;
    if (built_in) {
        constexpr double mid_step = 0.3;  // [s]
        motion::evaluate(subject.character, find_clip(subject.character, "walk"), mid_step, pose);
    } else if (arguments.size() == 1) {
        motion::evaluate_rest(subject.character, pose);
    } else {
        motion::evaluate(subject.character, find_clip(subject.character, arguments[1]), std::stod(arguments[2]), pose);
    }
    motion::skin(subject.character.mesh, pose, subject.pose.positions, subject.pose.normals);
    subject.bounds = motion::bounds_of(subject.pose.positions);
    subject.palette = {
        glm::u8vec4(255), {226, 180, 148, 255}, {84, 58, 38, 255}, {70, 120, 176, 255}, {66, 68, 74, 255}};
    return subject;
}

}  // namespace bench
