#include "render/staleness.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

constexpr std::size_t most_people = 256;     // looked at of each character and role
constexpr int looks = 4;                     // at each of them
constexpr int most_vertices = 24;            // that stand for a surface
constexpr std::int64_t tick_stride = 1009;   // a prime: no clip, wave or mood keeps in step with it
constexpr std::int64_t tick_range = 36'000;  // ten minutes

// Where a person's vertices are at a tick.
class Posture {
public:
    Posture(const scene::Crowd& crowd, std::size_t person, const scene::CastMember& member,
            const motion::PoseTable& table, std::int64_t tick)
        : table_(table),
          placement_(scene::place(crowd, person, member, tick)),
          scale_(crowd.height[person] / table_.rest_height),
          sin_(std::sin(placement_.yaw)),
          cos_(std::cos(placement_.yaw)) {
        const scene::Action action = scene::act(crowd, person, member, table_, tick);
        vertices_ = &table_.vertices[static_cast<std::size_t>(table_.pose_at(action.clip, action.clip_tick)) *
                                     static_cast<std::size_t>(table_.vertex_count)];
    }

    glm::vec3 at(int vertex) const {
        const glm::vec3 model = motion::unpack_position(vertices_[vertex], table_.box);
        return placement_.position +
               scale_ * glm::vec3(cos_ * model.x + sin_ * model.z, model.y, cos_ * model.z - sin_ * model.x);
    }

private:
    const motion::PoseTable& table_;
    scene::Placement placement_;
    float scale_;  // [m / model unit]
    float sin_, cos_;
    const motion::PosedVertex* vertices_;
};

// [m] Mean over some vertices.
double apart(const Posture& a, const Posture& b, int vertex_count) {
    const int stride = (vertex_count + most_vertices - 1) / most_vertices;
    double sum = 0;
    int count = 0;
    for (int vertex = 0; vertex < vertex_count; vertex += stride, ++count)
        sum += glm::distance(a.at(vertex), b.at(vertex));
    return sum / count;
}

Staleness measure(const scene::Crowd& crowd, const scene::CastMember& member, const motion::PoseTable& table,
                  std::span<const std::size_t> people) {
    std::array<double, motion::max_period> by_age{};
    const std::size_t step = (people.size() + most_people - 1) / most_people;
    std::int64_t look = 0;
    for (std::size_t i = 0; i < people.size(); i += step) {
        for (int n = 0; n < looks; ++n, ++look) {
            const std::int64_t tick = look * tick_stride % tick_range;
            const Posture now(crowd, people[i], member, table, tick);
            for (int age = 1; age < motion::max_period; ++age)
                by_age[age] += apart(now, Posture(crowd, people[i], member, table, tick - age), table.vertex_count);
        }
    }
    Staleness result{};
    double sum = 0;
    for (int period = 1; period <= motion::max_period && look > 0; ++period) {
        sum += by_age[period - 1] / static_cast<double>(look);
        result[period] = static_cast<float>(sum / period);
    }
    return result;
}

}  // namespace

std::vector<std::array<Staleness, scene::role_count>> measure_staleness(const scene::Crowd& crowd,
                                                                        std::span<const scene::CastMember> cast,
                                                                        std::span<const figures::Figure> figures) {
    std::vector<std::array<std::vector<std::size_t>, scene::role_count>> people(figures.size());
    for (std::size_t person = 0; person < crowd.size(); ++person)
        people[crowd.character[person]][static_cast<std::size_t>(crowd.role[person])].push_back(person);
    std::vector<std::array<Staleness, scene::role_count>> result(figures.size());
    for (std::size_t character = 0; character < figures.size(); ++character)
        for (int role = 0; role < scene::role_count; ++role)
            result[character][role] =
                measure(crowd, cast[character], *figures[character].poses, people[character][role]);
    return result;
}

}  // namespace render
