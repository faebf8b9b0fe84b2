// Run time against error: every way to draw in every view of four crowds, in one file. docs/front.md.
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include "apps/interrupt.h"
#include "apps/output.h"
#include "apps/point_cache.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "render/gl/device.h"
#include "render/gl/headless.h"
#include "tests/bench/front/compare.h"
#include "tests/bench/front/crops.h"
#include "tests/bench/front/files.h"
#include "tests/bench/front/page.h"
#include "tests/bench/front/run.h"
#include "tests/bench/front/unfinished.h"
#include "tests/bench/front/verdicts.h"

namespace bench::front {

namespace {

struct Options {
    Part part;
    std::string out = "out";
    std::string committed = GRANDSTAND_QUICK;
    std::string write;
    std::string page_of;  // a kept front; empty: measure one
    bool quick = false;
    int threads = 0;  // 0: as many as there are
};

void add_options(CLI::App& app, Options& options) {
    constexpr std::uint64_t most_people = 1'000'000, most_threads = 1024;
    CLI::Option* people = app.add_option("--people", options.part.people, "only crowds of so many")
                              ->check(apps::whole_number(1, most_people))
                              ->delimiter(',');
    CLI::Option* views =
        app.add_option("--views", options.part.views, "only these views: still, close, roam-4s ...")->delimiter(',');
    CLI::Option* only =
        app.add_option("--only", options.part.families, "only these families: \"native points\", laws ...")
            ->delimiter(';');
    app.add_option("--out", options.out, "folder of front.csv, front.html and crops/")->capture_default_str();
    app.add_option("--threads", options.threads, "threads to draw with; else one a processor")
        ->check(apps::whole_number(1, most_threads));
    CLI::Option* quick = app.add_flag("--quick", options.quick,
                                      "counts and errors of 20,000 people in two views against the committed ones");
    CLI::Option* committed =
        app.add_option("--committed", options.committed, "the file that --quick compares with")->needs(quick);
    app.add_option("--write", options.write, "instead of comparing, write what --quick found to this file")
        ->needs(quick)
        ->excludes(committed);
    CLI::Option* page_of =
        app.add_option("--page-of", options.page_of, "measure nothing: write the page of this front.csv")
            ->excludes(quick);
    for (CLI::Option* part : {people, views, only}) {
        quick->excludes(part);
        page_of->excludes(part);
    }
    apps::describe(app,
                   "Examples:\n"
                   "  front                      everything: out/front.csv and .html, in some forty minutes\n"
                   "  front --people 20000 --views close --only \"native points;native triangles\"\n"
                   "  front --quick              fails, and names what moved, if a count or an error did\n"
                   "  front --page-of kept.csv   out/front.html of what another run measured\n"
                   "A run that was broken off goes on where it was.");
}

// The driver, where there is one.
struct OpenGl {
    std::unique_ptr<render::gl::HeadlessContext> context;
    std::string driver;   // empty: there is none
    std::string missing;  // why there is none

