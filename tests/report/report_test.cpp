#include "sfsm/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sfsm/report/plot.h"
#include "tests/report/sample.h"

namespace {

using nlohmann::json;
using sfsm::Report;
using sfsm::ReportFrame;
using sfsm::ReportRun;
using sfsm::Score;
using sfsm::State;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::string html_of(const Report& report) {
    std::ostringstream out;
    sfsm::write_report_html(out, report);
    return out.str();
}

std::string svg_of(const Report& report) {
    std::ostringstream out;
    sfsm::write_report_svg(out, report);
    return out.str();
}

Report report_of(std::vector<ReportFrame> frames) {
    ReportRun run{"law", std::move(frames), {}};
    run.scores = sfsm::time_scores(run.frames);
    return {"title", {}, {run}};
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++found;
    return found;
}

std::string unbase64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int held = 0;
    for (const char c : text.substr(0, text.find('='))) {
        bits = bits << 6 | static_cast<unsigned>(digits.find(c));
        held += 6;
        if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 0xFF);
    }
    return bytes;
}

template <class Number>
std::vector<Number> numbers(const std::string& base64) {
    const std::string bytes = unbase64(base64);
    std::vector<Number> values(bytes.size() / sizeof(Number));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

// As the page's script does it: of a series that is not thinned.
template <class Number>
std::vector<Number> decoded(const json& series) {
    EXPECT_EQ(series["width"], 1);
    const auto values = numbers<Number>(series["low"]["values"]);
    if (series["low"]["counts"] == "") return values;
    const auto counts = numbers<std::uint32_t>(series["low"]["counts"]);
    std::vector<Number> all;
    for (std::size_t i = 0; i < values.size(); ++i) all.insert(all.end(), counts[i], values[i]);
    return all;
}

json embedded(const std::string& html) {
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t from = html.find(begin) + begin.size();
    return json::parse(html.substr(from, html.find("</script>", from) - from));
}

void expect_embedded(const std::vector<ReportFrame>& frames, const json& run) {
    ASSERT_EQ(run["frames"], frames.size());
    const std::pair<const char*, float ReportFrame::*> fields[] = {{"target_ms", &ReportFrame::target_ms},
                                                                   {"frame_ms", &ReportFrame::frame_ms},
                                                                   {"predicted_ms", &ReportFrame::predicted_ms},
                                                                   {"motion_distance", &ReportFrame::motion_distance},
                                                                   {"splat_size", &ReportFrame::splat_size}};
    for (const auto& [name, field] : fields) {
        const auto values = decoded<std::uint32_t>(run["series"][name]);
        ASSERT_EQ(values.size(), frames.size()) << name;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool means_nothing = field == &ReportFrame::motion_distance && frames[i].state == State::original;
            const float expected = means_nothing ? nan : frames[i].*field;
            ASSERT_EQ(values[i], std::bit_cast<std::uint32_t>(expected)) << name << " of frame " << i;
        }
    }
    const bool is_by_rate = std::ranges::any_of(frames, [](const ReportFrame& frame) { return frame.rate > 0; });
    ASSERT_EQ(run["series"].contains("rate"), is_by_rate) << "where it has a value";
    if (is_by_rate) {
        const auto rates = decoded<float>(run["series"]["rate"]);
        ASSERT_EQ(rates.size(), frames.size());
        for (std::size_t i = 0; i < rates.size(); ++i) ASSERT_EQ(rates[i], frames[i].rate) << i;
    }
    const auto states = decoded<std::uint8_t>(run["series"]["state"]);
    ASSERT_EQ(states.size(), frames.size());
    for (std::size_t i = 0; i < states.size(); ++i) ASSERT_EQ(states[i], static_cast<int>(frames[i].state));
}

