#include "sfsm/trace.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>

#include "sfsm/trace_columns.h"
#include "tests/sfsm/simulation.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

constexpr const char* header =
    "frame,target_ms,frame_ms,cpu_ms,gpu_ms,state,motion_distance_m,splat_px,visible,triangles,points,motion_updates,"
    "range_m\n";
constexpr const char* good_row = "0,16.6,20,3,nan,2,100,1.5,10,0,300,4,200\n";

Trace read(const std::string& text) {
    std::istringstream in(text);
    return read_trace(in, "t.csv");
}

std::string write(const Trace& trace) {
    std::ostringstream out;
    write_trace_header(out, trace.settings);
    for (const TraceRow& row : trace.rows) write_trace_row(out, row);
    return out.str();
}

// Any bits but those of the many NaNs, which are all written alike.
double any_double(std::mt19937_64& random) {
    const double value = std::bit_cast<double>(random());
    return std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value;
}

// Up to 2^53, which a double still tells apart.
std::int64_t any_step_count(std::mt19937_64& random) {
    return static_cast<std::int64_t>(random() >> (11 + random() % 53));
}

TraceRow any_row(std::mt19937_64& random, std::int64_t frame) {
    TraceRow row;
    row.frame = frame;
    for (double* value : {&row.target_ms, &row.frame_ms, &row.cpu_ms, &row.gpu_ms, &row.range, &row.predicted_ms})
        *value = any_double(random);
    row.decision.state = static_cast<State>(random() % 3);
    row.decision.motion_distance = uniform(random, 1e-3, 1e3);
    row.decision.splat_size = uniform(random, 0, max_splat_size);
    if (random() % 4 == 0) row.decision = {};
    if (random() % 2 == 0) row.decision.rate = uniform(random, 0, 1e-3);
    row.hidden = static_cast<std::int64_t>(random() >> (1 + random() % 63));
    if (random() % 2 == 0) row.drawn_state = static_cast<State>(random() % 3);
    for (std::int64_t& count : row.work.counts) count = static_cast<std::int64_t>(random() >> (1 + random() % 63));
    for (std::uint64_t steps = random() % 3; steps > 0; --steps) {
        row.motion.push_back({uniform(random, 0, 1e3), Work{0, 0, 0, any_step_count(random)}, uniform(random, 0, 9)});
        row.shapes.push_back(
            {uniform(random, 0, 32), Work{0, any_step_count(random), any_step_count(random)}, uniform(random, 0, 9)});
        row.rates.push_back({uniform(random, 0, 1e-3), static_cast<State>(random() % 3),
                             random() % 4 == 0 ? INFINITY : uniform(random, 0, 1e3), uniform(random, 0, 32),
                             Work{0, any_step_count(random), any_step_count(random), any_step_count(random), 0, 0,
                                  any_step_count(random)},
                             uniform(random, 0, 1)});
    }
    return row;
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(Trace, EveryRowReadsBackToTheSameBits) {
    std::mt19937_64 random(5);
    Trace trace;
    for (int i = 0; i < 5000; ++i) trace.rows.push_back(any_row(random, 3 * i));
    const Trace back = read(write(trace));
    ASSERT_EQ(back.rows.size(), trace.rows.size());
    for (std::size_t i = 0; i < trace.rows.size(); ++i) {
        const TraceRow &a = trace.rows[i], &b = back.rows[i];
        EXPECT_EQ(a.frame, b.frame);
        EXPECT_EQ(a.decision, b.decision);
        EXPECT_EQ(a.work, b.work);
        EXPECT_EQ(a.hidden, b.hidden);
        EXPECT_EQ(a.motion, b.motion);
        EXPECT_EQ(a.shapes, b.shapes);
        EXPECT_EQ(a.rates, b.rates);
        EXPECT_EQ(a.drawn_state, b.drawn_state);
        EXPECT_TRUE(same_bits(a.target_ms, b.target_ms) && same_bits(a.frame_ms, b.frame_ms) &&
                    same_bits(a.cpu_ms, b.cpu_ms) && same_bits(a.gpu_ms, b.gpu_ms) && same_bits(a.range, b.range) &&
                    same_bits(a.predicted_ms, b.predicted_ms))
            << "row " << i;
    }
}

TEST(Trace, SettingsReadBackAndStayOnTheirLine) {
    Trace trace;
    trace.settings = {{"law", "paper"}, {"device", "llvmpipe (LLVM 15.0.6, 256 bits) = a \"device\""}, {"empty", ""}};
    EXPECT_EQ(read(write(trace)).settings, trace.settings);
    trace.settings = {{"device", "two\nlines\r"}};
    EXPECT_EQ(read(write(trace)).settings.at("device"), "two lines ");
}

struct Grouping : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(Trace, TheLocaleOfAStreamChangesNothing) {
    std::mt19937_64 random(6);
    Trace trace;
    trace.rows.push_back(any_row(random, 1234567));
    std::ostringstream out;
    out.imbue(std::locale(out.getloc(), new Grouping));
    write_trace_header(out, trace.settings);
    write_trace_row(out, trace.rows[0]);
    EXPECT_EQ(out.str(), write(trace));
}

TEST(Trace, TheHeaderBeginsWithTheContract) {
    const std::string text = write({});
    const std::string contract(header, std::strlen(header) - 1);
    EXPECT_TRUE(text.starts_with(contract + ",")) << text;
    EXPECT_EQ(text, contract + all_column_names().substr(contract.size()) + "\n");
}

TEST(Trace, EmptyTimesAreNotMeasuredAndInfiniteDistanceIsInf) {
    const Trace trace = read(std::string(header) + "7,16.6,,,,0,inf,0,1,2,3,4,200\n");
    ASSERT_EQ(trace.rows.size(), 1u);
    EXPECT_TRUE(std::isnan(trace.rows[0].frame_ms) && std::isnan(trace.rows[0].cpu_ms) &&
                std::isnan(trace.rows[0].gpu_ms));
    EXPECT_EQ(trace.rows[0].decision, Decision{});
    EXPECT_NE(write(trace).find("\n7,16.6,nan,nan,nan,0,inf,0,1,2,3,4,200,"), std::string::npos);
}

TEST(Trace, DamagedForecastIsNamedByItsLine) {
    const std::string wide = std::string(header, std::strlen(header) - 1) + ",motion_steps,splat_steps\n";
    const std::string row = std::string(good_row, std::strlen(good_row) - 1);
    EXPECT_TRUE(read(wide + row + ",inf:5:0 3:2:1.5,0:900:0:0\n").rows.at(0).has_forecast());
    for (const char* steps :
         {",1:2,0:1:1:0", ",1:x:3,0:1:1:0", ",1:2:3  4:5:6,0:1:1:0", ",1:2:3,0:1:1", ",1:-2:3,0:1:1:0"}) {
        try {
            read(wide + row + steps + "\n");
            ADD_FAILURE() << steps;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(":2: "), std::string::npos) << error.what();
        }
    }
}

