// Display times, animation errors, compilations and what became of a frame.
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>

#include "sfsm/number_text.h"
#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

using Fate = FrameRecord::Fate;

// A file of columns that are told by name, of one game.
struct Log {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;

    std::string text() const {
        Table table;
        table.columns = {"Application", "ProcessID", "SwapChainAddress", "MsBetweenPresents"};
        table.columns.insert(table.columns.end(), columns.begin(), columns.end());
        for (const std::vector<std::string>& row : rows) {
            table.rows.push_back({"a.exe", "12", "0xA0", "10"});
            table.rows.back().insert(table.rows.back().end(), row.begin(), row.end());
        }
        return table.text();
    }
};

Recording read_log(const std::vector<std::string>& columns, const std::vector<std::vector<std::string>>& rows) {
    return read(Log{columns, rows}.text());
}

TEST(Display, TimesBetweenChangesAreReadInEverySpelling) {
    for (const char* name : {"MsBetweenDisplayChange", "msBetweenDisplayChange"}) {
        const Recording recording =
            read_log({"Dropped", name, "DisplayedTime"}, {{"0", "16.5", "7"}, {"0", "17", "7"}});
        EXPECT_EQ(recording.frames[0].display_ms, 16.5f) << name;
        EXPECT_EQ(recording.frames[1].display_ms, 17) << name << ": not how long it was shown, where both are told";
    }
    for (const char* name : {"DisplayedTime", "displayedtime"})
        EXPECT_EQ(read_log({name}, {{"16.5"}}).frames[0].display_ms, 16.5f) << name;
}

TEST(Display, WhatWasNeverShownHasNoDisplayTime) {
    const Recording recording = read_log({"Dropped", "MsBetweenDisplayChange"},
                                         {{"0", "16.5"}, {"1", "0"}, {"1", "9"}, {"0", "0"}, {"0", "x"}});
    for (std::size_t i = 1; i < 5; ++i) EXPECT_TRUE(std::isnan(recording.frames[i].display_ms)) << i;
    EXPECT_TRUE(
        has_note(recording, "1 display time, animation error or count that can't be read or be so (in line 6)"));
}

TEST(Display, FatesAreTold) {
    const Recording dropped = read_log({"Dropped"}, {{"0"}, {"1"}, {"false"}, {"True"}, {"Error"}, {""}, {"NA"}});
    const Fate fates[] = {Fate::shown,  Fate::dropped, Fate::shown, Fate::dropped,
                          Fate::untold, Fate::untold,  Fate::untold};
    for (std::size_t i = 0; i < std::size(fates); ++i) EXPECT_EQ(dropped.frames[i].fate, fates[i]) << i;
    const Recording displayed = read_log({"MsUntilDisplayed"}, {{"5"}, {"0"}, {"NA"}, {""}});
    EXPECT_EQ(displayed.frames[0].fate, Fate::shown);
    EXPECT_EQ(displayed.frames[1].fate, Fate::dropped);
    EXPECT_EQ(displayed.frames[2].fate, Fate::dropped);
    EXPECT_EQ(displayed.frames[3].fate, Fate::untold);
    for (const FrameRecord& frame : read_log({"MsUntilDisplayed"}, {{"NA"}, {"NA"}}).frames)
        EXPECT_EQ(frame.fate, Fate::untold) << "nothing was tracked";
    for (const FrameRecord& frame : read(mangohud().text()).frames) EXPECT_EQ(frame.fate, Fate::untold);
}

TEST(Display, AnimationErrorsAreReadInEverySpelling) {
    for (const char* name : {"MsAnimationError", "AnimationError", "msanimationerror"}) {
        const Recording recording =
            read_log({"Dropped", name}, {{"0", "-0.25"}, {"0", "NA"}, {"1", "3"}, {"0", "700000"}});
        EXPECT_EQ(recording.frames[0].animation_error_ms, -0.25f) << name;
        for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(std::isnan(recording.frames[i].animation_error_ms)) << i;
        EXPECT_TRUE(has_note(recording, "1 display time, animation error or count")) << "12 minutes are none";
        EXPECT_FALSE(has_note(recording, "computed"));
    }
}

TEST(Display, CompilationsAreReadInEverySpelling) {
    for (const char* name : {"PsoCompileCount", "psocompilecount"}) {
        const Recording recording = read_log({"PsoCompileTime", name, "PsoCompileTimeMax"},
                                             {{"9", "3", "9"}, {"9", "NA", "9"}, {"9", "-1", "9"}});
        EXPECT_EQ(recording.frames[0].compilations, 3) << name;
        EXPECT_TRUE(std::isnan(recording.frames[1].compilations));
        EXPECT_TRUE(std::isnan(recording.frames[2].compilations));
    }
    EXPECT_TRUE(std::isnan(read(presentmon_2().text()).frames[0].compilations));
}

