#include "apps/stadium_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "apps/places.h"
#include "apps/program.h"
#include "scene/cameras.h"
#include "sfsm/number_text.h"

namespace apps {

namespace {

constexpr int largest_side = 8192;           // [px]
constexpr std::size_t most_characters = 64;  // they share one budget for their poses

constexpr const char* examples = R"(Examples:
  stadium                                       roam the stadium at 60 frames a second
  stadium --people 50000 --target-ms 33         more people, a gentler target
  stadium --headless --camera close --frames 1 --state 0 --png close.png
  stadium --headless --law paper --target-ms 1000,300@30,95@100 --frames 200 --trace t.csv --summary -
  stadium --character Fox.glb --character CesiumMan.glb
  stadium --character Fox.glb:3 --act stand=Survey --character CesiumMan.glb:1 --turn 90 --verbose
  stadium --gallery Fox.glb CesiumMan.glb --png sheet.png

In the window: W A S D, E, Q and a dragged mouse fly (shift: faster), 1 to 5 choose a camera, + and - change the
target, P pauses, F12 saves a screenshot, Esc leaves.
)";

std::optional<int> side(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > largest_side)
        return std::nullopt;
    return value;
}

void set_size(StadiumOptions& options, const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const auto width = side(std::string_view(text).substr(0, cross));
    const auto height = side(std::string_view(text).substr(std::min(cross + 1, text.size())));
    if (!width || !height)
        throw wrong_argument("--size", "'" + text + "'",
                             "WIDTHxHEIGHT with sides from 1 to " + std::to_string(largest_side));
    options.width = *width;
    options.height = *height;
}

void set_drawing(StadiumOptions& options, const std::string& name) {
    options.draw = sfsm::drawing_named(name);
    if (!options.draw && name != "auto") throw wrong_argument("--draw", "'" + name + "'", "auto, gl or native");
}

void set_state(StadiumOptions& options, const std::string& text) {
    if (text == "auto") {
        options.state.reset();
        return;
    }
    if (text != "0" && text != "1" && text != "2") throw wrong_argument("--state", "'" + text + "'", "auto, 0, 1 or 2");
    options.state = static_cast<sfsm::State>(text[0] - '0');
}

// "FILE:W" has a weight, unless a file is called just that.
CharacterFile character_of(const std::string& option, const std::string& text) {
    constexpr double heaviest = 1e6;
    const std::size_t colon = text.rfind(':');
    std::error_code ignored;
    if (colon == std::string::npos || std::filesystem::exists(text, ignored)) return {text};
    double weight = 0;
    const auto [end, error] = std::from_chars(text.data() + colon + 1, text.data() + text.size(), weight);
    if (error != std::errc() || end != text.data() + text.size()) return {text};
    if (!(weight > 0 && weight <= heaviest))
        throw wrong_argument(option, "'" + text + "'", "FILE:WEIGHT with a weight over 0 and at most 1000000");
    return {text.substr(0, colon), weight};
}

// Whom an option that follows a character is about.
CharacterFile& last_of(StadiumOptions& options, const std::string& option) {
    if (options.characters.empty())
        throw wrong_argument(option, "no character before it", "--character FILE before it");
    return options.characters.back();
}

void turn_last(StadiumOptions& options, const std::string& text) {
    constexpr double most = 360;  // [degrees]
    double turn = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), turn);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(turn) <= most))
        throw wrong_argument("--turn", "'" + text + "'", "degrees from -360 to 360");
    last_of(options, "--turn").turn = turn;
}

void add_act(StadiumOptions& options, const std::string& text) {
    const std::size_t equals = text.find('=');
    const auto named = std::ranges::find(scene::deed_names, std::string_view(text).substr(0, equals));
    if (equals == std::string::npos || named == scene::deed_names.end()) {
        std::string names;
        for (const std::string_view name : scene::deed_names) names.append(names.empty() ? "" : ", ").append(name);
        throw wrong_argument("--act", "'" + text + "'", "ACT=CLIP with one of " + names);
    }
    const auto deed = static_cast<scene::Deed>(named - scene::deed_names.begin());
    last_of(options, "--act").acts.push_back({deed, text.substr(equals + 1)});
}

