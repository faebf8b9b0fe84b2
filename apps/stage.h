// Everything a run shows, ready to be drawn: the stadium, its cast in all their poses, and the crowd.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/point_cache.h"
#include "figures/figure.h"
#include "model/mesh.h"
#include "motion/pose_table.h"
#include "pointsample/point_model.h"
#include "scene/crowd.h"
#include "scene/places/stadium.h"

namespace apps {

struct Stage {
    scene::StadiumPlan plan;
    scene::StaticMesh structure;
    // One element a character.
    std::vector<model::Mesh> meshes;
    std::vector<pointsample::PointModel> points;
    std::vector<scene::CastMember> cast;
    std::vector<motion::PoseTable> poses;
    scene::Crowd crowd;

    std::vector<figures::Figure> figures() const;  // point into this
};

// `character_files` empty: the built-in person. Shows progress on a terminal. Throws what the loaders throw.
std::unique_ptr<Stage> build_stage(const std::vector<std::filesystem::path>& character_files, std::int64_t people,
                                   std::uint64_t seed, const PointCache& cache);

}  // namespace apps
