// A crowd small enough to be checked one by one, made as the stadium makes its own.
#pragma once

#include <memory>
#include <vector>

#include "motion/pose.h"
#include "pointsample/point_model.h"
#include "pointsample/sample.h"
#include "render/select.h"
#include "scene/cast.h"
#include "scene/crowd.h"
#include "scene/person.h"
#include "scene/places/stadium.h"

namespace tests {

struct SmallScene {
    model::Character person = scene::make_person();
    scene::StadiumPlan plan;
    pointsample::PointModel points;
    std::vector<scene::CastMember> cast;
    std::vector<motion::PoseTable> poses;
    scene::Crowd crowd;

    // The person's model has so many points for each of its triangles.
    explicit SmallScene(std::int64_t people, double points_each = 0.5) {
        const scene::Casting casting = scene::cast(person);
        pointsample::SampleOptions options;
        options.count = static_cast<std::size_t>(points_each * static_cast<double>(person.mesh.triangle_count()));
        points = pointsample::sample(person.mesh, pointsample::spread_poses(person, {}, 1), options);
        poses.push_back(motion::bake_poses(person, casting.clips, points.surface, std::size_t{1} << 26));
        cast.push_back(casting.member);
        plan = scene::plan_stadium(people);
        crowd = scene::populate(plan, {people, cast, poses, 1});
    }

    std::vector<figures::Figure> figures() const { return {{&person.mesh, &poses[0], &points}}; }
};

}  // namespace tests
