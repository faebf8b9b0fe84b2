#include "apps/stadium_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>

#include "scene/camera_path.h"
#include "sfsm/controller.h"

namespace apps {

namespace {

constexpr int usage_error = 2;
constexpr int largest_side = 8192;  // [px]

constexpr const char* examples = R"(
Examples:
  stadium                                       roam the stadium at 60 frames a second
  stadium --people 50000 --target-ms 33         more people, a gentler target
  stadium --headless --camera close --frames 1 --state 0 --png close.png
  stadium --headless --law paper --target-ms 1000,300@30,95@100 --frames 200 --trace t.csv --summary -
  stadium --character Fox.glb --character CesiumMan.glb

In the window: W A S D, E, Q and a dragged mouse fly (shift: faster), 1-5 choose a camera, + and - change the target,
P pauses, F12 saves a screenshot, Esc leaves.)";

std::invalid_argument wrong(const std::string& option, const std::string& found, const std::string& expected) {
    return std::invalid_argument(option + ": found " + found + ", expected " + expected);
}

std::optional<int> whole_number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

void set_size(StadiumOptions& options, const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto width = whole_number(text.substr(0, cross));
    const auto height = cross == std::string::npos ? std::nullopt : whole_number(text.substr(cross + 1));
    const auto fits = [](std::optional<int> side) { return side && *side >= 1 && *side <= largest_side; };
    if (!fits(width) || !fits(height))
        throw wrong("--size", "'" + text + "'", "WIDTHxHEIGHT with sides from 1 to " + std::to_string(largest_side));
    options.width = *width;
    options.height = *height;
}

void set_state(StadiumOptions& options, const std::string& text) {
    if (text == "auto") return;
    if (text != "0" && text != "1" && text != "2") throw wrong("--state", "'" + text + "'", "auto, 0, 1 or 2");
    options.state = static_cast<sfsm::State>(text[0] - '0');
}

void set_target(StadiumOptions& options, const std::string& text) {
    try {
        options.target = sfsm::TargetSchedule::parse(text);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(std::string("--target-ms: ") + error.what());
    }
}

// The rules between options, and ranges that CLI11 doesn't know.
void validate(const StadiumOptions& options) {
    if (options.people < 1 || options.people > 1'000'000)
        throw wrong("--people", std::to_string(options.people), "1 to 1000000");
    if (options.frames && (*options.frames < 1 || *options.frames > 10'000'000))
        throw wrong("--frames", std::to_string(*options.frames), "1 to 10000000");
    if (options.splat_size && !(*options.splat_size > 0 && *options.splat_size <= sfsm::max_splat_size))
        throw wrong("--splat-px", std::to_string(*options.splat_size), "more than 0 and at most 32");
    if (options.motion_distance && !(*options.motion_distance > 0 && *options.motion_distance < 1e9))
        throw wrong("--motion-distance", std::to_string(*options.motion_distance), "more than 0 metres");
    if (options.splat_size && options.state != sfsm::State::points)
        throw wrong("--splat-px", "another state", "--state 2, whose splats it sizes");
    if (options.motion_distance && (!options.state || options.state == sfsm::State::original))
        throw wrong("--motion-distance", "another state", "--state 1 or --state 2, which it is part of");
    if ((options.png_every > 0) != !options.png_directory.empty())
        throw wrong("--png-every", "one of --png-every and --png-dir", "both or neither");
    if (options.png_every < 0) throw wrong("--png-every", std::to_string(options.png_every), "at least 1");
    if (!scene::is_preset(options.camera) && std::filesystem::path(options.camera).extension() != ".json")
        throw wrong("--camera", "'" + options.camera + "'", "still, close, medium, remote, roam or a FILE.json");
    if ((options.trace == "-") + (options.png == "-") + (options.summary == "-") > 1)
        throw wrong("-", "several outputs on stdout", "one");
}

void parse(CLI::App& app, StadiumOptions& options, int argc, char** argv) {
    std::string target = options.target.text(), state = "auto", size = "1280x720";
    app.footer(examples);
    app.set_version_flag("--version", std::string("stadium ") + GRANDSTAND_VERSION);
    app.add_option("--people", options.people, "How many people [1, 1000000]")->capture_default_str();
    app.add_option("--character", options.characters, "glTF or GLB file to fill the stadium with; several mix")
        ->take_all();
    app.add_option("--target-ms", target, "Frame time to hold [ms]; X,Y@N,Z@M changes it at frames N and M")
        ->capture_default_str();
    app.add_option("--law", options.law, "The controller's law: " + CLI::detail::join(sfsm::law_names(), ", "))
        ->capture_default_str();
    app.add_option("--state", state, "auto: the law decides; 0 all triangles, 1 slower motion far off, 2 points")
        ->capture_default_str();
    app.add_option("--splat-px", options.splat_size, "Splat size S with --state 2 [px] (default 2)");
    app.add_option("--motion-distance", options.motion_distance,
                   "D with --state 1 or 2 [m] (default 5/6 and 2/3 of the farthest person's depth)");
    app.add_option("--camera", options.camera, "still, close, medium, remote, roam or a FILE.json with keys")
        ->capture_default_str();
    app.add_option("--frames", options.frames, "Frames to draw (default: 300 without a window, else until closed)");
    app.add_option("--size", size, "Picture's WIDTHxHEIGHT [px]")->capture_default_str();
    app.add_option("--seed", options.seed, "Who sits where, looks how and does what")->capture_default_str();
    app.add_flag("--headless", options.headless, "No window, even if there is a display");
    app.add_flag("--dt", options.fixed_step, "Advance the scene 1/60 s a frame in a window too");
    app.add_option("--trace", options.trace, "Write a row a frame to this CSV file; - = stdout");
    app.add_option("--png", options.png, "Write the last frame to this PNG file; - = stdout");
    app.add_option("--png-every", options.png_every, "Write every K-th frame into --png-dir");
    app.add_option("--png-dir", options.png_directory, "Directory for --png-every; made if missing");
    app.add_option("--summary", options.summary, "Write the run's figures to this JSON file; - = stdout");
    app.parse(argc, argv);
    set_target(options, target);
    set_state(options, state);
    set_size(options, size);
    sfsm::make_controller(options.law);  // throws for a law there isn't
    validate(options);
}

}  // namespace

StadiumOptions parse_stadium_options(int argc, char** argv) {
    CLI::App app{"A stadium of animated people, drawn as finely as the frame time allows.", "stadium"};
    StadiumOptions options;
    options.law = sfsm::law_names().front();
    try {
        parse(app, options, argc, argv);
    } catch (const CLI::Success& request) {  // --help and --version
        throw Exit{app.exit(request)};
    } catch (const std::exception& error) {
        std::cerr << "stadium: " << error.what() << "; see stadium --help\n";
        throw Exit{usage_error};
    }
    return options;
}

}  // namespace apps
