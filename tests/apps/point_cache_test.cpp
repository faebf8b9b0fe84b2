#include "apps/point_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "pointsample/model_key.h"
#include "pointsample/points_file.h"
#include "pointsample/sample.h"
#include "scene/person.h"
#include "tests/command.h"

namespace {

namespace fs = std::filesystem;
using apps::PointCache;
using pointsample::PointModel;

constexpr const char* key = "0123456789abcdef0123456789abcdef";

PointModel made(std::size_t count = 300) {
    const model::Character person = scene::make_person();
    pointsample::SampleOptions options;
    options.count = count;
    return pointsample::sample(person.mesh, pointsample::spread_poses(person, {}, 1), options);
}

// What drawing reads.
bool same(const PointModel& a, const PointModel& b) {
    const auto same_place = [](const motion::SurfacePoint& p, const motion::SurfacePoint& q) {
        return p.triangle == q.triangle && p.u == q.u && p.v == q.v;
    };
    return std::equal(a.surface.begin(), a.surface.end(), b.surface.begin(), b.surface.end(), same_place) &&
           a.positions == b.positions && a.normals == b.normals && a.colors == b.colors && a.slots == b.slots &&
           a.joints == b.joints && a.weights == b.weights && a.spacing == b.spacing && a.area == b.area;
}

struct Counted {
    std::atomic<int> calls{0};
    PointModel model = made();
    PointModel operator()() {
        ++calls;
        return model;
    }
};

PointModel get(const PointCache& cache, Counted& counted) {
    return cache.get(key, [&] { return counted(); });
}

TEST(PointCache, MakesAModelOnce) {
    const tests::Directory directory;
    Counted counted;
    const PointCache cache(directory / "new/folder");
    const PointModel first = get(cache, counted), second = get(cache, counted);
    EXPECT_EQ(counted.calls, 1);
    EXPECT_EQ(first.size(), 300u);
    EXPECT_TRUE(same(first, second));
}

TEST(PointCache, DrawsTheSameWithAndWithout) {
    const tests::Directory directory;
    Counted counted;
    const PointCache with(directory / "cache"), without{fs::path()};
    const PointModel fresh = get(without, counted);
    get(with, counted);
    EXPECT_TRUE(same(fresh, get(with, counted)));
    EXPECT_EQ(counted.calls, 2);
}

TEST(PointCache, MakesADamagedFileAgain) {
    const tests::Directory directory;
    Counted counted;
    const PointCache cache(directory / "cache");
    const PointModel whole = get(cache, counted);
    const std::string file = directory / ("cache/" + std::string(key) + ".pts");
    const std::string bytes = tests::read_file(file);
    std::string flipped = bytes;
    flipped[bytes.size() / 2] ^= 1;
    int calls = counted.calls;
    for (const std::string& damaged :
         {flipped, bytes.substr(0, bytes.size() / 2), std::string(), std::string(5000, 'x')}) {
        std::ofstream(file, std::ios::binary) << damaged;
        EXPECT_TRUE(same(whole, get(cache, counted)));
        EXPECT_EQ(counted.calls, ++calls) << "made again";
        EXPECT_EQ(tests::read_file(file), bytes) << "and kept";
    }
}

TEST(PointCache, DoesNotTakeAnotherInputsModel) {
    const tests::Directory directory;
    Counted counted;
    const PointCache cache(directory / "cache");
    get(cache, counted);
    const std::string other = "f" + std::string(key).substr(1);
    fs::rename(directory / ("cache/" + std::string(key) + ".pts"), directory / ("cache/" + other + ".pts"));
    cache.get(other, [&] { return counted(); });
    EXPECT_EQ(counted.calls, 2);
}

TEST(PointCache, GoesOnWithoutAPlaceToKeepIt) {
    const tests::Directory directory;
    std::ofstream(directory / "file") << "no folder";
    Counted counted;
    EXPECT_EQ(get(PointCache(directory / "file"), counted).size(), 300u);
    EXPECT_EQ(get(PointCache(directory / "file/below"), counted).size(), 300u);
    EXPECT_EQ(tests::read_file(directory / "file"), "no folder");
}

TEST(PointCache, ManyMayMakeOneModelAtOnce) {
    const tests::Directory directory;
    Counted counted;
    const PointModel expected = get(PointCache{fs::path()}, counted);
    std::vector<std::thread> threads;
    std::atomic<int> right{0};
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([&] { right += same(expected, get(PointCache(directory / "cache"), counted)); });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, 8);
    const int calls = counted.calls;
    EXPECT_TRUE(same(expected, get(PointCache(directory / "cache"), counted)));
    EXPECT_EQ(counted.calls, calls) << "a whole file is left";
    EXPECT_EQ(std::distance(fs::directory_iterator(directory / "cache"), {}), 1) << "and nothing else";
}

