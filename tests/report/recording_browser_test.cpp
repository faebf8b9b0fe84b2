// The page of recordings as a reader has it: in a headless browser, with a mouse, fingers and keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <numeric>

#include "sfsm/report/markup.h"
#include "tests/report/recording_sample.h"
#include "tests/report/report_page.h"
#include "tests/report/sample.h"

namespace {

using nlohmann::json;
using sfsm::FrameRecord;
using sfsm::Report;
using sfsm::report::figure;

const std::string nothing_told = "\u2013";
const std::string arrow_left = "\uE012", arrow_right = "\uE014";

class RecordingInBrowser : public tests::ReportPage {
protected:
    void open(const Report& report) const {
        load(report);
        wait_for("return document.querySelectorAll('#recorded-percentiles path.curve').length > 0");
    }

    Report game() const { return {"A game", {}, {}, {}, {}, {tests::reported("game.csv", full_)}}; }
    Report bare() const { return {"Times alone", {}, {}, {}, {}, {tests::reported("game.json", bare_)}}; }
    Report two() const {
        return {"Two",
                {},
                {},
                {},
                {},
                {tests::reported("before", full_), tests::reported("after", bare_)},
                {{0, 1, sfsm::differences_of(full_, bare_, 1)}}};
    }
    // A recording, and what laws would have made of it.
    Report with_laws(int laws) const {
        Report report{"Laws", {}, {tests::sample_run("recorded", 1, true)}, "Under laws", "In words.", {}};
        for (int i = 0; i < laws; ++i) {
            report.runs.push_back(
                tests::sample_run("law " + std::to_string(i), 0.9F + 0.02F * static_cast<float>(i), true));
        }
        report.recordings = {tests::reported("trace.csv", traced_)};
        return report;
    }
    std::map<std::string, Report> all_kinds() const {
        return {{"game", game()}, {"bare", bare()}, {"two", two()}, {"laws", with_laws(3)}, {"many", with_laws(8)}};
    }

    // When a frame begins [s].
    static double begins(const std::vector<FrameRecord>& frames, std::size_t frame) {
        double ms = 0;
        for (std::size_t i = 0; i < frame; ++i)
            if (std::isfinite(frames[i].frame_ms)) ms += frames[i].frame_ms;
        return ms / 1000;
    }
    static double middle(const std::vector<FrameRecord>& frames, std::size_t frame) {
        return (begins(frames, frame) + begins(frames, frame + 1)) / 2;
    }

    double from() const { return value("return Number(document.querySelector('#recorded-times > svg').dataset.from)"); }
    double to() const { return value("return Number(document.querySelector('#recorded-times > svg').dataset.to)"); }
    double span() const { return to() - from(); }
    void wait_for_span(const std::string& condition) const {
        wait_for("const { from, to } = document.querySelector('#recorded-times > svg').dataset; return to - from " +
                 condition);
    }

    // Until what was asked for is drawn.
    void settle() const {
        value(
            "window.isDrawn = false; requestAnimationFrame(() => requestAnimationFrame(() => window.isDrawn = true))");
        wait_for("return window.isDrawn");
    }

    // To about these places on the axis, in two or three steps: a pixel may be many frames.
    void zoom_to(double first, double last) const {
        constexpr double most = 20, some = 1.05;
        for (double now = span(); now > some * some * (last - first); now = span()) {
            const double margin = std::max(0.0, (now / most - (last - first)) / 2);
            drag(place("recorded-times", std::max(from(), first - margin)),
                 place("recorded-times", std::min(to(), last + margin)));
            wait_for_span("< " + std::to_string(now));
            settle();
        }
    }

    void choose(const std::string& key, const std::string& chosen) const {
        value("document.querySelector('#recorded [data-" + key + "=" + chosen + "]').click()");
        settle();
        EXPECT_EQ(value("return document.querySelector('#recorded [data-" + key + "=" + chosen + "]').ariaPressed"),
                  "true");
    }

    std::size_t read_frame() const {
        return std::stoul(value("return document.querySelector('#readout').dataset.frame").get<std::string>());
    }

    // Written to three digits under 10 and two from there on, from steps of `quantum`.
    void expect_told(const std::string& key, double expected, double quantum) const {
        const std::string text = told(0, key);
        if (!std::isfinite(expected)) {
            EXPECT_EQ(text, nothing_told) << key;
        } else {
            ASSERT_FALSE(text.empty()) << key;
            const double written = std::abs(expected) < 10 ? 0.0005 : 0.005;
            EXPECT_NEAR(std::stod(text), expected, written + quantum / 2 + 1e-9) << key;
        }
    }