// They are obeyed one by one as they come, since --turn and --act belong to the character before them.
void add_character_options(CLI::App& app, StadiumOptions& options) {
    const auto add_files = [&](const std::string& option, const std::vector<std::string>& files) {
        for (const std::string& file : files) options.characters.push_back(character_of(option, file));
    };
    app.add_option_function<std::vector<std::string>>(
           "--character", [add_files](const std::vector<std::string>& files) { add_files("--character", files); },
           "File to fill the stadium with: .glb, .gltf, .vrm, .obj, .ply, .stl or .off, the last four also as .gz; "
           "several mix, FILE:3 three times as often as FILE:1")
        ->trigger_on_parse();
    app.add_option_function<std::string>(
           "--turn", [&](const std::string& text) { turn_last(options, text); },
           "Degrees, counter-clockwise from above, that turn the character before it to face +z")
        ->trigger_on_parse();
    app.add_option_function<std::string>(
           "--act", [&](const std::string& text) { add_act(options, text); },
           "ACT=CLIP: which clip the character before it stands, walks, runs, sits, cheers, claps or waves by (stand, "
           "walk, run, sit, cheer, clap, wave)")
        ->trigger_on_parse();
    app.add_flag("--verbose", options.verbose, "Say which clip each character plays in which role");
    app.add_option_function<std::vector<std::string>>(
           "--gallery",
           [&options, add_files](const std::vector<std::string>& files) {
               options.gallery = true;
               add_files("--gallery", files);
           },
           "Instead of a run, write a sheet of these characters to --png: each in each role from two sides, as "
           "triangles and as points. What can't be read is named in it, and the exit code is 1")
        ->trigger_on_parse();
}

void add_scene_options(CLI::App& app, StadiumOptions& options) {
    constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
    app.add_option("--people", options.people,
                   "How many people: of a million each takes 60 bytes, drawn one by one 500 more")
        ->check(whole_number(1, 10'000'000))
        ->capture_default_str();
    app.add_option("--pour-in", options.pour_in, "Seconds in which the people come in (default: all are there)")
        ->check(number_over(0, 1e6));
    add_character_options(app, options);
    app.add_flag("--strict", options.strict, "Refuse characters of which anything would be lost, instead of warning");
    app.add_option("--camera", options.camera, "still, close, medium, remote, roam or a FILE.json with keys")
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Who sits where, looks how and does what")
        ->check(whole_number(0, any))
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--cache", [&](const std::string& text) { options.cache = text == "none" ? "" : text; },
           "Folder that keeps point models between runs, or none")
        ->default_str(options.cache.string());
    app.add_flag("--dt", options.fixed_step, "Advance the scene 1/60 s a frame in a window too");
}

void add_control_options(CLI::App& app, StadiumOptions& options) {
    const auto set_target = [&](const std::string& text) {
        try {
            options.target = sfsm::TargetSchedule::parse(text);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(std::string("--target-ms: ") + error.what());
        }
    };
    app.add_option_function<std::string>("--target-ms", set_target,
                                         "Frame time to hold [ms]; X,Y@N,Z@M changes it at frames N and M")
        ->default_str(options.target.text());
    app.add_option("--law", options.law, "The controller's law")
        ->check(one_of(sfsm::law_names()))
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--state", [&](const std::string& text) { set_state(options, text); },
           "auto: the law decides; 0 all triangles, 1 slower motion far off, 2 points")
        ->default_str("auto");
    app.add_option("--splat-px", options.splat_size, "Splat size S of --state 2 [px] (default 2)")
        ->check(number_over(0, sfsm::max_splat_size));
    app.add_option("--motion-distance", options.motion_distance,
                   "D of --state 1 or 2 [m] (default 5/6 and 2/3 of the farthest person's depth)")
        ->check(number_over(0, 1e6));
    app.add_option("--max-error", options.max_error,
                   "Pixels that nobody's surface may be off by, late or uncovered; time goes where it must. Only with "
                   "the default law")
        ->check(number_over(0, 1e6));
}