    OpenGl() {
        try {
            context = std::make_unique<render::gl::HeadlessContext>();
            const render::gl::Device device = render::gl::read_device();
            driver = device.renderer + ", " + device.version;
        } catch (const std::runtime_error& error) {
            context.reset();
            missing = error.what();
        }
    }
};

// How much is done and, on a terminal, how long the rest takes.
class Progress {
public:
    void operator()(double share) {
        const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        const auto minutes = static_cast<int>(std::ceil(spent * (1 - share) / share / 60));
        if (minutes != minutes_) {
            bar_.reset();
            bar_.emplace("Measuring, " + std::to_string(minutes) + " min left");
            minutes_ = minutes;
        }
        (*bar_)(share);
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    int minutes_ = -1;
    std::optional<apps::ProgressBar> bar_;
};

std::filesystem::path references_folder(const Options& options) {
    const std::filesystem::path cache = apps::default_cache();
    return cache.empty() ? std::filesystem::path(options.out) / "references" : cache / "references";
}

Front read_front(const std::string& path) {
    const std::optional<std::string> text = contents_of(path);
    if (!text) throw std::runtime_error(path + ": found no such file, expected a front that was kept");
    return from_csv(*text, path);
}

void write(const std::filesystem::path& path, const std::string& text) {
    apps::OutputFile file(path);
    file.stream() << text;
    file.commit();
}

std::filesystem::path crops_folder(const Options& options) {
    return std::filesystem::path(options.out) / "crops";
}

void write_page(const Options& options, const Front& front) {
    const std::filesystem::path page = std::filesystem::path(options.out) / "front.html";
    write(page, page_of(front, read_crops(front, crops_folder(options))));
    const Verdicts verdicts = verdicts_of(scenes_of(front));
    if (!verdicts.cases.empty() || verdicts.flicker.pairs > 0) std::printf("%s", verdicts_text(verdicts).c_str());
    std::printf("%s: %zu rows\n", page.c_str(), front.rows.size());
}

// Before the work is done; it is left as it was.
void require_writable(const std::filesystem::path& path) {
    const apps::OutputFile probe(path);
}

// Never nothing.
std::vector<Step> steps_of(const Part& part) {
    std::vector<Step> steps = plan(part);
    if (!steps.empty()) return steps;
    throw std::runtime_error(std::string("found nothing that --people, --views and --only all ask for") +
                             (part.with_opengl ? "" : " and that needs no OpenGL driver") +
                             ", expected a part of the comparison: laws are marked with 20000, 200000 or 1000000 people");
}

void measure_all(const Options& options) {
    const OpenGl opengl;
    Part part = options.part;
    part.with_opengl = !opengl.driver.empty();
    const std::vector<Step> steps = steps_of(part);
    if (opengl.driver.empty())
        std::fprintf(stderr, "front: nothing is measured of OpenGL: %s\n", opengl.missing.c_str());
    const std::filesystem::path out = options.out;
    make_folder(out);
    require_writable(out / "front.csv");
    require_writable(out / "front.html");
    const RunOptions how{
        .with_opengl = part.with_opengl, .references = references_folder(options), .crops = crops_folder(options)};
    const Machine machine = this_machine(opengl.driver);
    Unfinished unfinished(out / "front.unfinished.csv", about(how, machine), machine);
    const std::vector<Row> known = unfinished.rows();
    Front front{machine, {}};
    {
        Progress progress;
        front.rows = run(steps, how, known, [&](const Row& row, double share) {
            unfinished.add(row);
            progress(share);
        });
    }
    write(out / "front.csv", to_csv(front));
    write_page(options, read_front((out / "front.csv").string()));  // rounded as it is, for --page-of
    unfinished.remove();
}

// Those of one driver are those of another only by chance.
bool uses_opengl(const Options& options, const std::optional<Front>& committed, const std::string& driver) {
    if (driver.empty()) return false;
    return !options.write.empty() || committed->machine.opengl == driver;
}

void measure_quickly(const Options& options) {
    std::optional<Front> committed;
    if (options.write.empty())
        committed = read_front(options.committed);
    else
        require_writable(options.write);
    const OpenGl opengl;
    Part part{.people = {20'000}, .views = {"close", "remote"}, .with_marks = false};
    part.with_opengl = uses_opengl(options, committed, opengl.driver);
    const RunOptions how{
        .with_opengl = part.with_opengl, .effort = {}, .references = references_folder(options), .crops = {}};
    Progress progress;
    Front found{this_machine(opengl.driver), {}};
    found.rows = run(plan(part), how, {}, [&](const Row&, double share) { progress(share); });
    for (Row& row : found.rows) row.wall_ms = row.wall_low_ms = row.wall_high_ms = row.process_ms = 0;  // of one frame
    if (!options.write.empty()) return write(options.write, to_csv(found));
    const std::vector<std::string> lines = moved(*committed, found);
    for (const std::string& line : lines) std::printf("%s\n", line.c_str());
    if (!lines.empty())
        throw std::runtime_error(std::to_string(lines.size()) + " values differ from " + options.committed +
                                 "; if that was meant: front --quick --write FILE");
    std::printf("%zu rows, as committed\n", found.rows.size());
}

void go(const Options& options) {
    apps::finish_on_signal();
    std::optional<tbb::global_control> limit;
    if (options.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
    if (!options.page_of.empty())
        write_page(options, read_front(options.page_of));
    else if (options.quick)
        measure_quickly(options);
    else
        measure_all(options);
}

}  // namespace

}  // namespace bench::front

int main(int argc, char** argv) {
    CLI::App app("What every millisecond of a frame buys: run time against error.", "front");
    bench::front::Options options;
    bench::front::add_options(app, options);
    return apps::run_program(
        app, argc, argv, [&] { check(options.part); }, [&] { go(options); });
}