    // What is read out of the first recording at the frame that the read-out names.
    void expect_read_out(const std::vector<FrameRecord>& frames) const {
        const std::size_t read = read_frame();
        SCOPED_TRACE("frame " + std::to_string(read));
        ASSERT_LT(read, frames.size());
        const FrameRecord& frame = frames[read];
        expect_told("time", frame.frame_ms, 0.001);
        expect_told("display", frame.display_ms, 0.01);
        expect_told("animation", frame.animation_error_ms, 0.01);
        expect_told("cpu", frame.cpu_ms, 0.01);
        expect_told("gpu", frame.gpu_ms, 0.01);
        if (std::isfinite(frame.frame_ms)) {
            EXPECT_NEAR(std::stod(told(0, "rate")), 1000 / frame.frame_ms, 0.06);
        }
        const auto stutters = sfsm::stutters_of(frames);
        const auto stutter = std::ranges::find(stutters, static_cast<std::int64_t>(read), &sfsm::Stutter::frame);
        EXPECT_EQ(told(0, "stutter"), stutter == stutters.end() ? nothing_told : sfsm::name_of(stutter->cause));
    }

    void expect_only_numbers() const {
        EXPECT_EQ(browser_->console(), json::array());
        EXPECT_EQ(value("return [...document.querySelectorAll('svg, svg *')].flatMap((part) => [...part.attributes])"
                        ".filter(({ name, value }) => name !== 'class' && /NaN|Infinity|undefined/.test(value))"
                        ".map(({ name, value }) => name + ' ' + value.slice(0, 60))"),
                  json::array());
    }

    void expect_only_numbers_however_shown() const {
        for (const char* unit : {"frames", "seconds"}) {
            if (value("return document.querySelector('#recorded-unit').hidden") != true) choose("unit", unit);
            for (const char* scale : {"full", "log", "fitted"}) {
                SCOPED_TRACE(std::string(unit) + ", " + scale);
                choose("scale", scale);
                expect_only_numbers();
            }
        }
    }

