// The report as a reader has it: in a headless browser, opened as a file, with a mouse, fingers and keys.
#include <gtest/gtest.h>

#include "tests/report/report_page.h"
#include "tests/report/sample.h"

namespace {

using nlohmann::json;

class ReportInBrowser : public tests::ReportPage {
protected:
    void SetUp() override {
        InBrowser::SetUp();
        if (!IsSkipped()) open(report_);
    }

    void open(const sfsm::Report& report) {
        load(report);
        wait_for("return document.querySelectorAll('#percentiles path.curve').length > 0");
    }

    // Frames in view.
    double span() const {
        return value("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from");
    }

    // As near as it is written.
    void expect_told(std::size_t run, const std::string& key, float expected) const {
        SCOPED_TRACE(key + " of run " + std::to_string(run));
        const std::string text = told(run, key);
        if (std::isnan(expected)) {
            EXPECT_EQ(text, "\u2013");
        } else if (std::isinf(expected)) {
            EXPECT_EQ(text, "\u221E");
        } else {
            ASSERT_FALSE(text.empty());
            constexpr double written = 0.051;
            EXPECT_NEAR(std::stod(text), expected, written);
        }
    }

    void expect_read_out(std::size_t frame) const {
        constexpr const char* states[] = {"original", "slowed", "points"};
        for (std::size_t run = 0; run < report_.runs.size(); ++run) {
            const sfsm::ReportFrame& shown = report_.runs[run].frames[frame];
            expect_told(run, "time", shown.frame_ms);
            expect_told(run, "target", shown.target_ms);
            expect_told(run, "predicted", shown.predicted_ms);
            expect_told(run, "splat", shown.splat_size);
            const bool has_distance = shown.state != sfsm::State::original;
            expect_told(run, "distance", has_distance ? shown.motion_distance : std::nanf(""));
            EXPECT_EQ(told(run, "state"), states[static_cast<std::size_t>(shown.state)]);
            const std::string rate = told(run, "rate");
            if (shown.rate > 0) {
                EXPECT_NEAR(std::stod(rate), shown.rate, 1e-3 * shown.rate);
            } else {
                EXPECT_EQ(rate, "\u2013");
            }
        }
    }