TEST(PointCache, LivesWhereUsersKeepCaches) {
    setenv("XDG_CACHE_HOME", "/somewhere", 1);
    EXPECT_EQ(apps::default_cache(), "/somewhere/grandstand");
    unsetenv("XDG_CACHE_HOME");
    setenv("HOME", "/home/me", 1);
    EXPECT_EQ(apps::default_cache(), "/home/me/.cache/grandstand");
    setenv("XDG_CACHE_HOME", "", 1);
    EXPECT_EQ(apps::default_cache(), "/home/me/.cache/grandstand") << "empty is not set";
    unsetenv("HOME");
    EXPECT_TRUE(apps::default_cache().empty());
}

// Whatever sample() reads is in the key, and nothing else is.
TEST(ModelKey, ChangesWithEverythingThatIsRead) {
    const model::Character person = scene::make_person();
    const std::vector<pointsample::PosedMesh> poses = pointsample::spread_poses(person, {}, 1);
    const pointsample::SampleOptions options;
    const std::string usual = pointsample::model_key(person.mesh, poses, options);
    EXPECT_EQ(usual.size(), 32u);
    EXPECT_EQ(usual, pointsample::model_key(person.mesh, poses, options));
    std::vector<std::string> others;
    const auto with_options = [&](auto change) {
        pointsample::SampleOptions changed;
        change(changed);
        others.push_back(pointsample::model_key(person.mesh, poses, changed));
    };
    with_options([](auto& o) { ++o.count; });
    with_options([](auto& o) { ++o.seed; });
    with_options([](auto& o) { o.order = pointsample::Order::even; });
    with_options([](auto& o) { o.visible_only = false; });
    const auto with_mesh = [&](auto change) {
        model::Mesh changed = person.mesh;
        change(changed);
        others.push_back(pointsample::model_key(changed, poses, options));
    };
    with_mesh([](auto& m) { std::swap(m.indices[0], m.indices[1]); });
    with_mesh([](auto& m) { m.colors[3].g ^= 1; });
    with_mesh([](auto& m) { m.weights[5].x *= 0.5f; });
    with_mesh([](auto& m) { m.materials[0].double_sided ^= true; });
    with_mesh([](auto& m) { m.materials[0].texture = 7; });
    with_mesh([](auto& m) { m.materials[0].emissive_texture = 7; });
    with_mesh([](auto& m) { m.materials[0].emissive.g = 0.5f; });
    with_mesh([](auto& m) { m.materials[0].sampler.across = model::Wrap::clamp; });
    with_mesh([](auto& m) { m.materials[0].sampler.down = model::Wrap::clamp; });
    with_mesh([](auto& m) { m.materials[0].sampler.nearest = true; });
    with_mesh([](auto& m) { m.materials[0].alpha_cutoff = 0.5f; });
    with_mesh([](auto& m) { m.materials[0].unlit = true; });
    with_mesh([](auto& m) { m.material_ids[3] = 1; });
    with_mesh([](auto& m) { m.textures.push_back({1, 1, {{1, 2, 3, 4}}}); });
    std::vector<pointsample::PosedMesh> moved = poses;
    moved[0].positions[7].y += 1e-6f;
    others.push_back(pointsample::model_key(person.mesh, moved, options));
    moved = poses;
    moved.push_back(poses[0]);
    others.push_back(pointsample::model_key(person.mesh, moved, options));
    others.push_back(usual);
    std::sort(others.begin(), others.end());
    EXPECT_EQ(std::adjacent_find(others.begin(), others.end()), others.end());
}

}  // namespace