void add_output_options(CLI::App& app, StadiumOptions& options) {
    app.add_option("--frames", options.frames, "Frames to draw (default: 300 without a window, else until closed)")
        ->check(whole_number(1, 10'000'000));
    app.add_option_function<std::string>(
           "--size", [&](const std::string& text) { set_size(options, text); }, "Picture's WIDTHxHEIGHT [px]")
        ->default_str("1280x720");
    app.add_option_function<std::string>(
           "--draw", [&](const std::string& name) { set_drawing(options, name); },
           "gl: by OpenGL 4.5; native: by the processor alone, OpenGL only shows it; auto: native where OpenGL is "
           "software "
           "or missing, on a GPU the faster of the two")
        ->default_str("auto");
    app.add_flag("--headless", options.headless, "No window, even if there is a display");
    app.add_option("--trace", options.trace, "Write a row a frame to this CSV file; - = stdout");
    app.add_option("--png", options.png, "Write the last frame to this PNG file; - = stdout");
    app.add_option("--png-every", options.png_every, "Write every K-th frame into --png-dir")
        ->check(whole_number(1, 10'000'000));
    app.add_option("--png-dir", options.png_directory, "Directory for --png-every; made if missing");
    app.add_option("--summary", options.summary, "Write the run's figures to this JSON file; - = stdout");
    app.add_option("--report", options.report, "Write the run as a page to look at to this HTML file; - = stdout");
}

// A sheet is all that it makes.
void check_gallery(const StadiumOptions& options) {
    if (!options.gallery) return;
    if (options.png.empty()) throw wrong_argument("--gallery", "no --png", "--png OUT for the sheet");
    for (const auto& [option, path] : {Place{"--trace", options.trace},
                                       {"--summary", options.summary},
                                       {"--report", options.report},
                                       {"--png-dir", options.png_directory}})
        if (!path.empty()) throw wrong_argument("--gallery", option, "no output but --png");
}

}  // namespace

std::string text_of(const std::vector<CharacterFile>& characters) {
    std::string text, before;
    for (const CharacterFile& character : characters) {
        text += before + character.file.string();
        if (character.weight != 1) text += ":" + sfsm::number_text(character.weight);
        if (character.turn != 0) text += " --turn " + sfsm::number_text(character.turn);
        for (const scene::ActWish& act : character.acts)
            text += " --act " + std::string(scene::name_of(act.deed)) + "=" + act.clip;
        before = character.turn != 0 || !character.acts.empty() ? " --character " : " ";
    }
    return text;
}

void add_stadium_options(CLI::App& app, StadiumOptions& options) {
    describe(app, examples);
    add_scene_options(app, options);
    add_control_options(app, options);
    add_output_options(app, options);
}

void check(const StadiumOptions& options) {
    if (options.splat_size && options.state != sfsm::State::points)
        throw wrong_argument("--splat-px", "another state", "--state 2, whose splats it sizes");
    if (options.motion_distance && (!options.state || options.state == sfsm::State::original))
        throw wrong_argument("--motion-distance", "another state", "--state 1 or --state 2, which it is part of");
    const std::string_view default_law = sfsm::law_names().front();
    if (options.max_error && (options.state || options.law != default_law))
        throw wrong_argument("--max-error", options.state ? "a fixed state" : "law " + options.law,
                             "the law that it bounds: " + std::string(default_law));
    if ((options.png_every > 0) != !options.png_directory.empty())
        throw wrong_argument("--png-every", "one of --png-every and --png-dir", "both or neither");
    if (!scene::is_preset(options.camera) && std::filesystem::path(options.camera).extension() != ".json")
        throw wrong_argument("--camera", "'" + options.camera + "'",
                             "still, close, medium, remote, roam or a FILE.json");
    if (options.png_directory == "-") throw wrong_argument("--png-dir", "'-'", "a directory");
    if (options.characters.size() > most_characters)
        throw wrong_argument("--character", std::to_string(options.characters.size()) + " files",
                             "at most " + std::to_string(most_characters));
    check_gallery(options);
    std::vector<Place> inputs;
    const std::string from = options.gallery ? "--gallery" : "--character";
    for (const CharacterFile& character : options.characters) inputs.push_back({from, character.file.string()});
    if (!scene::is_preset(options.camera)) inputs.push_back({"--camera", options.camera});
    const Place outputs[] = {{"--trace", options.trace},
                             {"--png", options.png},
                             {"--summary", options.summary},
                             {"--report", options.report}};
    check_places(inputs, outputs);
}

}  // namespace apps
