#include "tests/bench/loss/in_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/bench/front/posture.h"

namespace bench::loss {

namespace {

constexpr int fringe = 2;          // [px]
constexpr float as_vertices = 12;  // [px] whoever is lower
constexpr double widest = 1e5;     // [px^2] triangles that are larger reach behind the camera

class Canvas {
public:
    explicit Canvas(const render::View& view)
        : view_(view),
          depth_(static_cast<std::size_t>(view.width) * view.height, std::numeric_limits<float>::max()),
          who_(depth_.size(), nobody) {}

    // x, y [px], view depth [m]
    glm::vec3 on_screen(const glm::vec3& at) const {
        const float depth = view_.depth(at), pixels = view_.pixels_per_metre(std::max(depth, render::near_plane));
        return {0.5f * static_cast<float>(view_.width) + pixels * glm::dot(view_.right, at),
                0.5f * static_cast<float>(view_.height) - pixels * glm::dot(view_.up, at), depth};
    }
    void put(int x, int y, float depth, std::int32_t who) {
        if (x < 0 || y < 0 || x >= view_.width || y >= view_.height || depth < render::near_plane) return;
        const std::size_t at = static_cast<std::size_t>(y) * view_.width + x;
        if (depth >= depth_[at]) return;
        depth_[at] = depth;
        who_[at] = who;
    }
    void put(const std::array<glm::vec3, 3>& corner, std::int32_t who) {
        const auto [left, right] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
        const auto [top, bottom] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
        const float nearest = std::min({corner[0].z, corner[1].z, corner[2].z});
        if (nearest < render::near_plane || double{right - left} * double{bottom - top} > widest) return;
        const float depth = (corner[0].z + corner[1].z + corner[2].z) / 3;
        const auto side = [](const glm::vec3& a, const glm::vec3& b, float x, float y) {
            return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
        };
        const int last_x = std::min(static_cast<int>(right), view_.width - 1);
        const int last_y = std::min(static_cast<int>(bottom), view_.height - 1);
        for (int y = std::max(0, static_cast<int>(top)); y <= last_y; ++y)
            for (int x = std::max(0, static_cast<int>(left)); x <= last_x; ++x) {
                const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
                const float a = side(corner[0], corner[1], px, py), b = side(corner[1], corner[2], px, py),
                            c = side(corner[2], corner[0], px, py);
                if (std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0) put(x, y, depth, who);
            }
    }
    // Whom is beside a pixel of nobody.
    void widen() {
        const std::vector<std::int32_t> before = who_;
        for (int y = 0; y < view_.height; ++y)
            for (int x = 0; x < view_.width; ++x) {
                std::int32_t& who = who_[static_cast<std::size_t>(y) * view_.width + x];
                for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                    const int nx = x + dx, ny = y + dy;
                    if (who != nobody || nx < 0 || ny < 0 || nx >= view_.width || ny >= view_.height) continue;
                    who = before[static_cast<std::size_t>(ny) * view_.width + nx];
                }
            }
    }
    std::vector<std::int32_t> take() { return std::move(who_); }

private:
    const render::View& view_;
    std::vector<float> depth_;
    std::vector<std::int32_t> who_;
};

// Of the smallest, few vertices are enough.
int stride_of(float height) {
    return height < 1.5f ? 16 : height < 4 ? 4 : 1;
}

void put_vertices(const render::Person& person, const motion::PoseTable& poses, float height, std::int32_t who,
                  Canvas& canvas) {
    const front::Posture posture = front::Posture::of(person);
    for (int vertex = 0; vertex < poses.vertex_count; vertex += stride_of(height)) {
        const glm::vec3 at = canvas.on_screen(posture.at(poses, vertex));
        canvas.put(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)), at.z, who);
    }
}

void put_triangles(const render::Person& person, const figures::Figure& figure, std::int32_t who, Canvas& canvas) {
    std::vector<glm::vec3> corners(static_cast<std::size_t>(figure.poses->vertex_count));
    const front::Posture posture = front::Posture::of(person);
    for (int vertex = 0; vertex < figure.poses->vertex_count; ++vertex)
        corners[static_cast<std::size_t>(vertex)] = canvas.on_screen(posture.at(*figure.poses, vertex));
    const auto& indices = figure.mesh->indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        canvas.put({corners[indices[i]], corners[indices[i + 1]], corners[indices[i + 2]]}, who);
}

}  // namespace

std::vector<std::int32_t> in_front(const front::Present& present, const apps::Stage& stage, const render::View& view) {
    Canvas canvas(view);
    const auto figures = stage.figures();
    for (std::size_t i = 0; i < present.people.size(); ++i) {
        const render::Person& person = present.people[i];
        const figures::Figure& figure = figures[person.character];
        const float height = person.instance.scale * figure.poses->rest_height * view.pixels_per_metre(person.depth);
        if (height < as_vertices)
            put_vertices(person, *figure.poses, height, static_cast<std::int32_t>(i), canvas);
        else
            put_triangles(person, figure, static_cast<std::int32_t>(i), canvas);
    }
    for (int pass = 0; pass < fringe; ++pass) canvas.widen();
    return canvas.take();
}

}  // namespace bench::loss