TEST(Display, RowsMayEndBeforeWhatIsToldOnlyOfSome) {
    const std::vector<std::string> columns = {"Dropped", "X", "MsAnimationError", "PsoCompileCount"};
    const Recording recording = read_log(columns, {{"0", "", "0.5", "2"}, {"0"}, {"0", "", "0.25"}});
    ASSERT_EQ(recording.frames.size(), 3u);
    EXPECT_EQ(recording.frames[0].compilations, 2);
    EXPECT_TRUE(std::isnan(recording.frames[1].animation_error_ms)) << "nor is it the row's before";
    EXPECT_EQ(recording.frames[2].animation_error_ms, 0.25f);
    EXPECT_EQ(read_log({"Dropped", "PsoCompileCount", "PsoCompileCount"}, {{"0", "1", "2"}}).frames[0].compilations, 1)
        << "nor is a column twice refused";
    std::string cut = Log{columns, {{"0", "", "0.5", "2"}, {"0", "", "0.25"}}}.text();
    cut.pop_back();
    EXPECT_EQ(read(cut).frames.size(), 2u);
    EXPECT_TRUE(std::isnan(read(cut).frames[1].animation_error_ms)) << "the file ends within it";
}

// A run with frames dropped and generated, and what can be told of it.
struct Truth {
    struct Frame {
        bool is_shown = true, is_generated = false;
        double start_ms = 0, change_ms = 0, shown_for_ms = 0, present_ms = 0, in_present_ms = 0;
    };
    std::vector<Frame> frames;

    explicit Truth(std::uint64_t seed, bool has_generated) {
        std::mt19937_64 random(seed);
        const auto chance = [&] { return static_cast<double>(random() % 10000) / 10000; };
        double present_end = 0, displayed = 0, last_displayed = 0;
        std::size_t last_shown = 0;
        for (std::size_t i = 0; i < 400; ++i) {
            Frame frame;
            frame.is_generated = has_generated && i % 2 == 1;
            frame.is_shown = frame.is_generated || chance() > 0.2;
            frame.start_ms = present_end;
            frame.present_ms = present_end + 4 + 8 * chance();
            frame.in_present_ms = chance();
            if (!frame.is_generated) present_end = frame.present_ms + frame.in_present_ms;
            displayed = std::max(displayed, frame.present_ms) + 1 + chance();
            if (frame.is_shown) {
                frame.change_ms = displayed - last_displayed;
                if (!frames.empty()) frames[last_shown].shown_for_ms = frame.change_ms;
                last_displayed = displayed;
                last_shown = i;
            }
            frames.push_back(frame);
        }
        frames[last_shown].shown_for_ms = 5;
    }

    // Of the application's frames, by looking for the frame shown before.
    std::vector<double> errors() const {
        std::vector<double> errors;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (frames[i].is_generated) continue;
            errors.push_back(std::nan(""));
            double between = frames[i].change_ms;
            for (std::size_t k = i; k-- > 0 && frames[i].is_shown;) {
                if (frames[k].is_generated) {
                    between += frames[k].change_ms;
                } else if (frames[k].is_shown) {
                    errors.back() = frames[i].start_ms - frames[k].start_ms - between;
                    break;
                }
            }
        }
        return errors;
    }
};

// The columns that tell the simulation's start, and a row's fields of them.
struct Source {
    std::vector<std::string> names;
    std::function<std::vector<std::string>(const Truth& truth, std::size_t i)> fields;
    const char* told;
};

const std::vector<Source>& sources() {
    static const std::vector<Source> all = {
        {{"AnimationTime"},
         [](const Truth& truth, std::size_t i) { return std::vector{number_text(1000 + truth.frames[i].start_ms)}; },
         "AnimationTime"},
        {{"MsBetweenSimulationStart"},
         [](const Truth& truth, std::size_t i) {
             std::size_t before = i;
             while (before > 0 && truth.frames[--before].is_generated) continue;
             const bool has_step = i > 0 && !truth.frames[i].is_generated;
             return std::vector{has_step ? number_text(truth.frames[i].start_ms - truth.frames[before].start_ms)
                                         : "NA"};
         },
         "MsBetweenSimulationStart"},
        {{"CPUStartTime"},
         [](const Truth& truth, std::size_t i) { return std::vector{number_text(truth.frames[i].start_ms)}; },
         "CPUStartTime"},
        {{"TimeInSeconds", "msInPresentAPI"},
         [](const Truth& truth, std::size_t i) {
             return std::vector{number_text(truth.frames[i].present_ms / 1000),
                                number_text(truth.frames[i].in_present_ms)};
         },
         "TimeInSeconds + msInPresentAPI"}};
    return all;
}

