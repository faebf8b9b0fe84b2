#include "sfsm/target.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

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
