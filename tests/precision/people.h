// People of a crowd that stands somewhere, followed from where they are to where their vertices fall in a picture.
#pragma once

#include "scene/crowd.h"
#include "tests/precision/setting.h"
#include "tests/render/small_scene.h"

namespace precision {

// The built-in person and its poses.
const tests::SmallScene& cast_of_one();

// Who stands up to 16 m around a place, and who walks and runs a track's laps there.
struct Party {
    scene::Crowd crowd;
    std::vector<glm::dvec3> stand_at;  // [m] world, of each of the crowd who stand

    explicit Party(const glm::dvec3& place);

    // The same people, told from an origin so far [m] away.
    void tell_from_afar(double away);

    // [m] world, of the model's origin, and [rad], as double precision has it.
    struct Whereabouts {
        glm::dvec3 at;
        double yaw;
    };
    Whereabouts whereabouts(std::size_t person, std::int64_t tick) const;
};

// How far people's parts are off by each step alone, and by all together.
struct PeopleErrors {
    Errors standing, walking;  // where they are and how they are turned, as the frame has it
    Errors depth;              // of their middles, by which they are sorted: as many pixels as it is long from aside
    Errors skinning;           // where their vertices are in themselves, baked and packed
    Errors native, opengl;     // where vertices fall in the picture
    Errors all;                // natively, from skinning to the picture
};
PeopleErrors errors_of_people(const Setting& setting);

// Of who stands `away` [m] from their block's origin.
Errors errors_of_standing(const Setting& setting, double away);
Errors errors_of_walking(const Setting& setting);

}  // namespace precision
