// Every option of the stadium reaches what it sets, and nothing else.
#include "apps/stadium_options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

namespace apps {
namespace {

// Throws what parsing or the rules between options throw.
StadiumOptions parsed(std::vector<std::string> arguments) {
    CLI::App app("A test.", "stadium");
    StadiumOptions options;
    add_stadium_options(app, options);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    app.parse(arguments);
    check(options);
    return options;
}

bool is_taken(const std::vector<std::string>& arguments) {
    try {
        parsed(arguments);
        return true;
    } catch (const CLI::ParseError&) {
    } catch (const std::invalid_argument&) {
    }
    return false;
}

// All fields as text.
std::vector<std::string> fields(const StadiumOptions& options) {
    std::vector<std::string> texts;
    const auto add = [&](const auto& value) {
        std::ostringstream text;
        text << value;
        texts.push_back(text.str());
    };
    add(options.people);
    add(text_of(options.characters));
    add(options.target.text());
    add(options.law);
    add(options.state ? static_cast<int>(*options.state) : -1);
    add(options.splat_size.value_or(-1));
    add(options.motion_distance.value_or(-1));
    add(options.pour_in);
    add(options.cache.string());
    add(options.camera);
    add(options.frames.value_or(-1));
    add(options.width);
    add(options.height);
    add(options.seed);
    add(options.headless);
    add(options.fixed_step);
    add(options.gallery);
    add(options.verbose);
    for (const std::string& path :
         {options.trace, options.png, options.png_directory, options.summary, options.report}) {
        add(path);
    }
    add(options.png_every);
    return texts;
}

TEST(StadiumOptions, AreWhatTheManualSaysWhereNoneIsGiven) {
    const StadiumOptions options = parsed({});
    EXPECT_EQ(options.people, 20000);
    EXPECT_TRUE(options.characters.empty());
    EXPECT_EQ(options.target.text(), sfsm::default_target);
    EXPECT_EQ(options.law, "predictive");
    EXPECT_FALSE(options.state || options.splat_size || options.motion_distance || options.frames);
    EXPECT_EQ(options.pour_in, 0);
    EXPECT_EQ(options.cache, default_cache());
    EXPECT_EQ(options.camera, "roam");
    EXPECT_EQ(options.width, 1280);
    EXPECT_EQ(options.height, 720);
    EXPECT_EQ(options.seed, 1u);
    EXPECT_FALSE(options.headless || options.fixed_step);
    EXPECT_EQ(options.png_every, 0);
    EXPECT_EQ(options.trace + options.png + options.png_directory + options.summary + options.report, "");
}

// The defaults that --help tells are those that hold.
TEST(StadiumOptions, HelpTellsTheDefaults) {
    CLI::App app("A test.", "stadium");
    StadiumOptions options;
    add_stadium_options(app, options);
    for (const auto& [name, told] : {std::pair<std::string, std::string>{"--people", "20000"},
                                     {"--target-ms", options.target.text()},
                                     {"--law", options.law},
                                     {"--state", "auto"},
                                     {"--camera", "roam"},
                                     {"--seed", "1"},
                                     {"--cache", options.cache.string()},
                                     {"--size", "1280x720"}}) {
        EXPECT_EQ(app.get_option(name)->get_default_str(), told) << name;
    }
}

TEST(StadiumOptions, EachReachesItsFieldAndNoOther) {
    struct Given {
        std::vector<std::string> arguments;
        std::function<void(StadiumOptions&)> meant;
    };
    const Given all[] = {
        {{"--people", "123"}, [](StadiumOptions& o) { o.people = 123; }},
        {{"--character", "a.glb", "--character", "b.obj"},
         [](StadiumOptions& o) {
             o.characters = {{"a.glb"}, {"b.obj"}};
         }},
        {{"--verbose"}, [](StadiumOptions& o) { o.verbose = true; }},
        {{"--character", "a.glb:3", "--turn", "-90", "--act", "sit=Sit|Chair=1", "--character", "b.glb:0.5", "c:d.glb",
          "--act", "walk=Run", "--act", "cheer=", "--turn", "12.5"},
         [](StadiumOptions& o) {
             o.characters = {{"a.glb", 3, -90, {{scene::Deed::sit, "Sit|Chair=1"}}},
                             {"b.glb", 0.5},
                             {"c:d.glb", 1, 12.5, {{scene::Deed::walk, "Run"}, {scene::Deed::cheer, ""}}}};
         }},
        {{"--gallery", "a.glb", "b.obj", "--png", "s.png"},
         [](StadiumOptions& o) {
             o.gallery = true;
             o.characters = {{"a.glb"}, {"b.obj"}};
             o.png = "s.png";
         }},
        {{"--target-ms", "20,30@4"}, [](StadiumOptions& o) { o.target = sfsm::TargetSchedule::parse("20,30@4"); }},
        {{"--law", "paper"}, [](StadiumOptions& o) { o.law = "paper"; }},
        {{"--state", "0"}, [](StadiumOptions& o) { o.state = sfsm::State::original; }},
        {{"--state", "1"}, [](StadiumOptions& o) { o.state = sfsm::State::slowed; }},
        {{"--state", "2"}, [](StadiumOptions& o) { o.state = sfsm::State::points; }},
        {{"--state", "auto"}, [](StadiumOptions&) {}},
        {{"--state", "2", "--splat-px", "3.5"},
         [](StadiumOptions& o) {
             o.state = sfsm::State::points;
             o.splat_size = 3.5;
         }},
        {{"--state", "1", "--motion-distance", "70.5"},
         [](StadiumOptions& o) {
             o.state = sfsm::State::slowed;
             o.motion_distance = 70.5;
         }},
        {{"--pour-in", "12.5"}, [](StadiumOptions& o) { o.pour_in = 12.5; }},
        {{"--cache", "some/where"}, [](StadiumOptions& o) { o.cache = "some/where"; }},
        {{"--cache", "none"}, [](StadiumOptions& o) { o.cache = ""; }},
        {{"--camera", "close"}, [](StadiumOptions& o) { o.camera = "close"; }},
        {{"--camera", "keys.json"}, [](StadiumOptions& o) { o.camera = "keys.json"; }},
        {{"--frames", "77"}, [](StadiumOptions& o) { o.frames = 77; }},
        {{"--size", "321x123"},
         [](StadiumOptions& o) {
             o.width = 321;
             o.height = 123;
         }},
        {{"--seed", "18446744073709551615"}, [](StadiumOptions& o) { o.seed = ~std::uint64_t{0}; }},
        {{"--headless"}, [](StadiumOptions& o) { o.headless = true; }},
        {{"--dt"}, [](StadiumOptions& o) { o.fixed_step = true; }},
        {{"--trace", "t.csv"}, [](StadiumOptions& o) { o.trace = "t.csv"; }},
        {{"--png", "p.png"}, [](StadiumOptions& o) { o.png = "p.png"; }},
        {{"--png-every", "5", "--png-dir", "pictures"},
         [](StadiumOptions& o) {
             o.png_every = 5;
             o.png_directory = "pictures";
         }},
        {{"--summary", "s.json"}, [](StadiumOptions& o) { o.summary = "s.json"; }},
        {{"--report", "r.html"}, [](StadiumOptions& o) { o.report = "r.html"; }},
    };
    for (const Given& given : all) {
        StadiumOptions expected;
        given.meant(expected);
        EXPECT_EQ(fields(parsed(given.arguments)), fields(expected)) << given.arguments[0];
    }
}

TEST(StadiumOptions, AreTakenUpToTheirLimits) {
    for (const std::vector<std::string>& good :
         std::vector<std::vector<std::string>>{{"--people", "1"},
                                               {"--people", "10000000"},
                                               {"--pour-in", "1e6"},
                                               {"--seed", "0"},
                                               {"--frames", "1"},
                                               {"--frames", "10000000"},
                                               {"--size", "1x8192"},
                                               {"--size", "8192x1"},
                                               {"--state", "2", "--splat-px", "32"},
                                               {"--state", "2", "--motion-distance", "1e6"},
                                               {"--png-every", "10000000", "--png-dir", "d"},
                                               {"--target-ms", "1e6"}}) {
        EXPECT_TRUE(is_taken(good)) << good.back();
    }
    for (const std::vector<std::string>& bad :
         std::vector<std::vector<std::string>>{{"--people", "0"},
                                               {"--people", "10000001"},
                                               {"--pour-in", "0"},
                                               {"--pour-in", "1000001"},
                                               {"--seed", "-1"},
                                               {"--frames", "0"},
                                               {"--frames", "10000001"},
                                               {"--size", "0x1"},
                                               {"--size", "8193x1"},
                                               {"--size", "1x8193"},
                                               {"--size", "1x"},
                                               {"--size", "x1"},
                                               {"--size", "1X1"},
                                               {"--size", "1x1x1"},
                                               {"--size", "1 x 1"},
                                               {"--state", "2", "--splat-px", "0"},
                                               {"--state", "2", "--splat-px", "32.1"},
                                               {"--state", "2", "--motion-distance", "0"},
                                               {"--state", "3"},
                                               {"--state", ""},
                                               {"--state", "01"},
                                               {"--png-every", "0", "--png-dir", "d"},
                                               {"--target-ms", "0"},
                                               {"--law", "none"}}) {
        EXPECT_FALSE(is_taken(bad)) << bad.back();
    }
}

TEST(StadiumOptions, RulesBetweenThemHoldBothWays) {
    for (const char* state : {"auto", "0", "1", "2"}) {
        const std::string text = state;
        EXPECT_EQ(is_taken({"--state", state, "--splat-px", "2"}), text == "2") << state;
        EXPECT_EQ(is_taken({"--state", state, "--motion-distance", "2"}), text == "1" || text == "2") << state;
    }
    EXPECT_FALSE(is_taken({"--png-every", "2"}));
    EXPECT_FALSE(is_taken({"--png-dir", "d"}));
    EXPECT_FALSE(is_taken({"--png-every", "2", "--png-dir", "-"}));
    for (const char* camera : {"still", "close", "medium", "remote", "roam", "a/path.json"})
        EXPECT_TRUE(is_taken({"--camera", camera})) << camera;
    for (const char* camera : {"nowhere", "path.jsn", "Close", ""}) EXPECT_FALSE(is_taken({"--camera", camera}));
    std::vector<std::string> characters;
    for (int i = 0; i < 64; ++i) characters.insert(characters.end(), {"--character", "a.glb"});
    EXPECT_TRUE(is_taken(characters));
    characters.insert(characters.end(), {"--character", "a.glb"});
    EXPECT_FALSE(is_taken(characters));
}

TEST(StadiumOptions, WhatIsWantedOfACharacterFollowsIt) {
    EXPECT_TRUE(is_taken({"--character", "a.glb", "--turn", "90"}));
    EXPECT_TRUE(is_taken({"--gallery", "a.glb", "--turn", "90", "--png", "s.png"}));
    EXPECT_FALSE(is_taken({"--turn", "90", "--character", "a.glb"})) << "nobody to turn";
    EXPECT_FALSE(is_taken({"--act", "sit=Idle"}));
    for (const char* turn : {"", "left", "361", "-400", "nan", "90deg"})
        EXPECT_FALSE(is_taken({"--character", "a.glb", "--turn", turn})) << turn;
    for (const char* act : {"", "sit", "fly=Fly", "Sit=Idle", "=Idle"})
        EXPECT_FALSE(is_taken({"--character", "a.glb", "--act", act})) << act;
    for (const char* file : {"a.glb:0", "a.glb:-1", "a.glb:nan", "a.glb:inf", "a.glb:1e7"})
        EXPECT_FALSE(is_taken({"--character", file})) << file;
}

TEST(StadiumOptions, AFileMayHaveAColonInItsName) {
    const std::string name = testing::TempDir() + "/weighed:3";
    EXPECT_EQ(parsed({"--character", name}).characters.at(0).weight, 3) << "no such file";
    std::ofstream(name) << "mesh";
    EXPECT_EQ(parsed({"--character", name}).characters.at(0), (CharacterFile{name}));
    EXPECT_EQ(parsed({"--character", name + ":2"}).characters.at(0), (CharacterFile{name, 2}));
    std::filesystem::remove(name);
}

// Whatever two outputs, and whatever input, are one file.
TEST(StadiumOptions, NoFileHasTwoUses) {
    const std::vector<std::string> outputs = {"--trace", "--png", "--summary", "--report"};
    for (const std::string& a : outputs) {
        for (const std::string& b : outputs) {
            if (a == b) continue;
            EXPECT_FALSE(is_taken({a, "x", b, "./x"})) << a << ' ' << b;
            EXPECT_FALSE(is_taken({a, "-", b, "-"})) << a << ' ' << b;
            EXPECT_TRUE(is_taken({a, "x", b, "y"})) << a << ' ' << b;
            EXPECT_TRUE(is_taken({a, "x", b, "-"})) << a << ' ' << b;
        }
        EXPECT_FALSE(is_taken({a, "no_such.glb", "--character", "other.glb", "--character", "no_such.glb"})) << a;
        EXPECT_FALSE(is_taken({a, "no_such.json", "--camera", "no_such.json"})) << a;
    }
}

}  // namespace
}  // namespace apps