    const std::vector<FrameRecord> full_ = tests::sample_recording(), bare_ = tests::bare_recording(),
                                   traced_ = {bare_.begin(), bare_.begin() + 400};
};

TEST_F(RecordingInBrowser, ConsoleStaysSilent) {
    for (const auto& [kind, report] : all_kinds()) {
        SCOPED_TRACE(kind);
        open(report);
        expect_only_numbers_however_shown();
    }
}

TEST_F(RecordingInBrowser, NumbersAreTheFigures) {
    open(game());
    std::map<std::string, std::string> shown;
    for (const json& tile :
         value("return [...document.querySelectorAll('.tiles dl > div')].map((tile) => "
               "[tile.closest('.tiles').querySelector('h3').textContent + ': ' + "
               "tile.querySelector('dt').firstChild.textContent.trim(), tile.querySelector('dd').textContent])")) {
        shown[tile[0]] = tile[1];
    }
    const sfsm::Figures figures = game().recordings[0].figures;
    const std::vector<std::tuple<const char*, double, int>> expected = {
        {"Frame rate: average", figures.average_fps, 1},
        {"Frame rate: median", figures.median_fps, 1},
        {"Frame rate: P1", figures.p1_fps, 1},
        {"Frame rate: P0.1", figures.p01_fps, 1},
        {"Frame rate: 1 % low, mean", figures.low_1.mean, 1},
        {"Frame rate: 0.1 % low, mean", figures.low_01.mean, 1},
        {"Frame rate: 1 % low, integral", figures.low_1.integral, 1},
        {"Frame rate: 0.1 % low, integral", figures.low_01.integral, 1},
        {"Frame time: mean", figures.mean_ms, 2},
        {"Frame time: 99.9 %", figures.p999_ms, 2},
        {"Frame time: shortest", figures.least_ms, 2},
        {"Frame time: longest", figures.most_ms, 2},
        {"Frame time: frame to frame", figures.mean_step_ms, 2},
        {"Frame time: animation error", figures.mean_animation_error_ms, 2},
        {"Smoothness: stutters", 7, 0},
        {"Smoothness: in stutter", 100 * figures.stutter_share, 2},
        {"Smoothness: over 16.7 ms", 100 * figures.over[1].share, 2},
        {"Smoothness: over 33.3 ms", 100 * 7.0 / 2999, 2},
        {"Recording: duration", figures.seconds, 1},
        {"Recording: frames", 3000, 0},
        {"Recording: without a time", 1, 0},
        {"Recording: dropped", 30, 0}};
    for (const auto& [name, number, digits] : expected) EXPECT_EQ(shown[name], figure(number, digits)) << name;
    EXPECT_EQ(value("return [...document.querySelectorAll('.tiles dd')].some((tile) => tile.textContent == '\u2013')"),
              false)
        << "nothing that is empty";
}

TEST_F(RecordingInBrowser, ComparedNumbersStandSideBySide) {
    open(two());
    const json rates = value(
        "return [...document.querySelectorAll('table.numbers tr')].find((row) => "
        "row.querySelector('th').firstChild.textContent == 'average ').innerText.trim().split(/\\s+/).slice(-2)");
    const Report report = two();
    EXPECT_EQ(rates, json({figure(report.recordings[0].figures.average_fps, 1),
                           figure(report.recordings[1].figures.average_fps, 1)}));
    EXPECT_EQ(value("return document.querySelectorAll('table.differences tbody tr').length"),
              report.comparisons[0].differences.size());
    EXPECT_EQ(value("return document.querySelector('table.differences tbody tr').lastChild.textContent"), "faster");
}

TEST_F(RecordingInBrowser, ShowsOnlyWhatIsTold) {
    const std::string shown =
        "return ['recorded-display', 'recorded-animation', 'recorded-busy-0'].filter((id) => "
        "document.getElementById(id)?.offsetParent)";
    open(game());
    EXPECT_EQ(value(shown), json({"recorded-display", "recorded-animation", "recorded-busy-0"}));
    open(bare());
    EXPECT_EQ(value(shown), json::array());
    hover(place("recorded-times", 10));
    wait_for("return !document.querySelector('#readout').hidden");
    EXPECT_EQ(value("return [...document.querySelectorAll('#readout td')].map((cell) => cell.dataset.key)"),
              json({"frame", "time", "rate", "stutter"}));
    const std::vector<FrameRecord> even(100, bare_[0]);
    open({"Even", {}, {}, {}, {}, {tests::reported("even", even)}});
    EXPECT_EQ(value("return document.querySelector('section.stutters')"), nullptr);
    EXPECT_EQ(value("return document.querySelector('#recorded .key-stutter').hidden"), true);
    EXPECT_EQ(value("return document.querySelector('#recorded .key-target').hidden"), true);
}

TEST_F(RecordingInBrowser, HoveringReadsOutTheFrame) {
    open(game());
    for (const std::size_t frame : {6U, 96U, 700U, 705U, 1200U, 1800U, 2200U, 2350U, 2699U, 2999U}) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        value("document.querySelector('#recorded-zoom-reset').click()");
        wait_for_span("> 30");
        zoom_to(begins(full_, frame) - 0.2, begins(full_, frame + 1) + 0.2);
        for (const char* chart : {"recorded-times", "recorded-display", "recorded-animation", "recorded-busy-0"}) {
            hover(place(chart, middle(full_, frame)));
            wait_for("return document.querySelector('#readout').dataset.frame == " + std::to_string(frame));
            expect_read_out(full_);
            EXPECT_EQ(value("return document.querySelectorAll('path.cross').length"), 4) << "through all charts";
        }
    }
    hover({{"x", 3}, {"y", 3}});
    wait_for("return document.querySelector('#readout').hidden");
}

TEST_F(RecordingInBrowser, HoveringReadsOutFramesByNumber) {
    open(game());
    choose("unit", "frames");
    for (const std::size_t frame : {6U, 2700U, 2350U}) {
        value("document.querySelector('#recorded-zoom-reset').click()");
        wait_for_span("> 2000");
        zoom_to(static_cast<double>(frame) - 20, static_cast<double>(frame) + 20);
        hover(place("recorded-display", static_cast<double>(frame)));
        wait_for("return document.querySelector('#readout').dataset.frame == " + std::to_string(frame));
        expect_read_out(full_);
    }
}

TEST_F(RecordingInBrowser, UnitsKeepTheFramesInView) {
    open(game());
    zoom_to(begins(full_, 1000), begins(full_, 1100));
    choose("unit", "frames");
    wait_for_span("> 50");
    const double first = from() + 0.5, last = to() - 0.5;
    EXPECT_NEAR(first, 1000, 5);
    EXPECT_NEAR(last, 1100, 5);
    for (int i = 0; i < 5; ++i) {
        choose("unit", "seconds");
        wait_for_span("< 5");
        EXPECT_NEAR(from(), begins(full_, static_cast<std::size_t>(std::lround(first))), 0.011);
        choose("unit", "frames");
        wait_for_span("> 50");
        EXPECT_NEAR(from() + 0.5, first, 1.01);
        EXPECT_NEAR(to() - 0.5, last, 1.01);
    }
}