// Its setting, a count for each kind of the axis, its loss, and one number more: from a version that has more kinds.
template <WorkAxis axis>
std::string step_of_a_later_version() {
    std::string step = "1";
    for (std::size_t i = 0; i < work_on<axis>.size() + 2; ++i) step += ":2";
    return step;
}

TEST(Trace, AStepOfMoreKindsThanThereAreIsRefused) {
    const std::string wide = std::string(header, std::strlen(header) - 1) + ",motion_steps,splat_steps\n";
    const std::string row = std::string(good_row, std::strlen(good_row) - 1);
    const std::string motion = step_of_a_later_version<WorkAxis::motion>();
    const std::string shape = step_of_a_later_version<WorkAxis::shape>();
    for (const auto& [steps, said] :
         {std::pair{"," + motion + ",0:1:1:0", "motion_steps has '" + motion + "', expected"},
          std::pair{",1:2:3," + shape, "splat_steps has '" + shape + "', expected"}}) {
        try {
            read(wide + row + steps + "\n");
            ADD_FAILURE() << steps;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("t.csv:2: " + said), std::string::npos) << error.what();
        }
    }
}

TEST(Trace, CountsOfStepsThatNoDoubleTellsApartAreTheLargestThatOneDoes) {
    constexpr std::int64_t largest = std::int64_t{1} << 53;
    const std::string wide = std::string(header, std::strlen(header) - 1) + ",motion_steps,splat_steps\n";
    const std::string row = std::string(good_row, std::strlen(good_row) - 1);
    for (const auto& [text, count] :
         {std::pair{"9007199254740991", largest - 1}, std::pair{"9007199254740992", largest},
          std::pair{"1e300", largest}, std::pair{"inf", largest}}) {
        const std::string n = text;
        const TraceRow read_row = read(wide + row + ",inf:" + n + ":0,0:" + n + ":" + n + ":0\n").rows.at(0);
        EXPECT_EQ(read_row.motion[0].work[WorkKind::motion_update], count) << text;
        EXPECT_EQ(read_row.shapes[0].work[WorkKind::triangle], count) << text;
        EXPECT_EQ(read_row.shapes[0].work[WorkKind::point], count) << text;
    }
}

