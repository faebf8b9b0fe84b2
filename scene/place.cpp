#include "scene/place.h"

namespace scene {

void move(Place& place, const glm::dvec3& by) {
    place.structure.origin += by;
    for (CrowdBlock& block : place.crowd.blocks) block.origin += by;
    Cameras& cameras = place.cameras;
    for (CameraPath* path : {&cameras.still, &cameras.close, &cameras.medium, &cameras.remote, &cameras.roam})
        for (CameraKey& key : path->keys) {
            key.pose.position += by;
            key.pose.target += by;
        }
}

}  // namespace scene
