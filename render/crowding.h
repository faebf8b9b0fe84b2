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

    // [0, 1] How much of each shows on average, of silhouettes of that mean area [m^2] whose middle is `away` [m] from
    // the eye, not 0: (1 + x^2)^(-1/2), where x is all silhouettes over the area that they are strewn over. Who is
    // nearer looks larger and is seen more steeply, which matters in a block that is deeper than it is far: x then is
    // of a nearer one.
    float visible_share(glm::vec3 away, float silhouette) const;

private:
    double count_ = 0;
    glm::dvec3 sum_{0.0};
    glm::dmat3 squares_{0.0};  // outer products of middles, and of bodies by themselves
};

}  // namespace render
