// What each way of drawing somebody loses, fitted to pictures: docs/measurements/loss.md.
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/interrupt.h"
#include "apps/output.h"
#include "apps/point_cache.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "figures/way.h"
#include "render/gl/headless.h"
#include "tests/bench/front/files.h"
#include "tests/bench/loss/fit.h"
#include "tests/bench/loss/measure.h"
#include "tests/bench/loss/report.h"

namespace bench::loss {

namespace {

struct Options {
    std::string out = "out/loss.csv";
    std::string from;  // a kept file; empty: measure
    bool quick = false, as_is = false;
};

void add_options(CLI::App& app, Options& options) {
    CLI::Option* out = app.add_option("--out", options.out, "the file of what is measured")->capture_default_str();
    CLI::Option* from = app.add_option("--from", options.from, "measure nothing: fit to this file")->excludes(out);
    app.add_flag("--quick", options.quick, "only 20,000 people natively in two views")->excludes(from);
    app.add_flag("--as-is", options.as_is, "fit nothing: how far today's constants are off");
    apps::describe(app,
                   "Examples:\n"
                   "  fit_loss                  measures in some ten minutes, then fits\n"
                   "  fit_loss --from loss.csv  fits to what was measured\n"
                   "  fit_loss --from loss.csv --as-is");
}

std::vector<Part> parts(bool quick) {
    if (quick) return {{20'000, {"close", "roam-11s"}, {}}};
    return {
        {1'000, {"still", "close", "remote", "roam-11s", "roam-34s"}, {}},
        {20'000, {}, {"still", "close", "remote", "roam-11s"}},
        {200'000, {"still", "close", "medium", "remote", "wide", "roam-4s", "roam-19s", "roam-34s", "roam-49s"}, {}},
        {1'000'000, {"remote", "wide", "roam-4s"}, {}}};
}

std::string references_folder() {
    const std::filesystem::path cache = apps::default_cache();
    return cache.empty() ? "out/references" : (cache / "references").string();
}

std::unique_ptr<render::gl::HeadlessContext> opengl(bool wanted) {
    if (!wanted) return nullptr;
    try {
        return std::make_unique<render::gl::HeadlessContext>();
    } catch (const std::runtime_error& error) {
        std::fprintf(stderr, "fit_loss: nothing is measured of OpenGL: %s\n", error.what());
        return nullptr;
    }
}

// Read again, so that a fit is that of the file.
std::vector<Picture> pictures_of(const Options& options) {
    if (!options.from.empty()) {
        const auto text = front::contents_of(options.from);
        if (!text) throw std::runtime_error(options.from + ": found no such file, expected what was measured");
        return from_csv(*text, options.from);
    }
    front::make_folder(std::filesystem::absolute(options.out).parent_path());
    apps::OutputFile file(options.out);
    const auto context = opengl(!options.quick);
    front::References references(references_folder());
    std::string csv;
    {
        apps::ProgressBar bar("Measuring");
        csv = to_csv(measure(parts(options.quick), references, context != nullptr, std::ref(bar)));
    }
    file.stream() << csv;
    file.commit();
    return from_csv(csv, options.out);
}

void report(const Measured& measured, sfsm::Drawing drawing, const figures::ExpectedError& error,
            const render::native::BackdropErrors& around) {
    std::printf("\n%s, in figures/way.cpp:\n%s\n%s\n%s", drawing == sfsm::Drawing::native ? "natively" : "by OpenGL",
                text_of(error).c_str(), table_of(residuals_of(measured, error, around)).c_str(),
                summary_of(measured, error, around).c_str());
}

// What motion loses doesn't depend on what draws, and is measured natively.
void go(const Options& options) {
    apps::finish_on_signal();
    const std::vector<Picture> pictures = pictures_of(options);
    const auto around = options.as_is ? render::native::BackdropErrors{} : fit_backdrop(pictures);
    std::printf("around people, in render/native/backdrop.h:\n%s", text_of(around).c_str());
    const Measured natively(pictures, sfsm::Drawing::native), by_opengl(pictures, sfsm::Drawing::opengl);
    figures::ExpectedError error = figures::natively().error, opengl_error = figures::by_opengl().error;
    if (!options.as_is) error = fit_people(natively, around, error, Motion::fitted);
    report(natively, sfsm::Drawing::native, error, around);
    if (by_opengl.all().empty()) return;
    if (!options.as_is) {
        opengl_error.motion_growth = error.motion_growth;
        opengl_error.motion_most = error.motion_most;
        opengl_error = fit_people(by_opengl, around, opengl_error, Motion::held);
    }
    report(by_opengl, sfsm::Drawing::opengl, opengl_error, around);
}

}  // namespace

}  // namespace bench::loss

int main(int argc, char** argv) {
    CLI::App app("Fits what each way of drawing somebody is expected to lose to pictures.", "fit_loss");
    bench::loss::Options options;
    bench::loss::add_options(app, options);
    return apps::run_program(
        app, argc, argv, [] {}, [&] { bench::loss::go(options); });
}
