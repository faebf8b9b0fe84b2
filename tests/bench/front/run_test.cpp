// A small comparison from end to end: the same numbers in every run, on any number of threads, and after a break.
#include "tests/bench/front/run.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "motion/schedule.h"
#include "tests/bench/fidelity.h"
#include "tests/bench/front/csv.h"
#include "tests/bench/front/marks.h"
#include "tests/bench/front/small_venue.h"
#include "tests/bench/front/unfinished.h"

namespace {

namespace fs = std::filesystem;
using bench::front::columns;
using bench::front::few_people;
using bench::front::Kind;
using bench::front::Part;
using bench::front::plan;
using bench::front::Row;
using bench::front::RunOptions;
using bench::front::Setting;
using bench::front::small_size;
using bench::front::Step;
using bench::front::Unfinished;

class FrontRun : public testing::Test {
protected:
    FrontRun() { fs::create_directories(folder_); }
    ~FrontRun() override { fs::remove_all(folder_); }

    RunOptions options() const {
        return {.size = small_size, .with_opengl = false, .effort = {}, .references = folder_ / "references"};
    }
    std::vector<Row> run(const std::vector<Step>& steps) const {
        return bench::front::run(steps, options(), {}, ignore);
    }

    static void ignore(const Row&, double) {}

    const fs::path folder_ = fs::temp_directory_path() / ("front_test." + std::to_string(::getpid()));
};

const Part few{.people = {few_people}, .views = {"close", "roam-49s"}, .with_opengl = false, .with_marks = false};

// All but the times.
std::string counted(const std::vector<Row>& rows) {
    std::string text;
    for (const Row& row : rows)
        for (const auto& column : columns())
            if (column.kind != Kind::time) text += column.name + " " + column.text_of(row) + '\n';
    return text;
}

TEST_F(FrontRun, CountsAndErrorsAreTheSameInEveryRunAndOnAnyNumberOfThreads) {
    const auto steps = plan(few);
    const auto on = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        fs::remove_all(folder_ / "references");
        return counted(run(steps));
    };
    const std::string once = on(1);
    EXPECT_EQ(once, on(2));
    EXPECT_EQ(once, counted(run(steps)));  // of references that were kept
}

// In the midst of what it holds.
void flip_a_bit(const fs::path& path) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto middle = static_cast<std::streamoff>(fs::file_size(path) / 2);
    file.seekg(middle);
    const int byte = file.get();
    file.seekp(middle);
    file.put(static_cast<char>(byte ^ 4));
}

TEST_F(FrontRun, ReferencesAreDrawnOnceAndAgainWhereDamaged) {
    auto& venue = bench::front::small_venue();
    const auto shot = bench::front::shots(venue.stage().place.cameras, small_size.height).at(1);
    bench::front::References first(folder_), second(folder_), third(folder_), fourth(folder_);
    const auto drawn = first.of(venue, shot);
    EXPECT_EQ(first.drawn(), 3);
    const auto kept = second.of(venue, shot);
    EXPECT_EQ(second.drawn(), 0);
    EXPECT_EQ(drawn.now.pixels, kept.now.pixels);
    EXPECT_EQ(drawn.before.pixels, kept.before.pixels);
    EXPECT_EQ(drawn.nobody.pixels, kept.nobody.pixels);
    fs::resize_file(fs::directory_iterator(folder_)->path(), 100);
    EXPECT_EQ(third.of(venue, shot).now.pixels, drawn.now.pixels);
    EXPECT_EQ(third.drawn(), 1);
    flip_a_bit(fs::directory_iterator(folder_)->path());
    EXPECT_EQ(fourth.of(venue, shot).now.pixels, drawn.now.pixels);
    EXPECT_EQ(fourth.drawn(), 1);
}

// What the native renderer makes of everybody, at a size, from a camera, at a tick.
render::Image triangles_of(const scene::CameraPose& pose, std::int64_t tick, int factor) {
    auto& venue = bench::front::small_venue();
    const render::View view = render::make_view(pose, factor * small_size.width, factor * small_size.height);
    return venue.shooter(sfsm::Drawing::native).picture(view, bench::triangles(), tick);
}

