// Characters ready to be drawn: each of them in all its poses, and as points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/point_cache.h"
#include "figures/way.h"
#include "model/mesh.h"
#include "motion/pose_table.h"
#include "pointsample/point_model.h"
#include "scene/cast.h"
#include "scene/crowd.h"

namespace apps {

// A character of a user's, and what they want of it.
struct CharacterFile {
    std::filesystem::path file;
    double weight = 1;                   // > 0: of a mixture, against the others'
    double turn = 0;                     // [degrees] scene::settle's: for who doesn't face +z
    std::vector<scene::ActWish> acts{};  // what it does something by, instead of what is found

    bool operator==(const CharacterFile&) const = default;
};

struct Troupe {
    // One element a character.
    std::vector<model::Mesh> meshes;
    std::vector<pointsample::PointModel> points;
    std::vector<scene::CastMember> cast;
    std::vector<motion::PoseTable> poses;
    std::vector<std::vector<std::string>> clip_names;  // of PoseTable::clips; none of a statue
    std::vector<std::string> warnings;                 // what was lost of the files, a line a kind

    std::vector<figures::Figure> figures() const;  // point into this
};

// What a character does in a role.
struct Part {
    std::string role;  // for people
    scene::Role as;
    std::uint8_t clip;  // into PoseTable::clips
};
std::vector<Part> parts_of(const scene::CastMember& member);

// How characters are made ready.
struct Preparation {
    std::uint64_t seed = 0;                      // of what chance decides
    PointCache cache{""};                        // of point models
    const figures::Way& way;                     // a character gets as many points as serve where they are drawn so
    bool strict = false;                         // a file of which anything would be lost is refused
    bool verbose = false;                        // what a file's character does in its roles is said on stderr
    std::size_t fewest_points = 64;              // of a character, however few triangles it has
    std::size_t byte_budget = pose_byte_budget;  // [bytes] for the poses of each, vertices and points together

    // [bytes] For all characters of a crowd; what a device holds is twice that.
    static constexpr std::size_t pose_byte_budget = std::size_t{256} << 20;
};

// The built-in person, or a file's character as scene::settle puts it, becomes the troupe's last. Shows progress on a
// terminal. Throws what the loaders throw.
void add_person(Troupe& troupe, const Preparation& preparation);
void add_character(Troupe& troupe, const CharacterFile& character, const Preparation& preparation);

}  // namespace apps
