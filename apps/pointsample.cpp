// pointsample: a character's surface, in any pose, as an even sequence of coloured points.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/output.h"
#include "apps/places.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "motion/pose.h"
#include "pointsample/gltf.h"
#include "pointsample/point_model.h"
#include "pointsample/points_file.h"
#include "pointsample/sample.h"

namespace {

constexpr std::uint64_t most_points = 100'000'000;

struct Options {
    std::string input;
    std::uint64_t points = 0;  // [1, most_points]
    std::string output;
    std::string pose;  // empty: the rest pose
    bool visible_only = false;
    std::uint64_t seed = 1;
    std::string stats;
};

constexpr const char* examples = R"(Examples:
  pointsample Fox.glb --points 10000 --out fox.ply
  pointsample Fox.glb --points 10000 --out fox.ply --pose Run@0.35 --visible-only --stats -
  pointsample Fox.glb --points 500 --out - --pose 2@0.35 > fox.ply

The PLY is binary: x y z nx ny nz red green blue a point, in the file's units. Any first part of it covers the whole
surface evenly, and the same arguments give the same bytes.
)";

void add_options(CLI::App& app, Options& options) {
    apps::describe(app, examples);
    app.add_option("IN", options.input, "Character, glTF 2.0: .glb or .gltf")->required();
    app.add_option("--points", options.points, "How many points, exactly")
        ->required()
        ->check(apps::whole_number(1, most_points));
    app.add_option("--out", options.output, "The points as PLY (- = stdout)")->required();
    app.add_option("--pose", options.pose, "CLIP@SECONDS, the clip by name or index; default: the rest pose");
    app.add_flag("--visible-only", options.visible_only, "Replace points that cannot be seen from outside");
    app.add_option("--seed", options.seed, "Another seed, other points")
        ->check(apps::whole_number(0, std::numeric_limits<std::uint64_t>::max()))
        ->capture_default_str();
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

const motion::Clip& find_clip(const motion::Character& character, const std::string& wanted) {
    for (const motion::Clip& clip : character.clips)
        if (clip.name == wanted) return clip;
    const bool digits = !wanted.empty() && wanted.find_first_not_of("0123456789") == std::string::npos;
    if (digits && wanted.size() < 9 && std::stoul(wanted) < character.clips.size())
        return character.clips[std::stoul(wanted)];
    std::string names;
    for (const motion::Clip& clip : character.clips) names += (names.empty() ? "" : ", ") + clip.name;
    throw std::runtime_error(
        "--pose: found no clip '" + wanted + "', expected " +
        (character.clips.empty() ? "none, as the file has no clips"
                                 : "an index below " + std::to_string(character.clips.size()) + " or one of " + names));
}

pointsample::PosedMesh posed(const motion::Character& character, const std::string& choice) {
    motion::Pose pose;
    if (choice.empty()) {
        motion::evaluate_rest(character, pose);
    } else {
        const PoseChoice chosen = parse_pose(choice);
        motion::evaluate(character, find_clip(character, chosen.clip), chosen.seconds, pose);
    }
    pointsample::PosedMesh surface;
    motion::skin(character.mesh, pose, surface.positions, surface.normals);
    return surface;
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts KiB
}

std::string json_of(const glm::vec3& v) {
    std::ostringstream out;
    out << std::setprecision(9) << '[' << v.x << ", " << v.y << ", " << v.z << ']';
    return out.str();
}

void write_stats(std::ostream& out, const motion::Mesh& mesh, const motion::Bounds& bounds,
                 const pointsample::PointModel& model, double seconds) {
    out << std::setprecision(9) << "{\n  \"triangles\": " << mesh.triangle_count()
        << ",\n  \"vertices\": " << mesh.vertex_count() << ",\n  \"area\": " << model.area
        << ",\n  \"bounds_min\": " << json_of(bounds.min) << ",\n  \"bounds_max\": " << json_of(bounds.max)
        << ",\n  \"points\": " << model.size() << ",\n  \"hidden_removed\": " << model.hidden_removed
        << ",\n  \"seconds\": " << seconds << ",\n  \"peak_mb\": " << peak_megabytes() << "\n}\n";
}

void run(const Options& options) {
    const auto start = std::chrono::steady_clock::now();
    // Both are opened before the work: a run that fails leaves no new file.
    apps::OutputFile output(options.output);
    std::optional<apps::OutputFile> stats;
    if (!options.stats.empty()) stats.emplace(options.stats);

    const motion::Character character = pointsample::load_gltf(options.input);
    const pointsample::PosedMesh surface = posed(character, options.pose);
    pointsample::PointModel model;
    {
        apps::ProgressBar bar("Sampling " + character.name);
        model = pointsample::sample(character.mesh, {&surface, 1},
                                    {static_cast<std::size_t>(options.points), options.seed,
                                     pointsample::Order::progressive, options.visible_only},
                                    [&](double fraction) { bar(fraction); });
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    pointsample::write_ply(output.stream(), model, pointsample::PlyFormat::binary_little_endian);
    if (stats) {
        write_stats(stats->stream(), character.mesh, motion::bounds_of(surface.positions), model, seconds.count());
    }
    output.commit();
    if (stats) stats->commit();
}

// What CLI11 cannot see; throws std::invalid_argument.
void check(const Options& options) {
    if (!options.pose.empty()) parse_pose(options.pose);
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
