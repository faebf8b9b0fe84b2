// Everything a run shows, ready to be drawn: a place with its crowd, and the cast in all their poses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/point_cache.h"
#include "figures/way.h"
#include "model/mesh.h"
#include "motion/pose_table.h"
#include "pointsample/point_model.h"
#include "scene/place.h"

namespace apps {

struct Stage {
    scene::Place place;
    // One element a character.
    std::vector<model::Mesh> meshes;
    std::vector<pointsample::PointModel> points;
    std::vector<scene::CastMember> cast;
    std::vector<motion::PoseTable> poses;
    std::vector<std::string> warnings;  // what was lost of the files, a line a kind

    std::vector<figures::Figure> figures() const;  // point into this
};

// `character_files` empty: the built-in person. Shows progress on a terminal. Throws what the loaders throw.
// strict: throws too if anything of a file would be lost.
// A character gets as many points as serve where they are drawn in that way.
std::unique_ptr<Stage> build_stage(const std::vector<std::filesystem::path>& character_files, std::int64_t people,
                                   std::uint64_t seed, const PointCache& cache, const figures::Way& way,
                                   bool strict = false);

}  // namespace apps