TEST(Trace, EveryFieldOfAStepHasItsPlace) {
    const std::string wide = std::string(header, std::strlen(header) - 1) + ",splat_steps,predicted_ms,motion_steps\n";
    const std::string row = std::string(good_row, std::strlen(good_row) - 1);
    const TraceRow read_row = read(wide + row + ",0:900:1:2.5 4:800:7:8,12.5,inf:5:0.25 3:2:1.5\n").rows.at(0);
    EXPECT_EQ(read_row.motion, (std::vector<Step>{motion_step(INFINITY, 5, 0.25), motion_step(3, 2, 1.5)}));
    EXPECT_EQ(read_row.shapes, (std::vector<Step>{shape_step(0, 900, 1, 2.5), shape_step(4, 800, 7, 8)}));
    EXPECT_EQ(read_row.predicted_ms, 12.5);
}

TEST(Trace, RatesAndTheirStepsHaveTheirPlaces) {
    const std::string wide = std::string(header, std::strlen(header) - 1) + ",rate_steps,rate\n";
    const std::string row = std::string(good_row, std::strlen(good_row) - 1);
    const TraceRow read_row =
        read(wide + row + ",1e-6:0:inf:0:900:0:7:5:0 2e-6:2:80:1.5:4:300:6:3:0.25,1.5e-6\n").rows.at(0);
    ASSERT_EQ(read_row.rates.size(), 2u);
    EXPECT_EQ(read_row.rates[0], (RateStep{1e-6, State::original, INFINITY, 0, Work{0, 900, 0, 5, 0, 0, 7}, 0}));
    EXPECT_EQ(read_row.rates[1], (RateStep{2e-6, State::points, 80, 1.5, Work{0, 4, 300, 3, 0, 0, 6}, 0.25}));
    EXPECT_EQ(read_row.decision, (Decision{State::points, 100, 1.5, 1.5e-6}));
    EXPECT_EQ(read_row.forecast().rates.data(), read_row.rates.data());
    const TraceRow older = read(std::string(header) + good_row).rows.at(0);
    EXPECT_EQ(older.decision.rate, 0);
    EXPECT_TRUE(older.rates.empty());
}

TEST(Trace, DamagedRatesAreNamedByTheirLine) {
    const std::string wide = std::string(header, std::strlen(header) - 1) + ",rate,rate_steps\n";
    const std::string row = std::string(good_row, std::strlen(good_row) - 1);
    const std::string steps = "1e-6:0:inf:0:900:0:7:5:0";
    EXPECT_EQ(read(wide + row + ",0.5," + steps + "\n").rows.at(0).rates.size(), 1u);
    for (const char* rate : {"", "x", "-1", "nan", "inf"}) {
        try {
            read(wide + row + "," + rate + "," + steps + "\n");
            ADD_FAILURE() << rate;
        } catch (const std::runtime_error& error) {
            const std::string said = "t.csv:2: rate is '" + std::string(rate) + "', expected ";
            EXPECT_TRUE(std::string(error.what()).starts_with(said)) << error.what();
        }
    }
    for (const char* bad : {"1e-6:0:inf:0:900:0:7:5", "1e-6:0:inf:0:900:0:7:5:0:1", "1e-6:3:inf:0:900:0:7:5:0",
                            "1e-6:00:inf:0:900:0:7:5:0", "-1e-6:0:inf:0:900:0:7:5:0", "1e-6:0:nan:0:900:0:7:5:0",
                            "1e-6:0:inf:0:-9:0:7:5:0", "1e-6:0:inf:0:900:0:7:5:x", " "}) {
        try {
            read(wide + row + ",0," + steps + " " + bad + "\n");
            ADD_FAILURE() << bad;
        } catch (const std::runtime_error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("t.csv:2: rate_steps has ")) << error.what();
            EXPECT_NE(std::string(error.what()).find("expected 9 numbers from 0"), std::string::npos) << error.what();
        }
    }
}

