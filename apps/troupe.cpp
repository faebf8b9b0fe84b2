#include "apps/troupe.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "apps/interrupt.h"
#include "apps/progress.h"
#include "apps/warnings.h"
#include "model/io/mesh_file.h"
#include "pointsample/model_key.h"
#include "pointsample/posed_mesh.h"
#include "pointsample/sample.h"
#include "scene/cast.h"
#include "scene/person.h"
#include "scene/settle.h"

namespace apps {

namespace {

// As many as are ever drawn of a character, but enough for who is far.
std::size_t point_count(const model::Mesh& mesh, const figures::Way& way) {
    constexpr std::size_t fewest = 64;
    return std::max(fewest, figures::points_worth(mesh.triangle_count(), way));
}

// The first pose is the one that most people are seen in, where limbs are apart.
pointsample::PointModel sample_points(const model::Character& character, const std::vector<int>& clips,
                                      const Preparation& preparation) {
    constexpr std::size_t pose_count = 16;
    pointsample::SampleOptions options;
    options.count = point_count(character.mesh, preparation.way);
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

}  // namespace

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
    scene::Casting casting = scene::cast(loaded);
    std::vector<std::string> lost = lines_of(character.file, loaded.warnings);
    std::ranges::copy(lines_of(character.file, casting.warnings), std::back_inserter(lost));
    say("stadium", lost, preparation.strict);
    troupe.warnings.insert(troupe.warnings.end(), lost.begin(), lost.end());
    scene::settle(loaded, casting);
    add(troupe, std::move(loaded), std::move(casting), preparation);
    troupe.poses.back().rest_height = scene::settled_height;
    troupe.poses.back().floor = 0;
}

}  // namespace apps