std::string log_of(const Truth& truth, const std::vector<const Source*>& told, bool is_shown_for) {
    Log log;
    log.columns = {"FrameType", is_shown_for ? "DisplayedTime" : "MsBetweenDisplayChange"};
    if (!is_shown_for) log.columns.insert(log.columns.begin(), "Dropped");
    for (const Source* source : told) log.columns.insert(log.columns.end(), source->names.begin(), source->names.end());
    for (std::size_t i = 0; i < truth.frames.size(); ++i) {
        const Truth::Frame& frame = truth.frames[i];
        const double display = is_shown_for ? frame.shown_for_ms : frame.change_ms;
        std::vector<std::string> row = {frame.is_generated ? "AMD_AFMF" : "Application",
                                        frame.is_shown ? number_text(display) : "NA"};
        if (!is_shown_for) row.insert(row.begin(), frame.is_shown ? "0" : "1");
        for (const Source* source : told) {
            const std::vector<std::string> fields = source->fields(truth, i);
            row.insert(row.end(), fields.begin(), fields.end());
        }
        log.rows.push_back(row);
    }
    return log.text();
}

void expect_errors(const Recording& recording, const std::vector<double>& expected, std::size_t unknown_at_first) {
    constexpr double rounding = 1e-5;  // of single precision, beside times of a second
    ASSERT_EQ(recording.frames.size(), expected.size());
    std::size_t shown = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const float computed = recording.frames[i].animation_error_ms;
        shown += !std::isnan(expected[i]);
        if (std::isnan(expected[i]) || (std::isnan(computed) && shown <= unknown_at_first)) {
            EXPECT_TRUE(std::isnan(computed)) << "frame " << i;
        } else {
            EXPECT_NEAR(computed, expected[i], rounding) << "frame " << i;
        }
    }
}

TEST(Display, AnimationErrorsAreComputedFromWhatIsTold) {
    for (const bool has_generated : {false, true}) {
        const Truth truth(3, has_generated);
        for (const Source& source : sources()) {
            for (const bool is_shown_for : {false, true}) {
                SCOPED_TRACE(std::string(source.told) + (is_shown_for ? ", shown for" : ""));
                const Recording recording = read(log_of(truth, {&source}, is_shown_for));
                expect_errors(recording, truth.errors(), 1);  // no Present() ended before the first
                EXPECT_TRUE(has_note(
                    recording, "animation error is not recorded: computed from " + std::string(source.told) + " and "));
            }
        }
    }
}

TEST(Display, TheFirstSimulationStartIsTakenThatTellsAny) {
    const Truth truth(4, false);
    Source other = sources()[3];  // times that are nobody's
    other.fields = [](const Truth&, std::size_t i) {
        return std::vector{number_text(static_cast<double>(i * i) / 1e5), std::string("2")};
    };
    const Recording both = read(log_of(truth, {&other, &sources()[2]}, false));
    EXPECT_TRUE(has_note(both, "computed from CPUStartTime and"));
    expect_errors(both, truth.errors(), 0);
    Source untold = sources()[0];
    untold.fields = [](const Truth&, std::size_t) { return std::vector{std::string("NA")}; };
    const Recording next = read(log_of(truth, {&untold, &sources()[2]}, false));
    EXPECT_TRUE(has_note(next, "computed from CPUStartTime and"));
    expect_errors(next, truth.errors(), 0);
}

TEST(Display, AClockInAnotherUnitIsNotTaken) {
    const Truth truth(5, false);
    Source seconds = sources()[2];
    seconds.fields = [](const Truth& of, std::size_t i) {
        return std::vector{number_text(of.frames[i].start_ms / 1000)};
    };
    const Recording recording = read(log_of(truth, {&seconds}, false));
    for (const FrameRecord& frame : recording.frames) EXPECT_TRUE(std::isnan(frame.animation_error_ms));
    EXPECT_FALSE(has_note(recording, "computed"));
}

TEST(Display, RecordingsPutTogetherAreNotComparedWithOneAnother) {
    const Truth truth(6, false);
    for (const Source& source : sources()) {
        const std::string once = log_of(truth, {&source}, false);
        const std::vector<FrameRecord> one = read(once).frames, two = read(once + once).frames;
        ASSERT_EQ(two.size(), 2 * one.size());
        for (std::size_t i = 0; i < one.size(); ++i) {
            const float a = one[i].animation_error_ms, b = two[one.size() + i].animation_error_ms;
            EXPECT_TRUE(std::abs(a - b) < 1e-5f || (std::isnan(a) && std::isnan(b))) << source.told << ", frame " << i;
        }
    }
}