// Numbers of four digits, as renderers that care for their traces give: 17 take twice as much.
double of_four_digits(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", number);
    return std::strtod(text, nullptr);
}

TEST(Trace, ARowOfAMillionPeopleIsAFewKilobytes) {
    std::mt19937_64 random(7);
    const auto number = [&](double low, double high) { return of_four_digits(uniform(random, low, high)); };
    const auto count = [&](double low, double high) { return std::llround(uniform(random, low, high)); };
    TraceRow row;
    row.decision = {State::points, 181.125, 1.25, 1.5e-9};
    for (std::int64_t& each : row.work.counts) each = count(1e8, 1e9);
    for (int i = 0; i < 7; ++i) row.motion.push_back(motion_step(number(100, 1000), count(1e5, 1e6), number(0.01, 1)));
    for (int i = 0; i < 28; ++i) {
        row.shapes.push_back(shape_step(number(1, 32), count(1e8, 1e9), count(1e7, 1e8), number(0.1, 1)));
        row.shapes.back().work[WorkKind::single] = count(1e5, 1e6);
    }
    for (int i = 0; i < 34; ++i) {
        RateStep step =
            rate_step(of_four_digits(1e-9 * std::exp2(i / 2.0)), count(1e7, 1e8), count(1e5, 1e6), number(0.01, 0.1));
        step.motion_distance = number(100, 1000);
        step.splat_size = number(1, 32);
        step.work[WorkKind::triangle] = count(1e8, 1e9);
        step.work[WorkKind::single] = count(1e5, 1e6);
        row.rates.push_back(step);
    }
    std::ostringstream out;
    write_trace_row(out, row);
    EXPECT_LE(out.str().size(), 4096u);
}

TEST(Trace, DecisionsAtTheirLimitsAreRead) {
    const std::string before = std::string(header) + "0,16.6,20,3,nan,2,", after = ",10,0,300,4,200\n";
    EXPECT_EQ(read(before + "inf,32" + after).rows.at(0).decision.splat_size, 32);
    EXPECT_EQ(read(before + "5e-324,0" + after).rows.at(0).decision.motion_distance, 5e-324);
    for (const char* bad : {"100,32.001", "100,-0.001", "100,nan", "-1,1.5", "0,1.5"}) {
        EXPECT_THROW(read(before + bad + after), std::runtime_error) << bad;
    }
}

TEST(Trace, ColumnsAreFoundByNameAndUnknownOnesSkipped) {
    const Trace trace = read(
        "# law=paper\r\n"
        "range_m,extra,points,frame,target_ms,frame_ms,cpu_ms,gpu_ms,state,motion_distance_m,splat_px,visible,"
        "triangles,"
        "motion_updates\r\n"
        "200,hello,300,5,16.6,20,3,4,2,100,1.5,10,0,4\r\n");
    ASSERT_EQ(trace.rows.size(), 1u);
    EXPECT_EQ(trace.settings.at("law"), "paper");
    EXPECT_EQ(trace.rows[0].frame, 5);
    EXPECT_EQ(trace.rows[0].range, 200);
    EXPECT_EQ(trace.rows[0].work, (Work{10, 0, 300, 4}));
    EXPECT_EQ(trace.rows[0].decision, (Decision{State::points, 100, 1.5}));
}

struct Bad {
    std::string text;
    const char* where;
    const char* said;
};