    sfsm::Report report_ = tests::sample_report();
};

TEST_F(ReportInBrowser, ConsoleStaysSilent) {
    EXPECT_EQ(browser_->console(), json::array());
    EXPECT_EQ(value("return document.images.length"), 0) << "text became an element";
    sfsm::ReportFrame unknown, huge;
    huge.frame_ms = 1e30F;
    huge.target_ms = -1;
    huge.motion_distance = std::numeric_limits<float>::infinity();
    huge.state = sfsm::State::points;
    load({"none", {}, {{"law", {}, {}}}});
    EXPECT_EQ(browser_->console(), json::array());
    EXPECT_EQ(value("return document.querySelector('#times').hidden"), true) << "there is nothing to draw";
    for (const auto& frames : {std::vector{huge}, std::vector{unknown, huge, unknown}}) {
        open({"odd", {}, {{"law", frames, sfsm::time_scores(frames)}}});
        for (const char* scale : {"full", "log", "fitted"}) {
            value("document.querySelector('[data-scale=" + std::string(scale) + "]').click()");
            wait_for("return document.querySelector('[data-scale=" + std::string(scale) + "]').ariaPressed == 'true'");
        }
        EXPECT_EQ(browser_->console(), json::array());
        EXPECT_EQ(value("return [...document.querySelectorAll('path')].some("
                        "(path) => /NaN|Infinity/.test(path.getAttribute('d')))"),
                  false);
    }
}

TEST_F(ReportInBrowser, EachChartHasACurveOfEachRun) {
    const std::pair<const char*, const char*> charts[] = {{"frame-chart", "measured"},
                                                          {"distance-chart", "detail"},
                                                          {"splat-chart", "detail"},
                                                          {"percentiles", "percentile"},
                                                          {"histogram", "bars"}};
    for (const auto& [chart, curve] : charts) {
        const json points = value("return [...document.querySelectorAll('#" + std::string(chart) + " path." + curve +
                                  "')].map((path) => path.getAttribute('d').split(/[LHV]/).length)");
        ASSERT_EQ(points.size(), 2) << chart;
        constexpr int many = 50;
        for (const json& count : points) EXPECT_GT(count, many) << chart;
    }
    EXPECT_EQ(value("return document.querySelectorAll('#frame-chart path.predicted[d^=M]').length"), 1);
    EXPECT_EQ(value("return document.querySelectorAll('#frame-chart .caret').length"), 2) << "the spikes are clipped";
    EXPECT_EQ(value("return document.querySelectorAll('#frame-chart .strip').length"), 2);
    for (const char* state : {"state-0", "state-1", "state-2"}) {
        EXPECT_EQ(value("return document.querySelectorAll('#frame-chart .strip ." + std::string(state) + "').length"),
                  2);
    }
}

TEST_F(ReportInBrowser, ManyFramesDontHideTheTarget) {
    const std::string is_above =
        "const after = Node.DOCUMENT_POSITION_FOLLOWING, chart = document.querySelector('#frame-chart');"
        "return (chart.querySelector('.measured').compareDocumentPosition(chart.querySelector('.target')) & after) > 0";
    EXPECT_EQ(value(is_above), false);
    const std::vector<sfsm::ReportFrame> frames(100'000, sfsm::ReportFrame{16, 15});
    open({"many", {}, {{"law", frames, sfsm::time_scores(frames)}}});
    EXPECT_EQ(value(is_above), true);
    EXPECT_EQ(browser_->console(), json::array());
}

TEST_F(ReportInBrowser, HoveringReadsOutTheFrame) {
    for (const char* chart : {"frame-chart", "distance-chart", "splat-chart"}) {
        for (const int frame : {3, 30, 150, 170, 333}) {
            SCOPED_TRACE(std::string(chart) + ", frame " + std::to_string(frame));
            hover(place(chart, frame));
            wait_for("return document.querySelector('#readout').dataset.frame == " + std::to_string(frame));
            expect_read_out(static_cast<std::size_t>(frame));
            EXPECT_EQ(value("return document.querySelectorAll('path.cross').length"), 3) << "through all charts";
        }
    }
    hover({{"x", 3}, {"y", 3}});
    wait_for("return document.querySelector('#readout').hidden");
}

TEST_F(ReportInBrowser, WheelZoomsAllChartsAroundThePointer) {
    EXPECT_EQ(span(), 400);
    wheel(place("splat-chart", 100), -600);
    wait_for("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from < 300");
    EXPECT_EQ(
        value("return new Set([...document.querySelectorAll('svg.over-time')].map((svg) => svg.dataset.from)).size"),
        1);
    const double from =
        std::stod(value("return document.querySelector('#frame-chart > svg').dataset.from").get<std::string>());
    constexpr double nearly = 1.5;  // a pixel is half a frame
    EXPECT_NEAR((100 - from) / span(), 100.5 / 400, nearly / 100);
    EXPECT_NE(value("return document.querySelector('#range').textContent"), "frames 0 to 399 of 400");
    wait_for("return document.querySelector('#spread-range').textContent != 'of all frames'");
    value("document.querySelector('#zoom-reset').click()");
    wait_for("return document.querySelector('#range').textContent == 'frames 0 to 399 of 400'");
}

TEST_F(ReportInBrowser, DraggingPicksARange) {
    drag(place("frame-chart", 100), place("frame-chart", 200));
    wait_for("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from < 110");
    constexpr double nearly = 2;
    EXPECT_NEAR(span(), 100, nearly);
    const json middle = place("frame-chart", 150);
    browser_->act("pointer", json::array({move(middle), down(), up(), down(), up()}));
    wait_for("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from == 400");
}

TEST_F(ReportInBrowser, FingersZoomAndMove) {
    browser_->act(json::array({finger("one", "frame-chart", 180, 100), finger("two", "frame-chart", 220, 300)}));
    wait_for("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from < 200");
    const double from = value("return Number(document.querySelector('#frame-chart > svg').dataset.from)");
    const double middle = from + span() / 2;
    browser_->act(json::array({finger("one", "frame-chart", middle, middle - span() / 4)}));
    wait_for("return Number(document.querySelector('#frame-chart > svg').dataset.from) > " + std::to_string(from + 5));
    wait_for("return !document.querySelector('#readout').hidden");
}

TEST_F(ReportInBrowser, KeysZoomMoveAndStep) {
    press("frame-chart", "+");
    wait_for("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from < 300");
    const std::string right = "\uE014";
    const double from = value("return Number(document.querySelector('#frame-chart > svg').dataset.from)");
    press("frame-chart", right);
    wait_for("return Number(document.querySelector('#frame-chart > svg').dataset.from) > " + std::to_string(from));
    press("splat-chart", "0");
    wait_for("const { from, to } = document.querySelector('#frame-chart > svg').dataset; return to - from == 400");
    step("frame-chart", right, 2);
    wait_for("return !document.querySelector('#readout').hidden");
    const std::string frame = value("return document.querySelector('#readout').dataset.frame");
    EXPECT_EQ(frame, "201") << "one on from the middle, which the first step shows";
    expect_read_out(201);
    EXPECT_EQ(value("return document.querySelector('#spoken').textContent.startsWith('Frame 201.')"), true);
}

TEST_F(ReportInBrowser, LegendHidesARun) {
    value("document.querySelector('#legend [data-run=\"0\"]').click()");
    wait_for("return document.querySelectorAll('#frame-chart path.measured').length == 1");
    EXPECT_EQ(value("return document.querySelectorAll('#splat-chart path.detail').length"), 1);
    EXPECT_EQ(value("return document.querySelector('#legend [data-run=\"0\"]').ariaPressed"), "false");
    hover(place("frame-chart", 50));
    wait_for("return document.querySelector('#readout').dataset.frame == 50");
    EXPECT_EQ(told(0, "time"), "");
    EXPECT_NE(told(1, "time"), "");
    value("document.querySelector('#legend [data-run=\"1\"]').click()");
    wait_for("return document.querySelectorAll('#frame-chart path.measured').length == 0");
    value("document.querySelector('#legend [data-run=\"0\"]').click()");
    wait_for("return document.querySelectorAll('#frame-chart path.measured').length == 1");
    EXPECT_EQ(browser_->console(), json::array());
}

TEST_F(ReportInBrowser, ScaleShowsTheSpike) {
    const std::string highest =
        "return Math.max(...[...document.querySelectorAll('#frame-chart > svg > g:first-of-type text')]"
        ".map((text) => Number(text.textContent)))";
    EXPECT_LT(value(highest), 200);
    for (const char* scale : {"full", "log"}) {
        value("document.querySelector('[data-scale=" + std::string(scale) + "]').click()");
        wait_for(highest + " >= 1000");
        EXPECT_EQ(value("return document.querySelectorAll('#frame-chart .caret').length"), 0);
    }
}

TEST_F(ReportInBrowser, DarkSchemeAndPaperDiffer) {
    const std::string ground = "return getComputedStyle(document.body).backgroundColor";
    emulate("", "light");
    const json light = value(ground);
    emulate("", "dark");
    const json dark = value(ground);
    EXPECT_NE(light, dark);
    value("document.querySelector('#theme').click()");
    EXPECT_EQ(value(ground), light) << "the button wins";
    value("document.querySelector('#theme').click()");

    emulate("print", "dark");
    EXPECT_EQ(value(ground), "rgb(255, 255, 255)");
    EXPECT_EQ(value("return [...document.querySelectorAll('.control')].every((part) => part.offsetParent === null)"),
              true);
    EXPECT_EQ(value("return document.querySelector('#legend').offsetParent !== null"), true);
    emulate("", "light");
}

TEST_F(ReportInBrowser, FitsAPhone) {
    emulate_phone(360);
    wait_for("return document.querySelector('#frame-chart > svg').viewBox.baseVal.width < 360");
    expect_narrow(360);
}

TEST_F(ReportInBrowser, WithoutScriptsThereIsThePicture) {
    browser_->command("Emulation.setScriptExecutionDisabled", {{"value", true}});
    browser_->open(address());
    const json found = browser_->command("DOM.getDocument", {{"depth", 1}});
    const json picture = browser_->command(
        "DOM.querySelector", {{"nodeId", found["root"]["nodeId"]}, {"selector", "noscript svg[role=img] path"}});
    EXPECT_NE(picture["nodeId"], 0);
    browser_->command("Emulation.setScriptExecutionDisabled", {{"value", false}});
}

}  // namespace