TEST(Display, WhatGeneratedFramesWereShownIsTheNextOnes) {
    const Truth truth(7, true);
    const std::vector<FrameRecord> frames = read(log_of(truth, {&sources()[2]}, false)).frames;
    double waiting = 0;
    std::size_t next = 0;
    for (const Truth::Frame& frame : truth.frames) {
        if (frame.is_shown) waiting += frame.change_ms;
        if (frame.is_generated) continue;
        const float told = frames.at(next++).display_ms;
        if (!frame.is_shown) {
            EXPECT_TRUE(std::isnan(told));
            continue;
        }
        EXPECT_NEAR(told, waiting, 1e-4);
        waiting = 0;
    }
}

// The same run, in CapFrameX's arrays.
std::string capframex(const Truth& truth, const std::string& more = "") {
    std::string text = "{\"Runs\":[{\"CaptureData\":{";
    const auto array = [&](const char* name, const std::function<double(const Truth::Frame&)>& value) {
        text += std::string("\"") + name + "\":[";
        for (const Truth::Frame& frame : truth.frames)
            text += (&frame == truth.frames.data() ? "" : ",") + number_text(value(frame));
        text += "],";
    };
    array("MsBetweenDisplayChange", [](const Truth::Frame& frame) { return frame.change_ms; });
    array("TimeInSeconds", [](const Truth::Frame& frame) { return frame.present_ms / 1000; });
    array("MsInPresentAPI", [](const Truth::Frame& frame) { return frame.in_present_ms; });
    array("Dropped", [](const Truth::Frame& frame) { return frame.is_shown ? 0 : 1; });
    text += more;
    array("MsBetweenPresents", [](const Truth::Frame&) { return 10; });
    text.pop_back();
    return text + "}}]}";
}

TEST(Display, CapFrameXJsonTellsTheSame) {
    const Truth truth(8, false);
    const Recording recording = read(capframex(truth));
    expect_errors(recording, truth.errors(), 1);
    EXPECT_TRUE(has_note(recording, "computed from TimeInSeconds + MsInPresentAPI and MsBetweenDisplayChange"));
    for (std::size_t i = 0; i < truth.frames.size(); ++i) {
        EXPECT_EQ(recording.frames[i].fate, truth.frames[i].is_shown ? Fate::shown : Fate::dropped);
        const double shown_ms = truth.frames[i].is_shown ? truth.frames[i].change_ms : -1;
        const float told_ms = recording.frames[i].display_ms;
        EXPECT_NEAR(std::isnan(told_ms) ? -1 : told_ms, shown_ms, 1e-4);
    }
    for (const char* name : {"AnimationError", "MsAnimationError"}) {
        std::string errors = "\"" + std::string(name) + "\":[";
        for (std::size_t i = 0; i < truth.frames.size(); ++i) errors += i == 0 ? "0.5" : ",0.5";
        const Recording told = read(capframex(truth, errors + "],"));
        for (const FrameRecord& frame : told.frames)
            EXPECT_EQ(frame.animation_error_ms == 0.5f, frame.fate == Fate::shown) << name;
        EXPECT_FALSE(has_note(told, "computed"));
    }
    const Recording shorter = read(capframex(truth, "\"AnimationError\":[1,2],"));
    EXPECT_TRUE(has_note(shorter, "MsAnimationError has 2 entries, not 400: left out"));
    expect_errors(shorter, truth.errors(), 1);
}

// One capture as PresentMon 1.x wrote it, which has no animation error, and as the current one did.
TEST(Display, ComputedErrorsAreThoseThatPresentMonTells) {
    const std::filesystem::path traces = std::filesystem::path(GRANDSTAND_SHARED) / "traces";
    const auto errors_of = [&](const char* path) {
        std::ifstream file(traces / path, std::ios::binary);
        std::vector<float> errors;
        for (const FrameRecord& frame : read_recording(file, path, {"PresentBench"}).frames)
            if (!std::isnan(frame.animation_error_ms)) errors.push_back(frame.animation_error_ms);
        return errors;
    };
    const char* const old_file = "presentmon-v1/gold_case_5_v1.csv";
    if (!std::filesystem::exists(traces / old_file)) GTEST_SKIP() << "no " << old_file << ": it is not at hand";
    const std::vector<float> told = errors_of("presentmon-v2/gold_case_5_current.csv"), computed = errors_of(old_file);
    ASSERT_EQ(told.size(), 177u);
    ASSERT_GE(computed.size(), told.size());
    constexpr float rounding_ms = 2e-3f;  // of times with four decimals
    std::size_t equal = 0;
    for (const float error : told) {
        equal += std::any_of(computed.begin(), computed.end(),
                             [&](float other) { return std::abs(other - error) < rounding_ms; });
    }
    EXPECT_GE(equal, told.size() - 1) << "before the first, 1.x knows no Present()";
}

}  // namespace
}  // namespace sfsm