TEST_F(RecordingInBrowser, WheelZoomsAllChartsAroundThePointer) {
    open(game());
    const double all = span(), at = 8;
    wheel(place("recorded-display", at), -600);
    wait_for_span("< " + std::to_string(0.8 * all));
    EXPECT_EQ(
        value("return new Set([...document.querySelectorAll('svg.over-time')].map((svg) => svg.dataset.from + ' ' + "
              "svg.dataset.to)).size"),
        1);
    EXPECT_NEAR((at - from()) / span(), at / all, 0.003);
    wait_for("return document.querySelector('#recorded-spread-range').textContent != 'of all frames'");
    value("document.querySelector('#recorded-zoom-reset').click()");
    wait_for("return document.querySelector('#recorded-spread-range').textContent == 'of all frames'");
    wait_for_span("> " + std::to_string(0.999 * all));
}

TEST_F(RecordingInBrowser, DraggingPicksARange) {
    open(game());
    const double all = span();
    drag(place("recorded-animation", 10), place("recorded-animation", 15));
    wait_for_span("< 6");
    EXPECT_NEAR(from(), 10, 0.05);
    EXPECT_NEAR(to(), 15, 0.05);
    browser_->act("pointer", json::array({move(place("recorded-times", 12)), down(), up(), down(), up()}));
    wait_for_span("> " + std::to_string(0.999 * all));
}

TEST_F(RecordingInBrowser, FingersZoomAndMove) {
    open(game());
    const double all = span();
    browser_->act(json::array({finger("one", "recorded-times", 12, 8), finger("two", "recorded-times", 16, 22)}));
    wait_for_span("< " + std::to_string(0.6 * all));
    const double before = from(), center = before + span() / 2;
    browser_->act(json::array({finger("one", "recorded-times", center, center - span() / 4)}));
    wait_for("return Number(document.querySelector('#recorded-times > svg').dataset.from) > " +
             std::to_string(before + 0.5));
    wait_for("return !document.querySelector('#readout').hidden");
}

TEST_F(RecordingInBrowser, KeysZoomMoveAndStep) {
    open(game());
    const double all = span();
    press("recorded-times", "+");
    wait_for_span("< " + std::to_string(0.7 * all));
    const double before = from();
    press("recorded-times", arrow_right);
    wait_for("return Number(document.querySelector('#recorded-times > svg').dataset.from) > " + std::to_string(before));
    press("recorded-display", "0");
    wait_for_span("> " + std::to_string(0.999 * all));
    step("recorded-times", arrow_right, 1);
    wait_for("return !document.querySelector('#readout').hidden");
    const std::size_t first = read_frame();
    step("recorded-times", arrow_right, 7);
    EXPECT_EQ(read_frame(), first + 7);
    expect_read_out(full_);
    step("recorded-times", arrow_left, 3);
    EXPECT_EQ(read_frame(), first + 4);
    expect_read_out(full_);
    EXPECT_EQ(value("return document.querySelector('#spoken').textContent.startsWith('At ')"), true);
}

TEST_F(RecordingInBrowser, StutterListShowsTheStutter) {
    open(game());
    auto stutters = game().recordings[0].stutters;
    ASSERT_EQ(value("return document.querySelectorAll('.stutters button').length"), stutters.size());
    for (const sfsm::Stutter& stutter : stutters) {
        const auto frame = static_cast<std::size_t>(stutter.frame);
        SCOPED_TRACE("frame " + std::to_string(frame));
        value("document.querySelector('.stutters [data-frame=\"" + std::to_string(frame) + "\"]').click()");
        wait_for("const { from, to } = document.querySelector('#recorded-times > svg').dataset; return from <= " +
                 std::to_string(begins(full_, frame)) + " && to >= " + std::to_string(begins(full_, frame + 1)));
        wait_for_span("< 1.5");
        EXPECT_EQ(value("const row = document.querySelector('.stutters [data-frame=\"" + std::to_string(frame) +
                        "\"]').closest('tr'); return row.querySelector('td.words').textContent"),
                  sfsm::name_of(stutter.cause));
    }
}

