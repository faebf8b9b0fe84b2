#include "pointsample/hidden.h"

#include <cstddef>
#include <numeric>

namespace pointsample {

HiddenTest::HiddenTest(const Surface& surface, bool two_sided)
    : surface_(surface), two_sided_(two_sided), scenes_(surface.poses().size()) {}

std::vector<char> HiddenTest::visible(std::span<const motion::SurfacePoint> points) {
    std::vector<char> visible(points.size(), 0);
    std::vector<std::size_t> unseen(points.size());
    std::iota(unseen.begin(), unseen.end(), std::size_t{0});
    std::vector<Place> places;
    for (std::size_t pose = 0; pose < scenes_.size() && !unseen.empty(); ++pose) {
        const PosedMesh& posed = surface_.poses()[pose];
        if (!scenes_[pose]) scenes_[pose] = std::make_unique<Visibility>(posed.positions, surface_.indices());
        places.clear();
        for (const std::size_t i : unseen) places.push_back(place_of(points[i], surface_.indices(), posed));
        const std::vector<char> seen = scenes_[pose]->look(places, two_sided_);
        std::size_t left = 0;
        for (std::size_t k = 0; k < unseen.size(); ++k) {
            visible[unseen[k]] = seen[k];
            if (!seen[k]) unseen[left++] = unseen[k];
        }
        unseen.resize(left);
    }
    return visible;
}

}  // namespace pointsample