TEST_F(FrontRun, ReferencesAreOfTheirCamerasAndTicks) {
    auto& venue = bench::front::small_venue();
    for (const int number : {1, 6}) {
        const auto shot = bench::front::shots(venue.stage().place.cameras, small_size.height).at(number);
        const auto references = bench::front::References(folder_).of(venue, shot);
        constexpr int side = 4;
        const auto expected = [&](const scene::CameraPose& pose, std::int64_t tick) {
            return bench::box_filtered(triangles_of(pose, tick, side), side).pixels;
        };
        EXPECT_EQ(references.now.pixels, expected(shot.now, shot.tick)) << shot.name;
        EXPECT_EQ(references.before.pixels, expected(shot.before, shot.tick - 1)) << shot.name;
        EXPECT_NE(references.now.pixels, expected(shot.now, shot.tick - 1)) << shot.name;
        EXPECT_NE(references.before.pixels, expected(shot.before, shot.tick)) << shot.name;
    }
}

// However many frames are timed after it.
TEST_F(FrontRun, JudgedAreTheFrameAndTheOneBefore) {
    auto& venue = bench::front::small_venue();
    bench::front::References references(folder_);
    const auto shot = bench::front::shots(venue.stage().place.cameras, small_size.height).at(1);
    const bench::front::Sight sight(venue, shot, references);
    const Setting& triangles = *std::ranges::find(bench::front::settings(), "native triangles", &Setting::family);
    const auto measured = bench::front::measure(sight, triangles, {5, 1e6});
    const render::Image before = triangles_of(shot.before, shot.tick - 1, 1),
                        now = triangles_of(shot.now, shot.tick, 1);
    EXPECT_EQ(measured.picture.pixels, now.pixels);
    EXPECT_NE(triangles_of(shot.now, shot.tick + 5, 1).pixels, now.pixels);
    const auto& reference = sight.judge().reference();
    EXPECT_EQ(measured.row.change, bench::change_error(before, now, reference.before, reference.now));
}

TEST_F(FrontRun, ErrorsShrinkAsSettingsGetFiner) {
    const auto rows = run(plan({.people = {few_people}, .views = {"medium"}, .families = {"native points"}}));
    ASSERT_EQ(rows.size(), 9u);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_GE(rows[i].outline_px, rows[i - 1].outline_px);
        EXPECT_LE(rows[i].work[sfsm::WorkKind::point] + rows[i].work[sfsm::WorkKind::triangle],
                  rows[i - 1].work[sfsm::WorkKind::point] + rows[i - 1].work[sfsm::WorkKind::triangle]);
    }
    EXPECT_LT(rows.front().frame.flip, rows.back().frame.flip);
    EXPECT_GT(rows.front().crowd.psnr, rows.back().crowd.psnr);
    EXPECT_GT(rows.front().crowd_share, 0);
    EXPECT_GE(rows.front().crowd.flip, rows.front().frame.flip);
    EXPECT_GT(rows.back().covering_px, 0);
    EXPECT_EQ(rows.front().motion_px, 0);
}

// Which draws less the more it asks of a piece of work; what it comes to is in the row.
TEST_F(FrontRun, ARateDrawsNoMoreThanALowerOne) {
    const auto rows = run(plan({.people = {few_people}, .views = {"medium"}, .families = {"native rates"}}));
    ASSERT_EQ(rows.size(), 15u);
    const auto pieces = [](const Row& row) {
        double sum = 0;
        for (const sfsm::WorkKind kind : {sfsm::WorkKind::triangle, sfsm::WorkKind::point})
            sum += figures::natively().pieces[sfsm::index_of(kind)] * static_cast<double>(row.work[kind]);
        return sum;
    };
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_GT(rows[i].decision.rate, rows[i - 1].decision.rate);
        EXPECT_LE(pieces(rows[i]), pieces(rows[i - 1]));
        EXPECT_GE(rows[i].expected_flip, rows[i - 1].expected_flip);
    }
    EXPECT_LT(rows.front().frame.flip, rows.back().frame.flip);
    EXPECT_GT(rows.back().max_splat_px, rows.front().max_splat_px);
    EXPECT_EQ(rows.back().decision.state, sfsm::State::points);
    EXPECT_EQ(rows.back().density, 0);
}

