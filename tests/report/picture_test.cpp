// The picture of a run, read back: what is drawn lies where the axes' labels say that its numbers lie.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "sfsm/report/report.h"

namespace {

using sfsm::Report;
using sfsm::ReportFrame;
using sfsm::State;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double left = 64, right = 936;  // [px] of all charts
constexpr double hundredths = 0.03;       // [px] numbers have two decimals, and labels give the scale
constexpr const char* first_colour = "#0072b2";
constexpr const char* second_colour = "#d55e00";

struct Point {
    double x = 0, y = 0;
};

struct Label {
    double x = 0, y = 0;
    std::string anchor, text;
};

struct Box {
    double x = 0, y = 0, width = 0, height = 0;
    std::string fill;
};

std::string svg_of(const std::vector<std::vector<ReportFrame>>& runs) {
    Report report;
    for (const auto& frames : runs) report.runs.push_back({"law", frames, {}});
    std::ostringstream out;
    sfsm::write_report_svg(out, report);
    return out.str();
}

template <class See>
void for_each_match(const std::string& text, const std::string& pattern, See see) {
    const std::regex regex(pattern);
    for (std::sregex_iterator found(text.begin(), text.end(), regex), end; found != end; ++found) see(*found);
}

std::vector<Label> labels(const std::string& svg) {
    std::vector<Label> all;
    for_each_match(svg, R"re(<text x="([-\d.]+)" y="([-\d.]+)" [^>]*text-anchor="(\w+)">([^<]*)</text>)re",
                   [&](const std::smatch& m) {
                       all.push_back({std::stod(m[1]), std::stod(m[2]), m[3], m[4]});
                   });
    return all;
}

std::vector<Box> boxes(const std::string& svg, const std::string& fill) {
    std::vector<Box> all;
    for_each_match(svg,
                   R"re(<rect x="([-\d.]+)" y="([-\d.]+)" width="([-\d.]+)" height="([-\d.]+)" fill="([^"]*)"/>)re",
                   [&](const std::smatch& m) {
                       if (m[5] != fill) return;
                       all.push_back({std::stod(m[1]), std::stod(m[2]), std::stod(m[3]), std::stod(m[4]), m[5]});
                   });
    return all;
}

// Of each curve of that colour, where its frames begin, in the order of the charts: times, D, S.
std::vector<std::vector<Point>> curves(const std::string& svg, const std::string& colour) {
    std::vector<std::vector<Point>> all;
    for_each_match(svg, "<path d=\"([^\"]*)\" fill=\"none\" stroke=\"" + colour + "\"([^>]*)>",
                   [&](const std::smatch& m) {
                       if (m.str(2).find("dasharray") != std::string::npos) return;  // what was predicted
                       std::vector<Point>& curve = all.emplace_back();
                       for_each_match(m[1], R"re([ML]([-\d.]+) ([-\d.]+))re", [&](const std::smatch& p) {
                           curve.push_back({std::stod(p[1]), std::stod(p[2])});
                       });
                   });
    return all;
}

// The y of a number by the labels of a chart: they are 4 px below the line that they name.
class Scale {
public:
    Scale(const std::string& svg, std::size_t chart) {
        double before = std::numeric_limits<double>::infinity();
        std::size_t charts = 0;
        std::vector<Point> ticks;
        for (const Label& label : labels(svg)) {
            if (label.anchor != "end" || label.x != left - 8) continue;
            const double value = std::stod(label.text);
            if (value <= before) ++charts;
            before = value;
            if (charts == chart + 1) ticks.push_back({value, label.y - 4});
        }
        EXPECT_GE(ticks.size(), 2u);
        if (ticks.size() < 2) return;
        per_unit_ = (ticks.back().y - ticks.front().y) / (ticks.back().x - ticks.front().x);
        zero_ = ticks.front().y - per_unit_ * ticks.front().x;
        for (const Point& tick : ticks) EXPECT_NEAR((*this)(tick.x), tick.y, hundredths) << "even";
        EXPECT_LT(per_unit_, 0) << "more is higher";
    }
    double operator()(double value) const { return zero_ + per_unit_ * value; }

private:
    double per_unit_ = 0, zero_ = 0;
};

constexpr int frame_count = 20;
double x_of(double frame) {
    return left + (frame + 0.5) / frame_count * (right - left);
}

std::vector<ReportFrame> rising() {
    std::vector<ReportFrame> frames;
    for (int i = 0; i < frame_count; ++i) {
        frames.push_back({10, static_cast<float>(5 + 0.5 * i), nan, static_cast<float>(100 + 5 * i),
                          static_cast<float>(1 + 0.25 * i), State::points});
    }
    return frames;
}

TEST(Picture, CurvesLieWhereTheLabelsSay) {
    const std::string svg = svg_of({rising()});
    const auto found = curves(svg, first_colour);
    ASSERT_EQ(found.size(), 3u) << "times, D and S";
    for (const auto& curve : found) ASSERT_EQ(curve.size(), static_cast<std::size_t>(frame_count));
    const Scale times(svg, 0), distances(svg, 1), sizes(svg, 2);
    for (int i = 0; i < frame_count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_NEAR(found[0][k].x, x_of(i), hundredths) << "in the middle of the frame";
        EXPECT_NEAR(found[0][k].y, times(5 + 0.5 * i), hundredths);
        EXPECT_NEAR(found[1][k].x, x_of(i - 0.5), hundredths) << "from where the frame begins";
        EXPECT_NEAR(found[1][k].y, distances(100 + 5 * i), hundredths);
        EXPECT_NEAR(found[2][k].y, sizes(1 + 0.25 * i), hundredths);
    }
}

TEST(Picture, FramesAreLabelledInTheirMiddle) {
    int seen = 0;
    for (const Label& label : labels(svg_of({rising()}))) {
        if (label.anchor != "middle") continue;
        EXPECT_NEAR(label.x, x_of(std::stod(label.text)), hundredths) << label.text;
        ++seen;
    }
    EXPECT_GE(seen, 3 * 5) << "under each chart";
}

TEST(Picture, RunsOfOneReportShareTheirAxes) {
    std::vector<ReportFrame> half = rising();
    half.resize(frame_count / 2);
    for (ReportFrame& frame : half) frame.frame_ms += 2;
    const std::string svg = svg_of({rising(), half});
    const auto second = curves(svg, second_colour);
    ASSERT_EQ(second.size(), 3u);
    ASSERT_EQ(second[0].size(), half.size());
    const Scale times(svg, 0);
    for (std::size_t i = 0; i < half.size(); ++i) {
        EXPECT_NEAR(second[0][i].x, x_of(static_cast<double>(i)), hundredths);
        EXPECT_NEAR(second[0][i].y, times(half[i].frame_ms), hundredths);
    }
}

TEST(Picture, TheBandIsFivePercentOnEitherSideOfEachTarget) {
    std::vector<ReportFrame> frames = rising();
    for (int i = 12; i < frame_count; ++i) frames[static_cast<std::size_t>(i)].target_ms = 8;
    const std::string svg = svg_of({frames});
    const Scale times(svg, 0);
    const auto bands = boxes(svg, "#dde3ec");
    ASSERT_EQ(bands.size(), 2u);
    for (const auto& [band, target, begin, end] :
         {std::tuple{bands[0], 10.0, 0, 12}, std::tuple{bands[1], 8.0, 12, frame_count}}) {
        EXPECT_NEAR(band.x, x_of(begin - 0.5), hundredths);
        EXPECT_NEAR(band.x + band.width, x_of(end - 0.5), hundredths);
        EXPECT_NEAR(band.y, times(1.05 * target), hundredths);
        EXPECT_NEAR(band.y + band.height, times(0.95 * target), hundredths);
    }
}

// Each state has its fill: the first three boxes are the legend's.
TEST(Picture, TheStripShowsHowLongEachStateLasted) {
    std::vector<ReportFrame> frames = rising();
    const std::array<const char*, 3> fills = {"#dce2e9", "url(#state-slowed)", "#7486a0"};
    const std::array<int, 4> begins = {0, 11, 15, frame_count};
    for (int state = 0; state < 3; ++state) {
        const auto s = static_cast<std::size_t>(state);
        for (int i = begins[s]; i < begins[s + 1]; ++i)
            frames[static_cast<std::size_t>(i)].state = static_cast<State>(state);
    }
    const std::string svg = svg_of({frames});
    for (std::size_t state = 0; state < 3; ++state) {
        const auto found = boxes(svg, fills[state]);
        ASSERT_EQ(found.size(), 2u) << "the legend's and the strip's";
        EXPECT_NEAR(found[1].x, x_of(begins[state] - 0.5), hundredths);
        EXPECT_NEAR(found[1].x + found[1].width, x_of(begins[state + 1] - 0.5), hundredths);
        EXPECT_EQ(found[1].height, 12);
    }
}

// Where many frames share a column, so do their states.
TEST(Picture, AStripOfManyFramesIsSharedInProportion) {
    std::vector<ReportFrame> frames(87'200, ReportFrame{10, 9, nan, 100, 1, State::points});
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].state = i % 4 == 0 ? State::original : State::points;
    const std::string svg = svg_of({frames});
    double original = 0, points = 0;
    for (const Box& box : boxes(svg, "#dce2e9")) original += box.width * box.height;
    for (const Box& box : boxes(svg, "#7486a0")) points += box.width * box.height;
    constexpr double legend = 20 * 12, all = (right - left) * 12;
    EXPECT_NEAR((original - legend) / all, 0.25, 0.01);
    EXPECT_NEAR((points - legend) / all, 0.75, 0.01);
}

TEST(Picture, DMeansNothingInStateZero) {
    std::vector<ReportFrame> frames = rising();
    for (std::size_t i = 0; i < 10; ++i) frames[i].state = State::original;
    const auto found = curves(svg_of({frames}), first_colour);
    ASSERT_EQ(found.size(), 3u);
    ASSERT_EQ(found[1].size(), 10u);
    EXPECT_NEAR(found[1][0].x, x_of(9.5), hundredths);
}

TEST(Picture, ThePercentilesAreNearestRanks) {
    std::vector<ReportFrame> frames;
    for (int i = 0; i < 1000; ++i) {  // 1 to 1000, each once
        frames.push_back({1000, static_cast<float>((i * 377) % 1000 + 1), nan, nan, 0, State::original});
    }
    frames.push_back({1000, nan, nan, nan, 0, State::original});
    std::vector<std::string> told;
    for (const Label& label : labels(svg_of({frames}))) {
        if (label.anchor == "end" && label.text.find('.') != std::string::npos) told.push_back(label.text);
    }
    ASSERT_GE(told.size(), 8u);
    EXPECT_EQ(std::vector<std::string>(told.end() - 7, told.end()),
              (std::vector<std::string>{"10.0", "500.0", "900.0", "950.0", "990.0", "999.0", "1000.0"}));
}

// Frames of 10 to 29 ms, one after the other.
std::vector<sfsm::FrameRecord> recorded_frames() {
    std::vector<sfsm::FrameRecord> frames(frame_count);
    for (int i = 0; i < frame_count; ++i) frames[static_cast<std::size_t>(i)].frame_ms = 10 + i;
    return frames;
}

TEST(Picture, RecordedTimesLieOverTheirSeconds) {
    const std::vector<sfsm::FrameRecord> frames = recorded_frames();
    Report report;
    report.recordings.push_back({"game", {}, {}, frames, sfsm::figures_of(frames, 0, {}), sfsm::stutters_of(frames)});
    std::ostringstream out;
    sfsm::write_report_svg(out, report);
    const auto found = curves(out.str(), first_colour);
    ASSERT_EQ(found.size(), 1u) << "no law, no D and S";
    ASSERT_EQ(found[0].size(), frames.size());
    const Scale times(out.str(), 0);
    double begins = 0, all = 0;
    for (const sfsm::FrameRecord& frame : frames) all += frame.frame_ms;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double middle = begins + frames[i].frame_ms / 2;
        EXPECT_NEAR(found[0][i].x, left + middle / all * (right - left), hundredths) << i;
        EXPECT_NEAR(found[0][i].y, times(frames[i].frame_ms), hundredths) << i;
        begins += frames[i].frame_ms;
    }
    for (const Label& label : labels(out.str())) {
        if (label.anchor != "middle") continue;
        EXPECT_NEAR(label.x, left + 1000 * std::stod(label.text) / all * (right - left), hundredths) << label.text;
    }
}

TEST(Picture, ARecordingWithoutTimesIsAnEmptyChart) {
    const std::vector<sfsm::FrameRecord> frames(3);
    Report report;
    report.recordings.push_back({"game", {}, {}, frames, sfsm::figures_of(frames, 0, {}), {}});
    std::ostringstream out;
    sfsm::write_report_svg(out, report);
    EXPECT_EQ(out.str().find("nan"), std::string::npos);
    EXPECT_EQ(out.str().find("inf"), std::string::npos);
    EXPECT_TRUE(curves(out.str(), first_colour).empty());
}

}  // namespace
