// Everything a run shows, ready to be drawn: a place with its crowd, and the cast in all their poses.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "apps/troupe.h"
#include "scene/place.h"

namespace apps {

struct Stage : Troupe {
    scene::Place place;
};

// `characters` empty: the built-in person. Shows progress on a terminal. Throws what the loaders throw.
// strict: throws too if anything of a file would be lost; verbose: says who does what.
// A character gets as many points as serve where they are drawn in that way.
std::unique_ptr<Stage> build_stage(const std::vector<CharacterFile>& characters, std::int64_t people,
                                   std::uint64_t seed, const PointCache& cache, const figures::Way& way,
                                   bool strict = false, bool verbose = false);

}  // namespace apps
