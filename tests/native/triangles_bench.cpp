// What people drawn as triangles cost: those whom a frame of the stadium draws so, front to back. One thread; processor
// time by stages, the median and the worst of the runs.
//   native_triangles_bench [people] [camera] [target]
#include <hwy/targets.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/native/layers.h"
#include "tests/native/mesh_people.h"
#include "tests/render/small_scene.h"

namespace {

double processor_us() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

struct Stages {
    double prepare = 0, draw = 0, resolve = 0;  // [us]
    double total() const { return prepare + draw + resolve; }
};

Stages run(render::native::TrianglePeople& people, const render::View& view,
           std::span<const render::Person* const> whom, const render::native::BackdropPicture& behind,
           render::native::NearLayer& layer) {
    Stages stages;
    const double begin = processor_us();
    people.prepare(view, whom);
    stages.prepare = processor_us() - begin;
    for (int y = 0; y < view.height; y += render::native::tile_side) {
        for (int x = 0; x < view.width; x += render::native::tile_side) {
            const double start = processor_us();
            const render::native::Tile tile{x, y, std::min(x + render::native::tile_side, view.width),
                                            std::min(y + render::native::tile_side, view.height)};
            layer.begin(tile, behind);
            for (std::size_t i = 0; i < people.size(); ++i) {
                const render::native::Rect r = people.bounds(i);
                if (r.x0 < tile.x1 && r.x1 > tile.x0 && r.y0 < tile.y1 && r.y1 > tile.y0) people.draw(i, layer);
            }
            const double drawn = processor_us();
            layer.resolve();
            stages.draw += drawn - start;
            stages.resolve += processor_us() - drawn;
        }
    }
    return stages;
}

// By total time.
std::vector<Stages> measure(render::native::TrianglePeople& people, const render::View& view,
                            std::span<const render::Person* const> whom,
                            const render::native::BackdropPicture& behind) {
    constexpr int runs = 51;
    render::native::NearLayer layer;
    std::vector<Stages> times;
    tbb::task_arena arena(1);
    arena.execute([&] {
        run(people, view, whom, behind, layer);
        for (int i = 0; i < runs; ++i) times.push_back(run(people, view, whom, behind, layer));
    });
    std::ranges::sort(times, {}, &Stages::total);
    return times;
}

void report(const std::string& name, const std::vector<Stages>& times, const render::native::TrianglePeople& people,
            double triangles) {
    std::size_t shown = 0;
    double heights = 0;
    for (std::size_t i = 0; i < people.size(); ++i) {
        const render::native::Rect r = people.bounds(i);
        shown += !r.empty();
        heights += r.y1 - r.y0;
    }
    const auto n = static_cast<double>(people.size());
    std::printf("%s: %zu people, %zu shown, mean height %.0f px\n", name.c_str(), people.size(), shown,
                heights / static_cast<double>(std::max<std::size_t>(shown, 1)));
    for (const auto& [which, t] : {std::pair{"median", times[times.size() / 2]}, std::pair{"worst", times.back()}})
        std::printf("  %-7s %6.2f us a person: prepare %.2f draw %.2f resolve %.2f; %.1f ns a triangle\n", which,
                    t.total() / n, t.prepare / n, t.draw / n, t.resolve / n, 1e3 * t.total() / n / triangles);
}

}  // namespace

int main(int argc, char** argv) {
    const int count = argc > 1 ? std::atoi(argv[1]) : 20000;
    const std::string camera = argc > 2 ? argv[2] : "still";
    if (argc > 3) hwy::SetSupportedTargetsForTest(std::strtoll(argv[3], nullptr, 0));
    constexpr int width = 1280, height = 720;
    tests::SmallScene scene(count);
    const render::View view = render::make_view(scene::aim_cameras(scene.plan).named(camera).at(0), width, height);
    render::Selector selector(scene.crowd, scene.cast, scene.figures(), {.way = &figures::natively()});
    selector.survey(view, 0);
    tests::MeshPeople all(tests::mesh_people(selector.select({sfsm::State::points, 0, 2}, -1)));
    std::ranges::sort(all.pointers, {}, &render::Person::depth);
    const auto behind = tests::backdrop(width, height);
    const auto figures = scene.figures();
    const double triangles = static_cast<double>(scene.person.mesh.triangle_count());
    render::native::TrianglePeople people(figures, {});
    report(camera + ", all", measure(people, view, all.pointers, behind), people, triangles);
    people.prepare(view, all.pointers);
    std::vector<const render::Person*> middling;
    for (std::size_t i = 0; i < people.size(); ++i) {
        const render::native::Rect r = people.bounds(i);
        if (r.y1 - r.y0 >= 60 && r.y1 - r.y0 <= 150) middling.push_back(all.pointers[i]);
    }
    report(camera + ", 60 to 150 px", measure(people, view, middling, behind), people, triangles);
}
