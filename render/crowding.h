// How much of people shows who stand or sit close together: those before hide those behind.
#pragma once

#include <glm/glm.hpp>

namespace render {

// People of a block, as bodies that fill a shape of equal spread. Seen from anywhere it has an area, over which their
// silhouettes are strewn: more evenly than by chance, as nobody sits in another.
class Crowding {
public:
    // One of them: where their middle is [m], as large as they are [m].
    void add(glm::vec3 middle, float height);

    // [0, 1] How much of each shows on average, seen in that direction (any length > 0) by silhouettes of that mean
    // area [m^2]: (1 + x^2)^(-1/2), where x is all silhouettes over the area that they are strewn over.
    float visible_share(glm::vec3 direction, float silhouette) const;

private:
    double count_ = 0;
    glm::dvec3 sum_{0.0};
    glm::dmat3 squares_{0.0};  // outer products of middles, and of bodies by themselves
};

}  // namespace render
