// From a recorder's file to the page in a browser: what a user does with a log.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/command.h"
#include "tests/report/in_browser.h"

namespace {

using nlohmann::json;

constexpr int frames = 600;

double ms_of(int frame) {
    return frame == 400 ? 90 : 10 + 0.01 * (frame * 37 % 100);
}

class ReplayInBrowser : public tests::InBrowser {
protected:
    std::string in_folder(const std::string& name) const { return folder_ / name; }

    // What PresentMon writes of the frames; one in ten is never shown.
    std::string presentmon() const {
        std::ofstream file(in_folder("game.csv"));
        file
            << "Application,ProcessID,SwapChainAddress,PresentRuntime,FrameType,CPUStartTime,FrameTime,CPUBusy,GPUBusy,"
               "DisplayedTime,AnimationError,PsoCompileCount\n";
        double start = 0;
        for (int i = 0; i < frames; ++i, start += ms_of(i - 1)) {
            file << "game.exe,1,0x1,DXGI,Application," << start << ',' << ms_of(i) << ',' << 0.4 * ms_of(i) << ','
                 << 0.95 * ms_of(i) << ',' << (i % 10 == 3 ? "NA" : "10") << ',' << (i % 10 == 3 ? "NA" : "0.5") << ','
                 << (i == 400 ? 7 : 0) << '\n';
        }
        return in_folder("game.csv");
    }

    // What CapFrameX writes of the same.
    std::string capframex() const {
        json times = json::array();
        for (int i = 0; i < frames; ++i) times.push_back(ms_of(i));
        const json run = {{"CaptureData", {{"MsBetweenPresents", times}}}};
        const json info = {{"ProcessName", "game.exe"}, {"GPU", "A fast one"}};
        std::ofstream(in_folder("game.json")) << json{{"Info", info}, {"Runs", {run}}};
        return in_folder("game.json");
    }

    // The page of these arguments, in light and dark, on a desk and on a phone.
    void open(const std::string& arguments) {
        const tests::Outcome outcome = tests::run("replay", arguments + " --report " + in_folder("page.html"));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        for (const char* scheme : {"dark", "light"}) {
            const json features = json::array({{{"name", "prefers-color-scheme"}, {"value", scheme}}});
            browser_->command("Emulation.setEmulatedMedia", {{"media", ""}, {"features", features}});
            browser_->open("file://" + in_folder("page.html"));
            wait_for("return document.querySelectorAll('#recorded-percentiles path.curve').length > 0");
        }
        browser_->command("Emulation.setDeviceMetricsOverride",
                          {{"width", 390}, {"height", 844}, {"deviceScaleFactor", 2}, {"mobile", true}});
        wait_for("return document.querySelector('#recorded-times > svg').viewBox.baseVal.width < 390");
        EXPECT_LE(value("return document.documentElement.scrollWidth"), 390);
        browser_->command("Emulation.clearDeviceMetricsOverride", json::object());
        EXPECT_EQ(browser_->console(), json::array());
    }

    bool is_shown(const std::string& id) const {
        return value("return document.querySelector('#" + id + "')?.checkVisibility() ?? false") == true;
    }

    json curves(const std::string& id) const {
        return value("return document.querySelectorAll('#" + id + " path.curve.measured').length");
    }

    bool says(const std::string& text) const {
        return value("return document.body.innerText.includes('" + text + "')") == true;
    }
};

TEST_F(ReplayInBrowser, ShowsWhatPresentMonTells) {
    open(presentmon());
    for (const char* id : {"recorded-times", "recorded-display", "recorded-animation", "recorded-busy-0"})
        EXPECT_TRUE(is_shown(id)) << id;
    EXPECT_TRUE(says("shader compilation"));
    EXPECT_TRUE(says("60 frames dropped, never shown"));
    EXPECT_FALSE(is_shown("times")) << "no law was asked for";
}

TEST_F(ReplayInBrowser, ShowsWhatCapFrameXTells) {
    open(capframex());
    EXPECT_EQ(curves("recorded-times"), 1);
    for (const char* id : {"recorded-display", "recorded-animation", "recorded-busy-0"})
        EXPECT_FALSE(is_shown(id)) << id;
    EXPECT_TRUE(says("A fast one"));
}

TEST_F(ReplayInBrowser, ShowsTwoRunsOverEachOther) {
    open(presentmon() + " " + capframex());
    EXPECT_EQ(curves("recorded-times"), 2);
    EXPECT_TRUE(says("no clear difference"));
}

TEST_F(ReplayInBrowser, ShowsATraceUnderThreeLaws) {
    open(std::string(GRANDSTAND_SOURCE) + "/traces/roaming.csv --law predictive,safeguarded,paper");
    EXPECT_EQ(curves("recorded-times"), 1);
    EXPECT_EQ(curves("frame-chart"), 4);
    for (const char* id : {"distance-chart", "splat-chart"}) EXPECT_TRUE(is_shown(id)) << id;
}

}  // namespace