TEST_F(RecordingInBrowser, StutterListShowsAHiddenRecording) {
    open(two());
    const std::string pressed = "return document.querySelector('#recorded-legend [data-run=\"1\"]').ariaPressed";
    value("document.querySelector('#recorded-legend [data-run=\"1\"]').click()");
    wait_for(pressed + " == 'false'");
    value("document.querySelector('.stutters [data-recording=\"1\"]').click()");
    wait_for_span("< 1.5");
    EXPECT_EQ(value(pressed), "true");
    EXPECT_EQ(value("return document.querySelectorAll('#recorded-times path.measured').length"), 2);
}

TEST_F(RecordingInBrowser, EachStutterInViewIsMarked) {
    open(game());
    const std::string marks =
        "return [...document.querySelectorAll('#recorded-times > svg .stutter-mark')].reduce("
        "(sum, mark) => sum + mark.getAttribute('d').split('M').length - 1, 0)";
    EXPECT_EQ(value(marks), 7);
    zoom_to(begins(full_, 680), begins(full_, 720));
    EXPECT_EQ(value(marks), 2);
    choose("unit", "frames");
    EXPECT_EQ(value(marks), 2);
}

TEST_F(RecordingInBrowser, LegendHidesARecordingEverywhere) {
    open(two());
    const auto count = [&](const std::string& what) {
        return value("return document.querySelectorAll('" + what + "').length");
    };
    wait_for("return document.querySelectorAll('#recorded-steps path.percentile').length == 2");
    value("document.querySelector('#recorded-legend [data-run=\"0\"]').click()");
    wait_for("return document.querySelectorAll('#recorded-percentiles path.percentile').length == 1");
    EXPECT_EQ(count("#recorded-times path.measured"), 1);
    EXPECT_EQ(count("#recorded-display path.curve"), 0);
    EXPECT_EQ(count("#recorded-animation path.curve"), 0);
    EXPECT_EQ(count("#recorded-histogram path.bars"), 1);
    EXPECT_EQ(count("#recorded-steps path.percentile"), 1);
    EXPECT_EQ(value("return document.querySelector('#recorded-busy-0').hidden"), true);
    hover(place("recorded-times", 5));
    wait_for("return !document.querySelector('#readout').hidden");
    EXPECT_EQ(told(0, "time"), "");
    EXPECT_NE(told(1, "time"), "");
    value("document.querySelector('#recorded-legend [data-run=\"1\"]').click()");
    wait_for("return document.querySelectorAll('#recorded-times path.measured').length == 0");
    expect_only_numbers_however_shown();
}

// The height of an area over a frame, in the units of the axis beside it.
TEST_F(RecordingInBrowser, BusyAreasReachTheBusyTimes) {
    open(game());
    EXPECT_EQ(value("return document.querySelector('#recorded-busy-0 figcaption').textContent.includes('" +
                    figure(100 * game().recordings[0].figures.bottleneck.gpu, 0) + " %')"),
              true);
    choose("unit", "frames");
    zoom_to(2480, 2520);
    for (const std::size_t frame : {2490U, 2510U}) {
        for (const auto& [part, field] :
             {std::pair("gpu", &FrameRecord::gpu_ms), std::pair("cpu", &FrameRecord::cpu_ms)}) {
            const json top = value(
                "const svg = document.querySelector('#recorded-busy-0 > svg');"
                "const ticks = [...svg.querySelectorAll('g:first-of-type text')].map((text) => "
                "[Number(text.textContent), text.y.baseVal[0].value - 4]);"
                "const perPixel = (ticks.at(-1)[0] - ticks[0][0]) / (ticks.at(-1)[1] - ticks[0][1]);"
                "const clip = svg.querySelector('clipPath rect').getBBox(), { from, to } = svg.dataset;"
                "const x = clip.x + (" +
                std::to_string(frame) +
                " - from) / (to - from) * clip.width;"
                "const columns = svg.querySelector('.busy-" +
                std::string(part) +
                ":not(.at-times)').getAttribute('d').split('M').slice(1).map((d) => d.match(/-?[0-9.]+/g).map(Number));"
                "const [, , top] = columns.find(([left, , , right]) => left <= x && x < right);"
                "return ticks[0][0] + (top - ticks[0][1]) * perPixel");
            EXPECT_NEAR(top.get<double>(), full_[frame].*field, 0.05) << part << " of frame " << frame;
        }
    }
}