// They are finer, the more they may spend, and draw what they say.
TEST_F(FrontRun, RivalsAreFinerTheMoreTheySpend) {
    for (const char* family :
         {"rival: by distance", "rival: budget, largest first", "rival: budget, smallest demoted"}) {
        std::vector<Step> steps;
        for (const Setting& setting : bench::front::settings())
            if (setting.family == family) steps.push_back({few_people, "close", &setting, "", 0});
        const auto rows = run(steps);
        ASSERT_GE(rows.size(), 7u) << family;
        EXPECT_LT(rows.back().frame.flip, rows.front().frame.flip) << family;
        EXPECT_GT(rows.back().work[sfsm::WorkKind::point] + rows.back().work[sfsm::WorkKind::triangle],
                  rows.front().work[sfsm::WorkKind::point] + rows.front().work[sfsm::WorkKind::triangle])
            << family;
        for (const Row& row : rows) {
            EXPECT_EQ(row.motion_px, 0) << family;
            EXPECT_EQ(row.decision.rate, 0) << family;
            EXPECT_GE(row.decision.splat_size, 1) << family;
        }
    }
}

// By what the crowd itself says, person by person and in double precision.
TEST_F(FrontRun, MotionIsThatOfTheVerticesSinceEachOneMoved) {
    auto& venue = bench::front::small_venue();
    const apps::Stage& stage = venue.stage();
    const scene::Crowd& crowd = stage.place.crowd;
    const motion::PoseTable& poses = stage.poses[0];
    const auto shot = bench::front::shots(stage.place.cameras, small_size.height).at(2);
    const render::View view = shot.view_now(small_size.width, small_size.height);
    bench::Shooter& shooter = venue.shooter(sfsm::Drawing::native);
    const auto present =
        bench::front::present_in(shooter.choose(view, bench::triangles(), shot.tick), stage, shot.tick);
    const sfsm::Decision decision{sfsm::State::slowed, 1.0, 0};
    Row row;
    fill_offsets(shooter.choose(view, decision, shot.tick), present, stage, figures::natively(), row);

    const auto on_screen = [&](std::uint32_t person, std::int64_t tick, int vertex) {
        const scene::Placement at = scene::place(crowd, person, stage.cast[0], tick);
        const scene::Action action = scene::act(crowd, person, stage.cast[0], poses, tick);
        const int pose = poses.pose_at(action.clip, action.clip_tick);
        const glm::dvec3 model = motion::unpack_position(
            poses.vertices[static_cast<std::size_t>(pose) * poses.vertex_count + vertex], poses.box);
        const double scale = static_cast<double>(crowd.height[person]) / static_cast<double>(poses.rest_height);
        const double s = std::sin(static_cast<double>(at.yaw)), c = std::cos(static_cast<double>(at.yaw));
        const glm::dvec3 world =
            glm::dvec3(at.position) + scale * glm::dvec3(c * model.x + s * model.z, model.y, c * model.z - s * model.x);
        const glm::dvec4 clip = glm::dmat4(view.clip_from_camera_relative) * glm::dvec4(world - view.position, 1);
        return 0.5 * glm::dvec2(clip.x * view.width, clip.y * view.height) / clip.w;
    };
    double sum = 0, worst = 0;
    for (std::size_t i = 0; i < present.people.size(); ++i) {
        const std::uint32_t person = present.numbers[i];
        const int period = motion::update_period(present.people[i].depth, 1.0f);
        const std::int64_t due = motion::due_tick(shot.tick, period, crowd.hash[person]);
        double farthest = 0;
        for (int vertex = 0; vertex < poses.vertex_count; ++vertex)
            farthest =
                std::max(farthest, glm::distance(on_screen(person, due, vertex), on_screen(person, shot.tick, vertex)));
        sum += farthest;
        worst = std::max(worst, farthest);
    }
    ASSERT_GT(worst, 0);
    EXPECT_NEAR(row.motion_px, sum / static_cast<double>(present.people.size()), 1e-3 * row.motion_px);
    EXPECT_NEAR(row.motion_worst_px, worst, 1e-3 * worst);
    EXPECT_EQ(row.outline_px, 0);
    EXPECT_EQ(row.covering_px, 0);
}

