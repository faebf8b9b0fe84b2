#include "apps/troupe.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>

#include "apps/interrupt.h"
#include "apps/progress.h"
#include "apps/warnings.h"
#include "model/input_file.h"
#include "model/io/mesh_file.h"
#include "model/sides.h"
#include "pointsample/model_key.h"
#include "pointsample/posed_mesh.h"
#include "pointsample/sample.h"
#include "scene/cast.h"
#include "scene/person.h"
#include "scene/settle.h"

namespace apps {

namespace {

// As many as are ever drawn of a character, but enough for who is far.
std::size_t point_count(const model::Mesh& mesh, const Preparation& preparation) {
    return std::max(preparation.fewest_points, figures::points_worth(mesh.triangle_count(), preparation.way));
}

// The first pose is the one that most people are seen in, where limbs are apart.
pointsample::PointModel sample_points(const model::Character& character, const std::vector<int>& clips,
                                      const Preparation& preparation) {
    constexpr std::size_t pose_count = 16;
    pointsample::SampleOptions options;
    options.count = point_count(character.mesh, preparation);
    options.seed = preparation.seed;
    throw_if_interrupted();
    const std::vector<pointsample::PosedMesh> poses = pointsample::spread_poses(character, clips, pose_count);
    return preparation.cache.get(pointsample::model_key(character.mesh, poses, options), [&] {
        ProgressBar bar("Sampling " + character.name);
        return pointsample::sample(character.mesh, poses, options, [&](double f) { bar(f); });
    });
}

void add(Troupe& troupe, model::Character character, scene::Casting casting, const Preparation& preparation) {
    pointsample::PointModel points = sample_points(character, casting.clips, preparation);
    throw_if_interrupted();
    ProgressBar bar("Posing " + character.name);
    troupe.poses.push_back(motion::bake_poses(character, casting.clips, points.surface, preparation.byte_budget,
                                              [&](double f) { bar(f); }));
    troupe.points.push_back(std::move(points));
    troupe.cast.push_back(std::move(casting.member));
    std::vector<std::string>& names = troupe.clip_names.emplace_back();
    for (const int clip : casting.clips) names.push_back(character.clips[static_cast<std::size_t>(clip)].name);
    troupe.meshes.push_back(std::move(character.mesh));
}

// A line: in each role the clip, and how fast who goes goes.
void say_roles(const Troupe& troupe, const CharacterFile& character) {
    const std::vector<std::string>& clips = troupe.clip_names.back();
    std::string line;
    for (const Part& part : parts_of(troupe.cast.back())) {
        line += (line.empty() ? "" : "; ") + part.role + " " +
                (clips.empty() ? "no clip" : model::in_quotes(clips[part.clip]));
        const float speed = troupe.cast.back().gait_speed[static_cast<int>(part.as)];
        char text[32];
        std::snprintf(text, sizeof text, " at %.2f m/s", static_cast<double>(speed));
        if (scene::follows_path(part.as)) line += text;
    }
    std::fprintf(stderr, "stadium: %s: %s\n", character.file.filename().c_str(), line.c_str());
}

}  // namespace

std::vector<Part> parts_of(const scene::CastMember& member) {
    std::vector<Part> parts;
    const auto add = [&](const char* role, scene::Role as, const std::vector<std::uint8_t>& clips) {
        for (const std::uint8_t clip : clips) parts.push_back({role, as, clip});
    };
    using scene::Role;
    const auto acts = [&](Role role) -> const scene::Acts& { return member.acts[static_cast<int>(role)]; };
    add("spectator", Role::spectator, acts(Role::spectator).calm);
    add("excited", Role::spectator, acts(Role::spectator).excited);
    add("standing", Role::standing, acts(Role::standing).calm);
    add("walker", Role::walker, acts(Role::walker).calm);
    add("runner", Role::runner, acts(Role::runner).calm);
    return parts;
}

std::vector<figures::Figure> Troupe::figures() const {
    std::vector<figures::Figure> figures;
    for (std::size_t i = 0; i < meshes.size(); ++i) figures.push_back({&meshes[i], &poses[i], &points[i]});
    return figures;
}

void add_person(Troupe& troupe, const Preparation& preparation) {
    model::Character person = scene::make_person();
    scene::Casting casting = scene::cast(person);
    add(troupe, std::move(person), std::move(casting), preparation);
}

void add_character(Troupe& troupe, const CharacterFile& character, const Preparation& preparation) {
    model::Character loaded = model::load_mesh(character.file);
    model::split_sides(loaded.mesh);
    scene::Casting casting = model::with_name(character.file, [&] { return scene::cast(loaded, character.acts); });
    std::vector<std::string> lost = lines_of(character.file, loaded.warnings);
    std::ranges::copy(lines_of(character.file, casting.warnings), std::back_inserter(lost));
    say("stadium", lost, preparation.strict);
    troupe.warnings.insert(troupe.warnings.end(), lost.begin(), lost.end());
    model::with_name(character.file, [&] { scene::settle(loaded, casting, character.turn); });
    add(troupe, std::move(loaded), std::move(casting), preparation);
    troupe.poses.back().rest_height = scene::settled_height;
    troupe.poses.back().floor = 0;
    if (preparation.verbose) say_roles(troupe, character);
}

}  // namespace apps