TEST_F(RecordingInBrowser, ScaleShowsTheLongestFrame) {
    open(game());
    const std::string highest =
        "return Math.max(...[...document.querySelectorAll('#recorded-times > svg > g:first-of-type text')]"
        ".map((text) => Number(text.textContent)))";
    EXPECT_LT(value(highest), 40);
    EXPECT_EQ(value("return document.querySelectorAll('#recorded-times .caret').length"), 1);
    for (const char* scale : {"full", "log"}) {
        choose("scale", scale);
        wait_for(highest + " >= 50");
        EXPECT_EQ(value("return document.querySelectorAll('#recorded-times .caret').length"), 0);
    }
}

TEST_F(RecordingInBrowser, OddRecordingsAreDrawn) {
    const FrameRecord untimed;
    FrameRecord usual, endless, zero;
    usual.frame_ms = usual.cpu_ms = usual.gpu_ms = 10;
    usual.display_ms = 10;
    endless.frame_ms = 600'000;
    endless.animation_error_ms = -1e30F;
    zero.frame_ms = 0;
    std::vector<FrameRecord> paused(500, usual);
    paused[250] = endless;
    const std::map<std::string, std::vector<FrameRecord>> odd = {{"no times", {untimed, untimed, untimed}},
                                                                 {"one frame", {usual}},
                                                                 {"two frames", {usual, endless}},
                                                                 {"ten minutes", {endless}},
                                                                 {"a pause", paused},
                                                                 {"zero", {zero, zero}},
                                                                 {"first untimed", {untimed, usual, usual}},
                                                                 {"all equal", std::vector(5000, usual)}};
    for (const auto& [name, frames] : odd) {
        SCOPED_TRACE(name);
        load({"odd", {}, {}, {}, {}, {tests::reported(name, frames)}});
        wait_for("return document.querySelector('#recorded-steps > svg').childElementCount > 0");
        expect_only_numbers_however_shown();
        hover(place("recorded-times", from() + span() / 2));
        wait_for("return !document.querySelector('#readout').hidden");
        step("recorded-times", arrow_right, 2);
        press("recorded-times", "+");
        expect_only_numbers();
    }
    const std::vector<FrameRecord> none;
    load({"none", {}, {}, {}, {}, {tests::reported("none", none), tests::reported("usual", paused)}});
    expect_only_numbers();
}

TEST_F(RecordingInBrowser, APauseCanBeZoomedPast) {
    std::vector<FrameRecord> frames(500, bare_[0]);
    frames[250].frame_ms = 600'000;
    open({"A pause", {}, {}, {}, {}, {tests::reported("paused", frames)}});
    value("document.querySelector('.stutters button').click()");
    press("recorded-times", "\uE011");  // home
    for (int i = 0; i < 30; ++i) press("recorded-times", "+");
    wait_for_span("< 0.2");
}

TEST_F(RecordingInBrowser, NamesStayText) {
    Report report = two();
    report.title = tests::hostile;
    for (sfsm::ReportedRecording& recording : report.recordings) {
        recording.name = recording.facts[0].first = recording.facts[0].second = recording.notes[0] = tests::hostile;
    }
    open(report);
    EXPECT_EQ(browser_->console(), json::array());
    EXPECT_EQ(value("return document.images.length + document.querySelectorAll('body script').length"), 1)
        << "the page's own";
    EXPECT_EQ(value("return document.querySelector('#recorded-legend button').textContent.startsWith('</title>')"),
              true);
    hover(place("recorded-times", 5));
    wait_for("return !document.querySelector('#readout').hidden");
    EXPECT_EQ(value("return document.images.length"), 0);
}

TEST_F(RecordingInBrowser, LawsNeverCoverWhatWasRecorded) {
    const std::string order =
        "return [...document.querySelectorAll('#frame-chart path.measured')].map((path) => "
        "path.closest('.run').dataset.run)";
    open(with_laws(3));
    EXPECT_EQ(value(order), json({"3", "2", "1", "0"}));
    Report thinned = with_laws(3);
    for (sfsm::ReportRun& run : thinned.runs) {
        const auto frames = run.frames;
        for (int i = 0; i < 20; ++i) run.frames.insert(run.frames.end(), frames.begin(), frames.end());
    }
    open(thinned);
    EXPECT_EQ(value(order), json({"3", "2", "1", "0"}));
    EXPECT_EQ(value("return [...document.querySelectorAll('#frame-chart path.curve')].filter((path) => "
                    "getComputedStyle(path).fill !== 'none').length"),
              0);
    EXPECT_EQ(value("return [...document.querySelectorAll('#frame-chart path.extent')].filter((path) => "
                    "getComputedStyle(path).opacity > 0.3).length"),
              0);
    EXPECT_EQ(value("return document.querySelectorAll('#frame-chart path.extent').length"), 4);
}