// Broken off after some rows, and within a line.
TEST_F(FrontRun, GoesOnWhereItWasBrokenOff) {
    const auto steps =
        plan({.people = {few_people}, .views = {"close"}, .families = {"native motion", "native mixture"}});
    const fs::path file = folder_ / "rows.csv";
    struct Broken {};
    {
        Unfinished unfinished(file, "this", {});
        const auto keep = [&](const Row& row, double) {
            unfinished.add(row);
            if (unfinished.rows().size() == 3) throw Broken();
        };
        EXPECT_THROW(bench::front::run(steps, options(), {}, keep), Broken);
    }
    std::ofstream(file, std::ios::app) << "600,close,1,native mo";
    Unfinished unfinished(file, "this", {});
    ASSERT_EQ(unfinished.rows().size(), 3u);
    const std::vector<Row> known = unfinished.rows();
    const auto rows = bench::front::run(steps, options(), known, [&](const Row& row, double) { unfinished.add(row); });
    EXPECT_EQ(unfinished.rows().size(), steps.size());
    for (std::size_t i = 0; i < known.size(); ++i)
        EXPECT_EQ(bench::front::line_of(rows[i]), bench::front::line_of(known[i]));
    EXPECT_EQ(counted(rows), counted(run(steps)));
    unfinished.remove();
    EXPECT_FALSE(fs::exists(file));
}

TEST_F(FrontRun, RowsAboutSomethingElseAreMeasuredAnew) {
    const fs::path file = folder_ / "rows.csv";
    Unfinished(file, "this", {}).add(Row{});
    EXPECT_EQ(Unfinished(file, "this", {}).rows().size(), 1u);
    EXPECT_TRUE(Unfinished(file, "that", {}).rows().empty());
}

TEST_F(FrontRun, DamagedRowsAreRefused) {
    const fs::path file = folder_ / "rows.csv";
    Unfinished(file, "this", {}).add(Row{});
    std::ofstream(file, std::ios::app) << "many,close\n";
    try {
        const Unfinished unfinished(file, "this", {});
        FAIL() << "taken as whole";
    } catch (const std::runtime_error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ":8: ")) << error.what();
    }
    fs::remove(file);
    fs::create_directory(file);
    EXPECT_THROW(Unfinished(file, "this", {}), std::runtime_error);
}

// Of a program before or after this one.
TEST_F(FrontRun, RowsOfOtherColumnsAreMeasuredAnew) {
    const fs::path file = folder_ / "rows.csv";
    std::ofstream(file) << "# about: this\n" << bench::front::machine_lines({}) << "people,sight\n3,close\n";
    EXPECT_TRUE(Unfinished(file, "this", {}).rows().empty());
}

TEST_F(FrontRun, ALawInAClosedLoopSpendsWhatItsTargetAllows) {
    auto& venue = bench::front::small_venue();
    const auto shot = bench::front::shots(venue.stage().place.cameras, small_size.height).at(1);
    bench::front::References references(folder_);
    const bench::front::Sight sight(venue, shot, references);
    constexpr bench::front::Patience some_frames{60, 60, 0, 1e6};
    constexpr double never_met = 1e-3, always_met = 1e6;  // [ms]
    bench::front::Loop loop(sight, "predictive");
    const auto easy = loop.mark(always_met, some_frames, {}), hard = loop.mark(never_met, some_frames, {});
    EXPECT_LT(easy.row.decision.rate, hard.row.decision.rate);
    EXPECT_LT(easy.row.frame.flip, hard.row.frame.flip);
    EXPECT_EQ(hard.row.decision.state, sfsm::State::points);
    EXPECT_GT(hard.row.decision.splat_size, 0);
    EXPECT_TRUE(easy.row.is_mark());
    EXPECT_EQ(easy.row.law, "predictive");
    EXPECT_EQ(easy.row.target_ms, always_met);
    EXPECT_TRUE(easy.row.family.starts_with("native"));
}

// The paper's law makes splats larger as long as frames take longer than its target, whatever they are drawn as.
TEST_F(FrontRun, ALawIsToldWhatItsFramesTook) {
    auto& venue = bench::front::small_venue();
    const auto shot = bench::front::shots(venue.stage().place.cameras, small_size.height).at(1);
    bench::front::References references(folder_);
    const bench::front::Sight sight(venue, shot, references);
    constexpr double never_met = 1e-3;  // [ms]
    bench::front::Loop loop(sight, "paper");
    EXPECT_EQ(loop.settle(never_met, {1, 1, 0, 1e6}).splat_size, 0);
    EXPECT_GT(loop.settle(never_met, {60, 60, 0, 1e6}).splat_size, 8);
}

}  // namespace