TEST(Trace, BadTextIsNamedByFileAndLine) {
    const std::string h = header, ok = good_row;
    const Bad bads[] = {
        {"", "t.csv:", "no header"},
        {"# law=paper\n", "t.csv:", "no header"},
        {"hello\n", "t.csv:1:", "0 columns 'frame'"},
        {"\n" + h, "t.csv:1:", "0 columns 'frame'"},
        {"frame," + h, "t.csv:1:", "2 columns 'frame'"},
        {h + "1,2,3\n", "t.csv:2:", "3 fields, expected 13"},
        {h + ok + "\n", "t.csv:3:", "1 fields"},
        {h + ok + "# law=paper\n", "t.csv:3:", "1 fields"},
        {h + ok + "1,16.6,20,3,nan,2,100,1.5,10,0,30\n", "t.csv:3:", "11 fields"},
        {h + ok + ok, "t.csv:3:", "found frame 0, expected one after 0"},
        {h + "-1,16.6,20,3,nan,2,100,1.5,10,0,300,4,200\n", "t.csv:2:", "frame is '-1'"},
        {h + "0.5,16.6,20,3,nan,2,100,1.5,10,0,300,4,200\n", "t.csv:2:", "frame is '0.5'"},
        {h + "0,,20,3,nan,2,100,1.5,10,0,300,4,200\n", "t.csv:2:", "target_ms is ''"},
        {h + "0,16.6,2x,3,nan,2,100,1.5,10,0,300,4,200\n", "t.csv:2:", "frame_ms is '2x'"},
        {h + "0,16.6,20,3,nan,3,100,1.5,10,0,300,4,200\n", "t.csv:2:", "state is '3', expected 0, 1 or 2"},
        {h + "0,16.6,20,3,nan,,100,1.5,10,0,300,4,200\n", "t.csv:2:", "state is ''"},
        {h + "0,16.6,20,3,nan,2,0,1.5,10,0,300,4,200\n", "t.csv:2:", "motion_distance_m is '0'"},
        {h + "0,16.6,20,3,nan,2,nan,1.5,10,0,300,4,200\n", "t.csv:2:", "motion_distance_m is 'nan'"},
        {h + "0,16.6,20,3,nan,2,100,33,10,0,300,4,200\n", "t.csv:2:", "splat_px is '33', expected pixels in [0, 32]"},
        {h + "0,16.6,20,3,nan,2,100,1.5,ten,0,300,4,200\n", "t.csv:2:", "visible is 'ten'"},
        {h + "0,16.6,20,3,nan,2,100,1.5,10,0,300,4,\n", "t.csv:2:", "range_m is ''"},
    };
    for (const Bad& bad : bads) {
        try {
            read(bad.text);
            ADD_FAILURE() << "accepted: " << bad.text;
        } catch (const std::runtime_error& error) {
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with(bad.where)) << message;
            EXPECT_NE(message.find(bad.said), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

// Cut within its last number, a row has all its fields: only the line end tells that it is whole.
TEST(Trace, ALastRowWithoutALineEndIsLeftOut) {
    const std::string text = std::string(header) + good_row + "1,16.6,20,3,nan,2,100,1.5,10,0,300,4,200\n";
    EXPECT_EQ(read(text).rows.size(), 2u);
    EXPECT_FALSE(read(text).is_cut);
    for (const std::size_t missing : {1, 2, 20}) {
        const Trace cut = read(text.substr(0, text.size() - missing));
        EXPECT_EQ(cut.rows.size(), 1u) << missing;
        EXPECT_TRUE(cut.is_cut) << missing;
    }
}

TEST(Trace, DamagedBytesAreReadOrRefusedButNeverCrash) {
    std::mt19937_64 random(8);
    Trace trace;
    trace.settings = {{"law", "paper"}};
    for (int i = 0; i < 5; ++i) trace.rows.push_back(any_row(random, i));
    const std::string whole = write(trace);
    int refused = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        std::string text = whole.substr(0, random() % 4 == 0 ? random() % whole.size() : whole.size());
        for (std::uint64_t i = random() % 4; i > 0 && !text.empty(); --i) {
            text[random() % text.size()] = static_cast<char>(random());
        }
        try {
            read(text);
        } catch (const std::runtime_error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace sfsm
