// make_stadium: the plan, and all that follows from it.
#include "scene/places/stadium.h"

namespace scene {

Ground paint_ground(const StadiumPlan& plan) {
    return {"stadium.glsl", {glm::vec4(plan.oval.half_straight, plan.oval.radius, plan.stand_offset, 0.0f)}};
}

Place make_stadium(const Audience& audience) {
    const StadiumPlan plan = plan_stadium(audience.people, room_for(audience.cast, audience.poses));
    Place place;
    place.structure = build_structure(plan);
    place.ground = paint_ground(plan);
    place.crowd = populate(plan, audience);
    place.cameras = aim_cameras(plan);
    return place;
}

}  // namespace scene
