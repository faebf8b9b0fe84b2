// pointsample: a character's surface, in any pose, as an even sequence of coloured points.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/output.h"
#include "apps/places.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/warnings.h"
#include "model/clip_list.h"
#include "model/input_file.h"
#include "model/io/mesh_file.h"
#include "motion/pose.h"
#include "pointsample/model_key.h"
#include "pointsample/point_model.h"
#include "pointsample/points_file.h"
#include "pointsample/sample.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_points = 100'000'000;         // 7 GB
constexpr std::uint64_t most_ordered_points = 10'000'000;  // 4 GB

enum class Format { ply_binary, ply_ascii, pts };

struct Options {
    std::string input;
    std::uint64_t points = 0;  // [1, most_points]
    std::string output;
    bool ascii = false;
    std::optional<std::string> pose;  // none: the rest pose
    bool all_clips = false, visible_only = false, even = false, uniform = false, strict = false;
    std::uint64_t seed = 1;
    std::string stats;

    pointsample::Order order() const {
        if (uniform) return pointsample::Order::uniform;
        return even ? pointsample::Order::even : pointsample::Order::progressive;
    }
    Format format() const {
        if (fs::path(output).extension() == ".pts") return Format::pts;
        return ascii ? Format::ply_ascii : Format::ply_binary;
    }
};

constexpr const char* examples = R"(Examples:
  pointsample Fox.glb --points 10000 --out fox.ply
  pointsample Fox.glb --points 10000 --out fox.ply --pose Run@0.35 --visible-only --stats -
  pointsample Fox.glb --points 4096 --out fox.pts --all-clips --visible-only
  pointsample scan.obj --points 100000 --even --out even.ply
  pointsample Fox.glb --points 500 --out - --ascii --pose 2@0.35 | head

Any first part of the points is an even sample of the whole surface, unless --even or --uniform. A .ply has x y z nx ny nz
red green blue a point, in the file's units, x y z as doubles where a mesh lies far from the origin; a .pts is packed, and made to be mapped (docs/pts-format.md). The same arguments
give the same bytes.
)";

void add_options(CLI::App& app, Options& options) {
    apps::describe(app, examples);
    app.add_option("IN", options.input,
                   "Character or mesh: .glb, .gltf, .vrm, .obj, .ply, .stl or .off; the last four also as .gz")
        ->required();
    app.add_option("--points", options.points, "How many points, exactly")
        ->required()
        ->check(apps::whole_number(1, most_points));
    app.add_option("--out", options.output, "The points: OUT.ply or OUT.pts (- = stdout, as PLY)")->required();
    app.add_flag("--ascii", options.ascii, "Write the PLY as text");
    auto* pose =
        app.add_option("--pose", options.pose, "CLIP@SECONDS, the clip by name or index; default: the rest pose");
    app.add_flag("--all-clips", options.all_clips,
                 "Make the points for all clips, of 8 poses each, or fewer of many: more where the surface stretches, "
                 "and hidden is what is so in all of them")
        ->excludes(pose);
    app.add_flag("--visible-only", options.visible_only, "Replace points that cannot be seen from outside");
    auto* even = app.add_flag("--even", options.even, "One sample of just so many points, as even as can be");
    app.add_flag("--uniform", options.uniform, "Each point drawn by itself: fast, and as uneven as chance")
        ->excludes(even);
    app.add_option("--seed", options.seed, "Another seed, other points")
        ->check(apps::whole_number(0, std::numeric_limits<std::uint64_t>::max()))
        ->capture_default_str();
    app.add_flag("--strict", options.strict, "Refuse a file of which anything would be lost, instead of warning");
    app.add_option("--stats", options.stats, "Write what was found and done as JSON (- = stdout)");
}

struct PoseChoice {
    std::string clip;
    double seconds = 0;
};

// Throws std::invalid_argument. A clip's name may hold an @ of its own: the last one counts.
PoseChoice parse_pose(const std::string& text) {
    const std::size_t at = text.rfind('@');
    std::size_t used = 0;
    PoseChoice choice;
    try {
        if (at == std::string::npos) throw std::invalid_argument(text);
        choice = {text.substr(0, at), std::stod(text.substr(at + 1), &used)};
        if (used != text.size() - at - 1 || !std::isfinite(choice.seconds)) throw std::invalid_argument(text);
    } catch (const std::exception&) {
        throw std::invalid_argument("--pose: found '" + text + "', expected CLIP@SECONDS");
    }
    return choice;
}

const model::Clip& find_clip(const model::Character& character, const std::string& wanted) {
    for (const model::Clip& clip : character.clips)
        if (clip.name == wanted) return clip;
    const bool digits = !wanted.empty() && wanted.find_first_not_of("0123456789") == std::string::npos;
    if (digits && wanted.size() < 9 && std::stoul(wanted) < character.clips.size())
        return character.clips[std::stoul(wanted)];
    throw std::runtime_error("--pose: found no clip " + model::in_quotes(wanted) + ", expected " +
                             (character.clips.empty() ? "none, as the file has no clips"
                                                      : "an index below " + std::to_string(character.clips.size()) +
                                                            " or one of " + model::list_of(character.clips)));
}