// The attributes of a tag, by name; `tag` without its brackets. Empty values where they are not quoted.
std::map<std::string, std::string> attributes(const std::string& tag) {
    std::map<std::string, std::string> found;
    for (std::size_t at = tag.find(' '); at < tag.size() && tag[at] == ' ';) {
        const std::size_t quote = tag.find("=\"", at);
        if (quote == tag.npos) break;
        const std::size_t end = std::min(tag.find('"', quote + 2), tag.size());
        found[tag.substr(at + 1, quote - at - 1)] = tag.substr(quote + 2, end - quote - 2);
        at = end + 1;
    }
    return found;
}

// Calls see(tag) with each tag's text between the brackets.
template <class See>
void for_each_tag(const std::string& xml, See see) {
    for (std::size_t at = 0; (at = xml.find('<', at)) != xml.npos;) {
        const std::size_t end = xml.find('>', at);
        see(xml.substr(at + 1, end - at - 1));
        at = end;
    }
}

bool is_reference(const std::string& xml, std::size_t at) {
    for (const std::string name : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
        if (xml.compare(at, name.size(), name) == 0) return true;
    }
    return false;
}

// Enough of XML for pictures of ours: tags nest, attributes are quoted, text has no bare '<' or '&' and no control
// characters.
void expect_well_formed(const std::string& xml) {
    for (std::size_t at = 0; at < xml.size(); ++at) {
        ASSERT_TRUE(static_cast<unsigned char>(xml[at]) >= 0x20 || xml[at] == '\n') << "at " << at;
        ASSERT_TRUE(xml[at] != '&' || is_reference(xml, at)) << xml.substr(at, 40);
    }
    ASSERT_EQ(count(xml, "<"), count(xml, ">"));
    std::vector<std::string> open;
    for_each_tag(xml, [&](const std::string& tag) {
        if (tag[0] == '/') {
            ASSERT_FALSE(open.empty()) << tag;
            EXPECT_EQ(open.back(), tag.substr(1));
            return open.pop_back();
        }
        EXPECT_EQ(count(tag, "\""), 2 * attributes(tag).size()) << tag;
        if (tag.back() != '/') open.push_back(tag.substr(0, tag.find(' ')));
    });
    EXPECT_TRUE(open.empty()) << open.back() << " is not closed";
}

std::vector<std::pair<std::string, Report>> odd_reports() {
    ReportFrame unknown, huge, endless, hidden;
    huge.target_ms = 16;
    huge.frame_ms = 1e30F;
    huge.predicted_ms = 1e-30F;
    endless.target_ms = endless.frame_ms = endless.motion_distance = endless.predicted_ms = infinity;
    endless.state = State::slowed;
    hidden.target_ms = -1;
    hidden.frame_ms = -5;
    hidden.motion_distance = -infinity;
    hidden.splat_size = nan;
    hidden.state = State::points;
    return {{"no frames", report_of({})},
            {"one unknown frame", report_of({unknown})},
            {"unknown frames", report_of(std::vector<ReportFrame>(3000, unknown))},
            {"one huge frame", report_of({huge})},
            {"infinite", report_of({endless, endless})},
            {"negative", report_of({hidden, hidden})},
            {"all of them", report_of({unknown, huge, endless, hidden})},
            {"no scores", {"", {}, {{"", {huge}, {}}}}}};
}

TEST(Report, EmbeddedFramesAreTheSameToTheBit) {
    Report report = tests::sample_report();
    report.runs[0].frames[5].predicted_ms = -infinity;
    report.runs[0].frames[6].frame_ms = std::bit_cast<float>(0xFFC00001U);  // a NaN of its own
    const json data = embedded(html_of(report));
    ASSERT_EQ(data["runs"].size(), 2);
    for (std::size_t i = 0; i < 2; ++i) expect_embedded(report.runs[i].frames, data["runs"][i]);
    for (const auto& [name, odd] : odd_reports()) {
        SCOPED_TRACE(name);
        expect_embedded(odd.runs[0].frames, embedded(html_of(odd))["runs"][0]);
    }
}