TEST_F(RecordingInBrowser, ManyLawsAreATable) {
    open(with_laws(8));
    EXPECT_EQ(value("return document.querySelector('#frame-chart')"), nullptr);
    EXPECT_EQ(value("return document.querySelectorAll('table.multiples tbody tr').length"), 9);
    EXPECT_EQ(value("return document.querySelectorAll('table.multiples svg.small path.small-run').length"), 9);
}

TEST_F(RecordingInBrowser, WordsOfLawsComeWithLaws) {
    const std::string words =
        "return (document.body.innerText.match(/\\b[DS]\\b|splat|\\blaws?\\b|controller|original|slowed/g) ?? [])"
        ".join(' ')";
    for (const Report& report : {game(), bare(), two()}) {
        open(report);
        EXPECT_EQ(value(words), "");
    }
    Report report = with_laws(1);
    for (sfsm::ReportRun& run : report.runs)
        for (sfsm::ReportFrame& frame : run.frames) frame.splat_size = 0;
    open(report);
    const auto has_word = [&](const std::string& word) {
        return value("return /\\b" + word + "\\b/.test(document.body.innerText)");
    };
    EXPECT_EQ(has_word("D"), true);
    EXPECT_EQ(value("return document.querySelector('#splat-chart').hidden"), true);
}

// Of text 4.5 to 1, of lines 3 to 1: WCAG 2.1.
TEST_F(RecordingInBrowser, InkIsReadableInBothSchemes) {
    open(two());
    value(
        "window.contrast = (one, other) => {"
        "  const light = (colour) => {"
        "    const canvas = new OffscreenCanvas(1, 1).getContext('2d');"
        "    canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);"
        "    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((part) => part / 255).map((part) => "
        "      (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));"
        "    return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05; };"
        "  const [a, b] = [light(one), light(other)];"
        "  return Math.max(a, b) / Math.min(a, b); };");
    for (const char* scheme : {"light", "dark"}) {
        SCOPED_TRACE(scheme);
        emulate("", scheme);
        const std::string ground =
            "const ground = getComputedStyle(document.querySelector('section')).backgroundColor;"
            "const style = (what) => getComputedStyle(document.querySelector(what));";
        for (const char* text : {"h2", "dt", ".hint", "td", "small", ".key"}) {
            EXPECT_GE(value(ground + "return contrast(style('" + text + "').color, ground)"), 4.5) << text;
        }
        EXPECT_GE(value(ground + "return contrast(style('#recorded-times text').fill, ground)"), 4.5);
        for (const int run : {0, 1}) {
            EXPECT_GE(value(ground + "return contrast(style('#recorded-times .run[data-run=\"" + std::to_string(run) +
                            "\"] .measured').stroke, ground)"),
                      3);
        }
        for (const char* part : {"gpu", "cpu"}) {
            EXPECT_GE(value(ground + "return contrast(style('.busy-" + part + "').fill, ground)"), 1.3) << part;
        }
    }
    emulate("", "light");
}