// The first is the pose that the points are given in.
std::vector<pointsample::PosedMesh> poses_of(const model::Character& character, const Options& options) {
    if (!options.pose) {
        std::vector<pointsample::PosedMesh> poses = pointsample::spread_poses(character, {}, 1);
        if (!options.all_clips) return poses;
        std::vector<int> clips(character.clips.size());
        std::iota(clips.begin(), clips.end(), 0);
        if (clips.empty()) return poses;
        // Time and memory are proportional to poses, and some characters have a hundred clips.
        constexpr std::size_t most_each = 8, most = 64;
        const std::size_t each = std::clamp(most / clips.size(), std::size_t{1}, most_each);
        for (pointsample::PosedMesh& pose : pointsample::spread_poses(character, clips, each * clips.size()))
            poses.push_back(std::move(pose));
        return poses;
    }
    const PoseChoice chosen = parse_pose(*options.pose);
    motion::Pose pose;
    motion::evaluate(character, find_clip(character, chosen.clip), chosen.seconds, pose);
    std::vector<pointsample::PosedMesh> poses(1);
    motion::skin(character.mesh, pose, poses[0].positions, poses[0].normals);
    return poses;
}

void write_points(std::ostream& out, const pointsample::PointModel& model, const Options& options,
                  const std::string& key) {
    switch (options.format()) {
        case Format::pts:
            return pointsample::write_pts(out, model, key);
        case Format::ply_ascii:
            return pointsample::write_ply(out, model, pointsample::PlyFormat::ascii);
        case Format::ply_binary:
            return pointsample::write_ply(out, model, pointsample::PlyFormat::binary_little_endian);
    }
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts KiB
}

Json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json stats_of(const model::Mesh& mesh, const motion::Bounds& bounds, const pointsample::PointModel& model,
              std::span<const std::string> warnings, double seconds) {
    Json stats;
    stats["triangles"] = mesh.triangle_count();
    stats["vertices"] = mesh.vertex_count();
    stats["area"] = model.area;
    stats["bounds_min"] = json_of(mesh.origin + glm::dvec3(bounds.min));
    stats["bounds_max"] = json_of(mesh.origin + glm::dvec3(bounds.max));
    stats["points"] = model.size();
    stats["hidden_removed"] = model.hidden_removed;
    Json& coverage = stats["coverage"] = Json::array();
    for (const pointsample::Coverage& step : model.coverage)
        coverage.push_back({{"points", step.points}, {"radius", step.radius}});
    stats["warnings"] = warnings;
    stats["seconds"] = seconds;
    stats["peak_mb"] = peak_megabytes();
    return stats;
}

// What can't be sampled is refused by the file's name, as what can't be read is.
pointsample::PointModel sampled(const Options& options, const model::Character& character,
                                std::span<const pointsample::PosedMesh> poses,
                                const pointsample::SampleOptions& wanted) {
    apps::ProgressBar bar("Sampling " + character.name);
    try {
        return pointsample::sample(character.mesh, poses, wanted, [&](double fraction) { bar(fraction); });
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(options.input + ": " + error.what());
    }
}

void run(const Options& options) {
    const auto start = std::chrono::steady_clock::now();
    // Both are opened before the work: a run that fails leaves no new file.
    apps::OutputFile output(options.output);
    std::optional<apps::OutputFile> stats;
    if (!options.stats.empty()) stats.emplace(options.stats);

    const model::Character character = model::load_mesh(options.input);
    const std::vector<std::string> warnings = apps::lines_of(options.input, character.warnings);
    apps::say("pointsample", warnings, options.strict);
    const std::vector<pointsample::PosedMesh> poses = poses_of(character, options);
    const pointsample::SampleOptions wanted{static_cast<std::size_t>(options.points), options.seed, options.order(),
                                            options.visible_only};
    const pointsample::PointModel model = sampled(options, character, poses, wanted);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::string key =
        options.format() == Format::pts ? pointsample::model_key(character.mesh, poses, wanted) : std::string();
    write_points(output.stream(), model, options, key);
    if (stats) {
        const motion::Bounds bounds = motion::bounds_of(poses.front().positions);
        stats->stream() << stats_of(character.mesh, bounds, model, warnings, seconds.count()).dump(2) << '\n';
    }
    output.commit();
    if (stats) stats->commit();
}

// What CLI11 cannot see; throws std::invalid_argument.
void check(const Options& options) {
    if (options.pose) parse_pose(*options.pose);
    const std::string extension = fs::path(options.output).extension();
    if (options.output != "-" && extension != ".ply" && extension != ".pts" && !extension.empty())
        throw apps::wrong_argument("--out", "'" + options.output + "'", "a name that ends in .ply or .pts");
    if (options.ascii && options.format() == Format::pts)
        throw apps::wrong_argument("--ascii", "'" + options.output + "'", "a .ply");
    if (!options.uniform && options.points > most_ordered_points)
        throw apps::wrong_argument("--points", std::to_string(options.points),
                                   "at most " + std::to_string(most_ordered_points) + " without --uniform");
    const apps::Place inputs[] = {{"IN", options.input}};
    const apps::Place outputs[] = {{"--out", options.output}, {"--stats", options.stats}};
    apps::check_places(inputs, outputs);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Turns a character into points that cover its surface evenly.", "pointsample");
    Options options;
    add_options(app, options);
    return apps::run_program(
        app, argc, argv, [&] { check(options); }, [&] { run(options); });
}
