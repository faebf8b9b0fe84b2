// The stadium: its plan, and the place that is made of it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/audience.h"
#include "scene/place.h"
#include "scene/places/oval.h"
#include "scene/room.h"

namespace scene {

struct Seat {
    // [m] under the hips, on the row's floor: the seat's surface is person.h's seat_height above. On a terrace, the
    // feet.
    glm::vec3 position;
    float yaw;                   // [rad] facing (sin yaw, 0, cos yaw), towards the pitch
    std::uint16_t row, section;  // into StadiumPlan::rows; between spokes `section` and `section` + 1
};

// A radial line through the corners of all rows: the middle of an aisle. Between two spokes rows run straight, as
// precast terraces do, so that seats and steps agree exactly however few triangles the steps are made of.
struct Spoke {
    glm::vec2 foot;     // [m] x, z where it leaves the inner line
    glm::vec2 outward;  // unit x, z
    glm::vec2 at(float offset) const { return foot + offset * outward; }
};

// One step of the stand: a tread, Room::depth deep, and the riser behind it.
struct Row {
    float offset;  // [m] outward from the inner line to the tread's front edge, along the spokes
    float floor;   // [m] height of the tread
    std::uint32_t first_seat, seat_count;  // into StadiumPlan::seats
};

// A canopy that rises from its outer to its inner edge. No roof: both offsets are equal.
struct Roof {
    float inner_offset = 0, outer_offset = 0;  // [m] outward from the inner line
    float inner_height = 0, outer_height = 0;  // [m] of its top
};

// Rows of seats in one or two tiers around the oval, in sections between aisles.
struct StadiumPlan {
    std::int64_t people = 0;  // planned for
    Room room;
    Oval oval;
    float stand_offset = 0;        // [m] outward from the inner line to the first row
    float outer_offset = 0;        // [m] to the outer wall
    float rim_height = 0;          // [m] top of the roof, or of the outer wall if there is none; masts rise above it
    float crowd_offset = 0;        // [m] about as far out as anybody stands: outer_offset if nobody stands outside
    std::vector<Spoke> spokes;     // in the order of arc, around the whole oval
    std::vector<Row> rows;         // upward
    std::uint32_t lower_rows = 0;  // rows below the concourse; all of them if there is one tier
    Roof roof;
    std::vector<Seat> seats;  // row by row, each row in the order of its arc
};

// As many rows as it takes to seat `people` (athletes aside) with a few seats to spare, within 8 to 60 rows.
// `people` >= 1.
StadiumPlan plan_stadium(std::int64_t people, const Room& room = {});

// Steps, seats, walls, roof, rim, floodlights, and the ground out to 2 km.
StaticMesh build_structure(const StadiumPlan& plan);

// Pitch, track and paving.
Ground paint_ground(const StadiumPlan& plan);

// Seats first (seeded choice of who sits where, athletes on the track), then the pitch and around, out to as far as it
// takes.
Crowd populate(const StadiumPlan& plan, const Audience& audience);

//   still   from a seat high in a corner, most of the stadium in view
//   close   a few metres from people in the stands
//   medium  from the infield towards a stand
//   remote  from above the rim, everybody in view
//   roam    a 60 s closed tour that goes close, medium and remote
Cameras aim_cameras(const StadiumPlan& plan);

// A stadium that seats its audience, by daylight: all of the above.
Place make_stadium(const Audience& audience);

}  // namespace scene