TEST_F(RecordingInBrowser, PrintsWell) {
    Report report = with_laws(8);
    report.recordings = two().recordings;
    report.comparisons = two().comparisons;
    open(report);
    emulate("print", "dark");
    value("window.dispatchEvent(new Event('beforeprint'))");
    EXPECT_EQ(value("return getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)");
    EXPECT_EQ(value("return [...document.querySelectorAll('.control')].every((part) => part.offsetParent === null)"),
              true);
    const json widths = value(
        "return [...document.querySelectorAll('svg.over-time')].filter((svg) => svg.checkVisibility()).map((svg) => "
        "svg.viewBox.baseVal.width)");
    EXPECT_EQ(widths, json({820, 820, 820, 820}));
    EXPECT_EQ(value("return [...document.querySelectorAll('.meanings dd')].filter((word) => !word.checkVisibility({ "
                    "contentVisibilityAuto: true })).length"),
              0)
        << "nobody hovers over paper";
    constexpr int paper = 700;  // A4 between its margins [px of 1/96 inch]
    browser_->command("Emulation.setDeviceMetricsOverride",
                      {{"width", paper}, {"height", 1000}, {"deviceScaleFactor", 1}, {"mobile", false}});
    EXPECT_EQ(
        value("return [...document.querySelectorAll('table')].filter((table) => table.getBoundingClientRect().right "
              "> 701).map((table) => table.className)"),
        json::array())
        << "paper doesn't scroll";
    emulate("", "light");
}

TEST_F(RecordingInBrowser, FitsAPhone) {
    for (const auto& [kind, report] : all_kinds()) {
        for (const int width : {390, 360}) {
            SCOPED_TRACE(kind + " at " + std::to_string(width));
            emulate_phone(width);
            open(report);
            wait_for("return document.querySelector('#recorded-times > svg').viewBox.baseVal.width < 360");
            expect_narrow(width);
            EXPECT_EQ(value("return [...document.querySelectorAll('th, td')].filter((cell) => cell.colSpan === "
                            "1).filter((cell) => {"
                            "  const box = cell.closest('.scroll');"
                            "  if (!box) return cell.getBoundingClientRect().right > innerWidth;"
                            "  box.scrollLeft = 0;"
                            "  box.scrollLeft = Math.max(0, cell.offsetLeft + cell.offsetWidth - box.clientWidth);"
                            "  const reached = cell.getBoundingClientRect(), around = box.getBoundingClientRect();"
                            "  return reached.left < around.left - 1 || reached.right > around.right + 1 || "
                            "    around.right > innerWidth;"
                            "}).map((cell) => cell.textContent)"),
                      json::array());
            hover(place("recorded-times", 2));
            wait_for("return !document.querySelector('#readout').hidden");
            EXPECT_EQ(value("const readout = document.querySelector('#readout'), box = readout.getBoundingClientRect();"
                            "return box.left >= 0 && box.right <= innerWidth && box.bottom <= innerHeight && "
                            "readout.scrollWidth <= readout.clientWidth"),
                      true)
                << value("return document.querySelector('#readout').scrollWidth");
        }
    }
}

// A hang fails; how long it takes is only told.
TEST_F(RecordingInBrowser, AMillionFramesOpen) {
    constexpr std::size_t peak = 654'321;
    const std::vector<FrameRecord> frames = tests::million_frames(peak);
    const Report report{"A million", {}, {}, {}, {}, {tests::reported("million.csv", frames)}};
    const auto begin = std::chrono::steady_clock::now();
    load(report);
    const std::chrono::duration<double> written = std::chrono::steady_clock::now() - begin;
    // Charts are drawn before the load event.
    const double drawn = value("return performance.getEntriesByType('navigation')[0].loadEventStart / 1000");
    const auto size = std::filesystem::file_size(folder_ / "a report.html");
    std::cout << "a million frames: " << size << " bytes, drawn by " << drawn << " s; written and opened in "
              << written.count() << " s\n";
    EXPECT_LT(size, 4'000'000);
    EXPECT_LT(drawn, 15);
    EXPECT_GT(value("return document.querySelectorAll('#recorded-busy-0 path').length"), 2);
    wait_for("return document.querySelectorAll('#recorded-percentiles path.curve').length > 0");
    expect_only_numbers();

    choose("unit", "frames");
    for (const double at : {2'345.0, 123'456.0, 400'001.0, 777'777.0, 997'980.0}) {
        value("document.querySelector('#recorded-zoom-reset').click()");
        wait_for_span("> 900000");
        settle();
        zoom_to(at - 15, at + 15);
        hover(place("recorded-times", at));
        wait_for("return document.querySelector('#readout').dataset.frame == " + std::to_string(std::lround(at)));
        for (int i = 0; i < 12; ++i) {
            const FrameRecord& frame = frames[read_frame()];
            EXPECT_NEAR(std::stod(told(0, "time")), frame.frame_ms, 0.01) << read_frame();
            step("recorded-times", arrow_right, 1);
        }
    }
    value("document.querySelector('#recorded-zoom-reset').click()");
    wait_for_span("> 900000");
    settle();
    zoom_to(static_cast<double>(peak) - 15, static_cast<double>(peak) + 15);
    hover(place("recorded-times", static_cast<double>(peak)));
    wait_for("return document.querySelector('#readout').dataset.frame == " + std::to_string(peak));
    EXPECT_TRUE(told(0, "display").ends_with("777.25")) << told(0, "display");
    EXPECT_TRUE(told(0, "gpu").ends_with("555.75")) << told(0, "gpu");
    EXPECT_TRUE(told(0, "animation").starts_with("-333.50")) << told(0, "animation");
}

}  // namespace
