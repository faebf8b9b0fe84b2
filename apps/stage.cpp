#include "apps/stage.h"

#include <algorithm>

#include "apps/interrupt.h"
#include "apps/progress.h"
#include "apps/warnings.h"
#include "model/io/mesh_file.h"
#include "model/sides.h"
#include "pointsample/model_key.h"
#include "pointsample/posed_mesh.h"
#include "pointsample/sample.h"
#include "scene/cast.h"
#include "scene/person.h"
#include "scene/places/stadium.h"

namespace apps {

namespace {

// Posed vertices and points of all characters together; what the device holds is twice that.
constexpr std::size_t pose_byte_budget = std::size_t{256} << 20;

// As many as are ever drawn of a character, but enough for who is far.
std::size_t point_count(const model::Mesh& mesh, const figures::Way& way) {
    constexpr std::size_t fewest = 64;
    return std::max(fewest, figures::points_worth(mesh.triangle_count(), way));
}

// The first pose is the one that most people are seen in, where limbs are apart.
pointsample::PointModel sample_points(const model::Character& character, const std::vector<int>& clips,
                                      std::uint64_t seed, const PointCache& cache, const figures::Way& way) {
    constexpr std::size_t pose_count = 16;
    pointsample::SampleOptions options;
    options.count = point_count(character.mesh, way);
    options.seed = seed;
    throw_if_interrupted();
    const std::vector<pointsample::PosedMesh> poses = pointsample::spread_poses(character, clips, pose_count);
    return cache.get(pointsample::model_key(character.mesh, poses, options), [&] {
        ProgressBar bar("Sampling " + character.name);
        return pointsample::sample(character.mesh, poses, options, [&](double f) { bar(f); });
    });
}

void add_character(Stage& stage, model::Character character, std::uint64_t seed, std::size_t byte_budget,
                   const PointCache& cache, const figures::Way& way) {
    model::split_sides(character.mesh);
    scene::Casting casting = scene::cast(character);
    stage.points.push_back(sample_points(character, casting.clips, seed, cache, way));
    throw_if_interrupted();
    ProgressBar bar("Posing " + character.name);
    stage.poses.push_back(motion::bake_poses(character, casting.clips, stage.points.back().surface, byte_budget,
                                             [&](double f) { bar(f); }));
    stage.cast.push_back(std::move(casting.member));
    stage.meshes.push_back(std::move(character.mesh));
}

}  // namespace

std::vector<figures::Figure> Stage::figures() const {
    std::vector<figures::Figure> figures;
    for (std::size_t i = 0; i < meshes.size(); ++i) figures.push_back({&meshes[i], &poses[i], &points[i]});
    return figures;
}

std::unique_ptr<Stage> build_stage(const std::vector<std::filesystem::path>& character_files, std::int64_t people,
                                   std::uint64_t seed, const PointCache& cache, const figures::Way& way, bool strict) {
    auto stage = std::make_unique<Stage>();
    if (character_files.empty()) add_character(*stage, scene::make_person(), seed, pose_byte_budget, cache, way);
    for (const std::filesystem::path& file : character_files) {
        model::Character character = model::load_mesh(file);
        const std::vector<std::string> lost = lines_of(file, character.warnings);
        say("stadium", lost, strict);
        stage->warnings.insert(stage->warnings.end(), lost.begin(), lost.end());
        add_character(*stage, std::move(character), seed, pose_byte_budget / character_files.size(), cache, way);
    }
    throw_if_interrupted();
    ProgressBar bar("Seating the crowd");
    const auto show = [&](double fraction) {
        throw_if_interrupted();
        bar(fraction);
    };
    stage->place = scene::make_stadium({people, stage->cast, stage->poses, seed, show});
    return stage;
}

}  // namespace apps
