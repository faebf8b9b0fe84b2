// The parts of a report that tell of recordings, read back: numbers, series, words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sfsm/report/numbers.h"
#include "sfsm/report/report.h"
#include "tests/report/sample.h"

namespace {

using nlohmann::json;
using sfsm::FrameRecord;
using sfsm::Report;
using sfsm::ReportedRecording;

// 10 ms and some, with a spike now and then; NaN where nothing is told.
std::vector<FrameRecord> frames_of(std::size_t count, bool tells_all) {
    std::vector<FrameRecord> frames(count);
    std::uint32_t state = 7;
    const auto next = [&] { return (state = state * 1664525U + 1013904223U) >> 8; };
    for (FrameRecord& frame : frames) {
        frame.frame_ms = 10 + 1e-6 * (next() % 2'000'000);
        if (next() % 200 == 0) frame.frame_ms += 30 + 1e-3 * (next() % 90'000);
        if (next() % 500 == 0) frame.frame_ms = FrameRecord::untold;
        if (!tells_all) continue;
        frame.cpu_ms = 0.5 * frame.frame_ms;
        frame.gpu_ms = 0.95 * frame.frame_ms;
        frame.display_ms = static_cast<float>(frame.frame_ms) + 0.001F * static_cast<float>(next() % 500);
        frame.animation_error_ms = 0.01F * (static_cast<float>(next() % 400) - 200);
        frame.compilations = next() % 1000 == 0 ? 3.0F : 0.0F;
    }
    return frames;
}

ReportedRecording recording_of(const std::string& name, const std::vector<FrameRecord>& frames) {
    return {name, {}, {}, frames, sfsm::figures_of(frames, 0, sfsm::usual_limits_ms), sfsm::stutters_of(frames)};
}

Report report_of(const std::vector<FrameRecord>& frames) {
    Report report;
    report.title = "game";
    report.recordings.push_back(recording_of("game.csv", frames));
    return report;
}

std::string html_of(const Report& report) {
    std::ostringstream out;
    sfsm::write_report_html(out, report);
    return out.str();
}

json embedded(const std::string& html) {
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t from = html.find(begin) + begin.size();
    return json::parse(html.substr(from, html.find("</script>", from) - from));
}

std::vector<unsigned> bytes_of(const std::string& base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned> bytes;
    unsigned bits = 0, held = 0;
    for (const char c : base64.substr(0, base64.find('='))) {
        bits = bits << 6 | static_cast<unsigned>(digits.find(c));
        held += 6;
        if (held >= 8) bytes.push_back(bits >> (held -= 8) & 0xFF);
    }
    return bytes;
}

// Varints of 1 + the zigzag of the change in quanta; 0 for none.
std::vector<double> unpacked(const json& packed) {
    std::vector<double> values;
    std::int64_t last = 0;
    std::uint64_t code = 0;
    unsigned shift = 0;
    for (const unsigned byte : bytes_of(packed["packed"])) {
        code |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
        shift += 7;
        if (byte & 0x80) continue;
        if (code > 0)
            last +=
                (code - 1) % 2 == 0 ? static_cast<std::int64_t>((code - 1) / 2) : -static_cast<std::int64_t>(code / 2);
        values.push_back(code > 0 ? static_cast<double>(last) * packed["quantum"].get<double>() : std::nan(""));
        code = shift = 0;
    }
    return values;
}

TEST(RecordingReport, TimesAreKeptToAThousandthAndOfManyFramesToAHundredth) {
    for (const auto& [count, quantum] : {std::pair<std::size_t, double>{1, 0.001}, {5000, 0.001}, {300'000, 0.01}}) {
        const std::vector<FrameRecord> frames = frames_of(count, false);
        const json recording = embedded(html_of(report_of(frames)))["recordings"][0];
        EXPECT_EQ(recording["frames"], count);
        EXPECT_EQ(recording["series"]["frame_ms"]["width"], 1);
        const std::vector<double> times = unpacked(recording["series"]["frame_ms"]["low"]);
        ASSERT_EQ(times.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(std::isnan(times[i]), std::isnan(frames[i].frame_ms)) << i;
            if (!std::isnan(times[i])) {
                ASSERT_NEAR(times[i], frames[i].frame_ms, quantum / 2 + 1e-5) << i;
            }
        }
    }
}

// Of few frames all, of many the least and the most of each stretch: no peak is lost.
TEST(RecordingReport, OtherSeriesKeepTheirPeaks) {
    for (const std::size_t count : {3000, 100'000}) {
        const std::vector<FrameRecord> frames = frames_of(count, true);
        const json series = embedded(html_of(report_of(frames)))["recordings"][0]["series"]["animation_error_ms"];
        const auto width = series["width"].get<std::size_t>();
        EXPECT_EQ(width == 1, count == 3000);
        const std::vector<double> low = unpacked(series["low"]);
        const std::vector<double> high = width == 1 ? low : unpacked(series["high"]);
        ASSERT_EQ(low.size(), (count + width - 1) / width);
        EXPECT_LE(low.size(), 20'000u);
        for (std::size_t i = 0; i < low.size(); ++i) {
            double least = 1e9, most = -1e9;
            for (std::size_t k = i * width; k < std::min(count, (i + 1) * width); ++k) {
                least = std::min<double>(least, frames[k].animation_error_ms);
                most = std::max<double>(most, frames[k].animation_error_ms);
            }
            ASSERT_NEAR(low[i], least, 0.0051) << i;
            ASSERT_NEAR(high[i], most, 0.0051) << i;
        }
    }
}

TEST(RecordingReport, WhatIsNotToldIsNotThere) {
    const std::string bare = html_of(report_of(frames_of(500, false))), full = html_of(report_of(frames_of(500, true)));
    for (const char* key : {"display_ms", "animation_error_ms", "cpu_ms", "gpu_ms"}) {
        EXPECT_FALSE(embedded(bare)["recordings"][0]["series"].contains(key)) << key;
        EXPECT_TRUE(embedded(full)["recordings"][0]["series"].contains(key)) << key;
    }
    for (const char* text : {"id=\"recorded-busy-0\"", ">Held up by<", ">animation error"}) {
        EXPECT_EQ(bare.find(text), bare.npos) << text;
        EXPECT_NE(full.find(text), full.npos) << text;
    }
    for (const char* text : {"id=\"comparisons-title\"", "id=\"laws-title\"", "id=\"times\"", ">dropped"})
        EXPECT_EQ(full.find(text), full.npos) << text;
}

TEST(RecordingReport, StuttersAreThoseThatWereFound) {
    const std::vector<FrameRecord> frames = frames_of(4000, true);
    const Report report = report_of(frames);
    const std::vector<sfsm::Stutter>& stutters = report.recordings[0].stutters;
    ASSERT_GT(stutters.size(), 10u);
    const json found = embedded(html_of(report))["recordings"][0]["stutters"];
    const std::vector<unsigned> places = bytes_of(found["frames"]), causes = bytes_of(found["causes"]);
    ASSERT_EQ(places.size(), 4 * stutters.size());
    ASSERT_EQ(causes.size(), stutters.size());
    for (std::size_t i = 0; i < stutters.size(); ++i) {
        EXPECT_EQ(places[4 * i] + (places[4 * i + 1] << 8), static_cast<unsigned>(stutters[i].frame));
        EXPECT_EQ(causes[i], static_cast<unsigned>(stutters[i].cause));
    }
}

TEST(RecordingReport, NumbersAreTheFiguresWithoutEmptyRows) {
    std::vector<FrameRecord> frames = frames_of(2000, false);
    frames[5].fate = FrameRecord::Fate::dropped;
    const std::vector<FrameRecord> others = frames_of(700, true);
    const std::vector<ReportedRecording> recordings = {recording_of("a", frames), recording_of("b", others)};
    std::size_t rows = 0;
    for (const sfsm::report::NumberGroup& group : sfsm::report::numbers_of(recordings)) {
        for (const sfsm::report::NumberRow& row : group.rows) {
            ++rows;
            ASSERT_EQ(row.values.size(), 2u) << row.name;
            EXPECT_TRUE(std::isfinite(row.values[0]) || std::isfinite(row.values[1])) << row.name;
            if (row.name == "average") {
                EXPECT_EQ(row.values[0], recordings[0].figures.average_fps);
            }
            if (row.name == "dropped") {
                EXPECT_EQ(row.values[0], 1);
                EXPECT_TRUE(std::isnan(row.values[1])) << "none is nothing to say";
            }
            if (row.name == "GPU") {
                EXPECT_TRUE(std::isnan(row.values[0]));
                EXPECT_EQ(row.values[1], 100 * recordings[1].figures.bottleneck.gpu);
            }
        }
    }
    EXPECT_GT(rows, 20u);
}

TEST(RecordingReport, NoTextBreaksOut) {
    const std::vector<FrameRecord> frames = frames_of(300, true);
    Report hostile = report_of(frames), plain = hostile;
    for (auto& [report, text] : {std::pair<Report&, std::string>{hostile, tests::hostile}, {plain, "x"}}) {
        report.title = report.recordings[0].name = report.runs_title = report.runs_words = text;
        report.recordings[0].facts = {{text, text}};
        report.recordings[0].notes = {text};
        report.recordings.push_back(report.recordings[0]);
        report.comparisons.push_back({0, 1, {{text, text, 1, 2, 1, 0.5, 1.5, false}}});
        report.runs.assign(9, tests::sample_run(text, 1, true));
    }
    const std::string html = html_of(hostile), harmless = html_of(plain);
    const auto count = [](const std::string& text, const std::string& part) {
        std::size_t found = 0;
        for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; ++at) ++found;
        return found;
    };
    for (const char* tag : {"<script", "</script", "</title", "<img", "id=\"data\"", "<td", "<li"})
        EXPECT_EQ(count(html, tag), count(harmless, tag)) << tag;
    EXPECT_EQ(html.find('\x01'), html.npos);
    EXPECT_EQ(embedded(html)["recordings"].size(), 2u);
}

// Over six laws are a table with small pictures; what was recorded is besides.
TEST(RecordingReport, ManyLawsAreATable) {
    const std::vector<FrameRecord> frames = frames_of(300, true);
    Report report = report_of(frames);
    report.runs.assign(7, tests::sample_run("law", 1, true));
    EXPECT_NE(html_of(report).find("id=\"frame-chart\""), std::string::npos);
    report.runs.push_back(report.runs[0]);
    const std::string html = html_of(report);
    EXPECT_EQ(html.find("id=\"frame-chart\""), html.npos);
    std::size_t pictures = 0;
    for (std::size_t at = 0; (at = html.find("<svg class=\"small\"", at)) != html.npos; ++at) ++pictures;
    EXPECT_EQ(pictures, 8u);
}

TEST(RecordingReport, AMillionFramesAreUnderFourMegabytes) {
    const std::vector<FrameRecord> frames = frames_of(1'000'000, true);
    Report report = report_of(frames);
    EXPECT_LT(html_of(report).size(), 4'000'000u);
    report.runs.assign(1, {"law", std::vector<sfsm::ReportFrame>(1'000'000), {}});
    for (std::size_t i = 0; i < frames.size(); ++i) {
        sfsm::ReportFrame& frame = report.runs[0].frames[i];
        frame.frame_ms = frame.predicted_ms = static_cast<float>(frames[i].frame_ms);
        frame.state = i % 2 == 0 ? sfsm::State::points : sfsm::State::slowed;
        frame.splat_size = static_cast<float>(i % 7);
    }
    report.runs.push_back(report.runs[0]);
    EXPECT_LT(html_of(report).size(), 4'000'000u) << "with what two laws made of them";
}

}  // namespace