TEST(Report, WhatHardlyChangesIsStoredOnce) {
    Report report = report_of(std::vector<ReportFrame>(100'000));
    for (std::size_t i = 0; i < 100'000; ++i) report.runs[0].frames[i].frame_ms = static_cast<float>(i);
    EXPECT_LT(html_of(report).size(), 100'000 * 4 * 4 / 3 + 300'000) << "times and the page itself";
}

TEST(Report, NoTextBreaksOut) {
    const std::string html = html_of(tests::sample_report());
    Report harmless = tests::sample_report();
    harmless.title = harmless.runs[1].name = "x";
    harmless.facts[1] = {"x", "x"};
    const std::string plain = html_of(harmless);
    for (const char* tag : {"<script", "</script", "</title", "<img", "id=\"data\""}) {
        EXPECT_EQ(count(html, tag), count(plain, tag)) << tag;
    }
    EXPECT_EQ(html.find('\x01'), html.npos);
    EXPECT_EQ(html.find('\xFF'), html.npos);
    EXPECT_EQ(embedded(html)["runs"].size(), 2);
}

TEST(Report, NeedsNothingElse) {
    const std::string html = html_of(report_of({ReportFrame{16, 16, 16, 100, 0, State::slowed}}));
    EXPECT_EQ(count(html, "http"), 2) << "the header that forbids resources, and the picture's name space";
    EXPECT_EQ(count(html, "http-equiv"), 1);
    EXPECT_EQ(count(html, "http://www.w3.org/2000/svg"), 1);
    EXPECT_EQ(html.find("src="), html.npos);
    EXPECT_EQ(html.find("@import"), html.npos);
    EXPECT_EQ(count(html, "href="), 1);
    EXPECT_EQ(count(html, "href=\"data:,\""), 1);
}

TEST(Report, SameReportGivesTheSameBytes) {
    EXPECT_EQ(html_of(tests::sample_report()), html_of(tests::sample_report()));
    EXPECT_EQ(svg_of(tests::sample_report()), svg_of(tests::sample_report()));
}

TEST(Report, PictureIsWellFormed) {
    expect_well_formed(svg_of(tests::sample_report()));
    for (const auto& [name, report] : odd_reports()) {
        SCOPED_TRACE(name);
        expect_well_formed(svg_of(report));
    }
}

TEST(Report, PictureHasOnlyFiniteNumbers) {
    for (const auto& [name, report] : odd_reports()) {
        SCOPED_TRACE(name);
        for_each_tag(svg_of(report), [](const std::string& tag) {
            for (const auto& [attribute, value] : attributes(tag)) {
                if (attribute == "d") {
                    EXPECT_EQ(value.find_first_not_of("MLHVZmlhvz-. 0123456789"), value.npos) << tag;
                }
                for (const char* place : {"x", "y", "width", "height"}) {
                    if (attribute != place) continue;
                    EXPECT_EQ(value.find_first_not_of("-.%0123456789"), value.npos) << tag;
                }
            }
        });
    }
}

TEST(Report, PictureOfManyFramesKeepsASingleSpikeAndStaysSmall) {
    Report report = report_of(std::vector<ReportFrame>(200'000, ReportFrame{16, 16, 16, 100, 0, State::slowed}));
    const std::string even = svg_of(report);
    report.runs[0].frames[123'456].frame_ms = 500;
    const std::string spiked = svg_of(report);
    EXPECT_LT(spiked.size(), 200'000);
    EXPECT_EQ(count(even, "h7l-3.5 -6z"), 0);
    EXPECT_EQ(count(spiked, "h7l-3.5 -6z"), 1) << "a caret where it is clipped";
}

TEST(Report, ATimeThatStandsAloneIsSeen) {
    const ReportFrame measured{16, 12, nan, 100, 0, State::slowed}, unknown{16, nan, nan, 100, 0, State::slowed};
    EXPECT_EQ(count(svg_of(report_of({measured})), "h-3h6"), 1);
    EXPECT_EQ(count(svg_of(report_of({measured, unknown, measured})), "h-3h6"), 2);
    EXPECT_EQ(count(svg_of(report_of({measured, measured, unknown})), "h-3h6"), 0);
}

// 16.6 ms is of some use as a scale even where all times are 0.
TEST(Report, TheTargetIsAlwaysOnTheAxis) {
    for (const float ms : {0.0F, 1e-30F, 1.0F, 16.6F, 500.0F}) {
        const std::vector<float> times(20, ms), targets(20, 16.6F);
        EXPECT_GT(sfsm::report::fitted_top(times, targets), 1.05 * 16.6) << ms;
    }
}

TEST(Report, ManyFramesDontHideTheTarget) {
    const std::string curve = "stroke=\"#0072b2\" stroke-linejoin";
    const std::string few = svg_of(report_of(std::vector<ReportFrame>(100, ReportFrame{16, 15})));
    EXPECT_LT(few.find("stroke=\"#56606c\""), few.find(curve));
    const std::string many = svg_of(report_of(std::vector<ReportFrame>(100'000, ReportFrame{16, 15})));
    EXPECT_LT(many.find(curve), many.find("stroke=\"#1c2127\""));
    EXPECT_NE(many.find("stroke=\"#1c2127\""), many.npos);
}

TEST(Report, BestOfEachFigureIsMarked) {
    Report report = tests::sample_report();
    report.runs.push_back(report.runs[1]);
    const double values[3] = {1, 2, 2.004};
    for (std::size_t i = 0; i < 3; ++i) {
        report.runs[i].scores = {{"most", "", values[i], 2, Score::Better::more},
                                 {"least", "ms", values[i], 2, Score::Better::less},
                                 {"neither", "", values[i], 2, Score::Better::neither},
                                 {"none", "", nan, 2, Score::Better::more},
                                 {"same", "", 3 + 1e-6 * values[i], 2, Score::Better::more}};
    }
    const std::string html = html_of(report);
    EXPECT_EQ(count(html, "<td class=\"best\">"), 3);
    EXPECT_EQ(count(html, "<td class=\"best\">2.00"), 2) << "what looks the same is as good";
    EXPECT_EQ(count(html, "<td class=\"best\">1.00"), 1);
    EXPECT_EQ(count(html, "<td>\u2013</td>"), 3);
}

TEST(Report, ScoresAreOfMeasuredFrames) {
    std::vector<ReportFrame> frames(100, ReportFrame{10, 10, nan, 0, 0, State::original});
    frames[0].frame_ms = 11;
    frames[1].frame_ms = 30;
    frames.push_back({10, nan, nan, 0, 0, State::original});
    std::map<std::string, double> scores;
    for (const Score& score : sfsm::time_scores(frames)) scores[score.name] = score.value;
    EXPECT_NEAR(scores["control rate"], 98.9, 1e-9);
    EXPECT_NEAR(scores["within 5 %"], 98, 1e-9);
    EXPECT_NEAR(scores["within 10 %"], 99, 1e-9);
    EXPECT_NEAR(scores["over by 5 %"], 2, 1e-9);
    EXPECT_NEAR(scores["mean"], 10.21, 1e-9);
    EXPECT_EQ(scores["median"], 10);
    EXPECT_EQ(scores["99th percentile"], 11);
    for (const Score& score : sfsm::time_scores({{}})) EXPECT_TRUE(std::isnan(score.value)) << score.name;
}

TEST(Report, FrameOfATraceRow) {
    sfsm::TraceRow row;
    row.target_ms = 33;
    row.frame_ms = 34.5;
    row.predicted_ms = 32;
    row.decision = {State::points, 120, 4.25, 0.5};
    const ReportFrame frame = sfsm::report_frame(row);
    EXPECT_EQ(frame.target_ms, 33);
    EXPECT_EQ(frame.frame_ms, 34.5F);
    EXPECT_EQ(frame.predicted_ms, 32);
    EXPECT_EQ(frame.motion_distance, 120);
    EXPECT_EQ(frame.splat_size, 4.25F);
    EXPECT_EQ(frame.rate, 0.5F);
    EXPECT_EQ(frame.state, State::points);
}

}  // namespace
