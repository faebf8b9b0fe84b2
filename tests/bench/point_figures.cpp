// How even point models are, as a table: what docs/point-models.md shows.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/io/gltf.h"
#include "motion/pose.h"
#include "pointsample/sample.h"
#include "pointsample/visibility.h"
#include "tests/pointsample/evaluate.h"
#include "tests/pointsample/surfaces.h"

namespace {

constexpr const char* usage =
    "usage: point_figures progressive|even|uniform POINTS all|visible SURFACE...\n"
    "SURFACE: sphere, plane, huge, plate, bumpy, scan, or a glTF file, which is taken at rest\n"
    "all|visible: whether hidden points count\n";

const std::map<std::string, std::function<model::Mesh()>, std::less<>> surfaces{
    {"sphere", tests::make_ball},          {"plane", tests::make_plane}, {"huge", tests::make_huge_among_tiny},
    {"plate", tests::make_cube_and_plate}, {"bumpy", tests::make_bumpy}, {"scan", tests::make_scan}};

model::Mesh at_rest(const std::string& file) {
    model::Character character = model::load_gltf(file);
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    std::vector<glm::vec3> positions, normals;
    motion::skin(character.mesh, pose, positions, normals);
    character.mesh.positions = positions;
    character.mesh.normals = normals;
    return character.mesh;
}

// Dense samples of the part of the surface that counts.
class Ground {
public:
    Ground(const model::Mesh& mesh, bool visible_only) : mesh_(mesh), area_(tests::area_of(mesh)) {
        if (!visible_only) return;
        visibility_ = std::make_unique<pointsample::Visibility>(mesh.positions, mesh.indices);
        constexpr std::size_t many = 1000000;
        area_ *= static_cast<double>(dense(many).size()) / static_cast<double>(many);
    }

    double area() const { return area_; }

    tests::Sample dense(std::size_t count) const {
        tests::Sample all = tests::dense(mesh_, count);
        if (!visibility_) return all;
        std::vector<pointsample::Place> places;
        for (std::size_t i = 0; i < all.size(); ++i)
            places.push_back({glm::vec3(all.positions[i]), glm::vec3(all.normals[i])});
        const std::vector<char> seen = visibility_->look(places, mesh_.double_sided());
        tests::Sample out;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!seen[i]) continue;
            out.positions.push_back(all.positions[i]);
            out.normals.push_back(all.normals[i]);
        }
        return out;
    }

private:
    const model::Mesh& mesh_;
    double area_;
    std::unique_ptr<pointsample::Visibility> visibility_;
};

// In patches due `fewest` to 2 `fewest` points.
double chi2(const Ground& ground, const tests::Sample& sample, std::size_t prefix, std::size_t fewest, bool by_normal) {
    int levels = 0;
    while (prefix >> (levels + 1) >= fewest) ++levels;
    constexpr std::size_t spots_per_point = 64;  // so that their own noise is a sixty-fourth of a random sample's
    return tests::Patches(ground.dense((fewest << levels) * spots_per_point), levels, by_normal).chi2(sample, prefix);
}

void print_row(const std::string& name, const Ground& ground, const tests::Sample& sample, std::size_t prefix) {
    using tests::Opposed;
    constexpr std::size_t fewest_spots = 200000, spots_per_point = 10, fewest_for_patches = 1024;
    const tests::Sample spots = ground.dense(std::max(fewest_spots, spots_per_point * prefix));
    const tests::Spread spread = tests::spread(sample, prefix, ground.area(), Opposed::doubled);
    const tests::Spread plain = tests::spread(sample, prefix, ground.area(), Opposed::same);
    const tests::Cover cover = tests::cover(spots, sample, prefix, ground.area(), Opposed::doubled);
    std::printf("| %s | %zu | %.3f | %.3f | %.3f | %.3f / %.3f |", name.c_str(), prefix, spread.min, plain.min,
                spread.mean, cover.max, cover.p99);
    if (prefix >= fewest_for_patches)
        std::printf(" %.3f | %.3f | %.3f |\n", chi2(ground, sample, prefix, 16, false),
                    chi2(ground, sample, prefix, 64, false), chi2(ground, sample, prefix, 64, true));
    else
        std::printf(" | | |\n");
    std::fflush(stdout);
}

void print_surface(const std::string& name, const pointsample::SampleOptions& options) {
    const auto known = surfaces.find(name);
    const model::Mesh mesh = known != surfaces.end() ? known->second() : at_rest(name);
    const pointsample::PosedMesh rest{mesh.positions, mesh.normals};
    const pointsample::PointModel model = pointsample::sample(mesh, {&rest, 1}, options);
    const tests::Sample sample = tests::sample_of(model, mesh);
    const Ground ground(mesh, options.visible_only);
    const std::string stem = name.substr(name.find_last_of('/') + 1);
    std::vector<std::size_t> prefixes{64, 256, 1024, 4096, 16384, options.count * 6 / 10, options.count};
    std::sort(prefixes.begin(), prefixes.end());
    if (options.order == pointsample::Order::even) prefixes = {options.count};
    for (const std::size_t prefix : prefixes)
        if (prefix <= options.count) print_row(stem, ground, sample, prefix);
}

pointsample::Order order_of(std::string_view name) {
    if (name == "progressive") return pointsample::Order::progressive;
    if (name == "even") return pointsample::Order::even;
    if (name == "uniform") return pointsample::Order::uniform;
    throw std::invalid_argument("found the order " + std::string(name) + "; expected progressive, even or uniform");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) {
        std::fputs(usage, stderr);
        return 2;
    }
    try {
        pointsample::SampleOptions options;
        options.order = order_of(argv[1]);
        options.count = std::max(1ul, std::strtoul(argv[2], nullptr, 10));
        options.visible_only = std::string_view(argv[3]) == "visible";
        std::puts("| surface | n | delta | plain delta | mean | cover max / 99 % | chi2 @16 | @64 | @64 by normal |");
        std::puts("|---|---|---|---|---|---|---|---|---|");
        for (int i = 4; i < argc; ++i) print_surface(argv[i], options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "point_figures: %s\n", error.what());
        return 1;
    }
}
