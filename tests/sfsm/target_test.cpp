#include "sfsm/target.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace sfsm {
namespace {

TEST(TargetSchedule, OneTimeHoldsForEveryFrame) {
    const TargetSchedule schedule = TargetSchedule::parse("16.6");
    for (const std::int64_t frame : {-1, 0, 1, 1'000'000}) EXPECT_EQ(schedule.at(frame), 16.6);
}

TEST(TargetSchedule, ThePapersExperimentStepsAtItsFrames) {
    const TargetSchedule schedule = TargetSchedule::parse("1000,300@30,95@100");
    EXPECT_EQ(schedule.at(0), 1000);
    EXPECT_EQ(schedule.at(29), 1000);
    EXPECT_EQ(schedule.at(30), 300);
    EXPECT_EQ(schedule.at(99), 300);
    EXPECT_EQ(schedule.at(100), 95);
    EXPECT_EQ(schedule.at(1'000'000'000'000), 95);
}

TEST(TargetSchedule, TextParsesBackToTheSameSchedule) {
    for (const char* text : {"16.6", "1000,300@30,95@100", "0.1,1e-05@1,1000000@9000000000"}) {
        const std::string once = TargetSchedule::parse(text).text();
        EXPECT_EQ(TargetSchedule::parse(once).text(), once);
        EXPECT_EQ(TargetSchedule::parse(once).at(1), TargetSchedule::parse(text).at(1));
    }
    EXPECT_EQ(TargetSchedule::parse("1000,300@30,95@100").text(), "1000,300@30,95@100");
}

struct Bad {
    const char* text;
    const char* found;     // what the message quotes
    const char* expected;  // and a part of what it asks for
};

TEST(TargetSchedule, OfFramesHasEachFramesOwnTarget) {
    const std::vector<double> ms{1000, 1000, 300, 300, 95, 300};
    const TargetSchedule schedule = TargetSchedule::of_frames(ms);
    for (std::size_t i = 0; i < ms.size(); ++i) EXPECT_EQ(schedule.at(static_cast<std::int64_t>(i)), ms[i]) << i;
    EXPECT_EQ(schedule.at(1000), 300);
    EXPECT_EQ(schedule.at(-1), 1000);
    EXPECT_EQ(schedule.text(), "1000,300@2,95@4,300@5");
}

TEST(TargetSchedule, OfFramesRefusesWhatIsNoTargetAndNamesTheFrame) {
    EXPECT_THROW(TargetSchedule::of_frames({}), std::invalid_argument);
    for (const double bad :
         {0.0, -1.0, 1e7, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        const std::vector<double> ms{10, 10, bad};
        try {
            TargetSchedule::of_frames(ms);
            FAIL() << "took " << bad;
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find("frame 2"), std::string::npos) << error.what();
        }
    }
}

TEST(TargetSchedule, BadTextIsAnsweredWithWhatWasFoundAndExpected) {
    const Bad bads[] = {
        {"", "''", "a time in ms"},
        {"abc", "'abc'", "a time in ms"},
        {"nan", "'nan'", "a time in ms"},
        {"inf", "'inf'", "a time in ms"},
        {"0", "'0'", "a time in ms"},
        {"-5", "'-5'", "a time in ms"},
        {"1000001", "'1000001'", "1e6"},
        {"16.6ms", "'16.6ms'", "a time"},
        {" 16", "' 16'", "a time in ms"},
        {"16,", "''", "MS@FRAME"},
        {",16", "''", "a time in ms"},
        {"16,8", "'8'", "MS@FRAME"},
        {"16@3", "'16@3'", "without a frame"},
        {"16,8@", "''", "a frame over 0"},
        {"16,8@0", "'0'", "a frame over 0"},
        {"16,8@-1", "'-1'", "a frame"},
        {"16,8@1.5", "'1.5'", "a frame"},
        {"16,8@9,7@9", "'9'", "after the one before"},
        {"16,8@9,7@8", "'8'", "after the one before"},
        {"16,8@9@9", "'9@9'", "a frame"},
        {"16,@9", "''", "a time in ms"},
        {"16,8@99999999999999999999", "'99999999999999999999'", "a frame"},
    };
    for (const Bad& bad : bads) {
        try {
            TargetSchedule::parse(bad.text);
            ADD_FAILURE() << "accepted: " << bad.text;
        } catch (const std::invalid_argument& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("found " + std::string(bad.found)), std::string::npos)
                << bad.text << ": " << message;
            EXPECT_NE(message.find(bad.expected, message.find("expected")), std::string::npos)
                << bad.text << ": " << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

}  // namespace
}  // namespace sfsm
