#include "apps/stadium_outputs.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "apps/memory.h"
#include "sfsm/recordings/facts.h"
#include "sfsm/report/report.h"
#include "sfsm/summary.h"

namespace apps {

namespace {

[[noreturn]] void fail_directory(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot make directory " + path + ": " + reason);
}

// Finds before the run that the directory can't be made or written, and makes nothing yet.
void check_directory(const std::string& path) {
    std::error_code error;
    std::filesystem::path nearest = std::filesystem::absolute(path, error);
    while (!std::filesystem::exists(nearest, error) && nearest.has_relative_path()) nearest = nearest.parent_path();
    if (!std::filesystem::is_directory(nearest, error))
        fail_directory(path, "found " + nearest.string() + ", expected a directory");
    if (::access(nearest.c_str(), W_OK | X_OK) != 0)
        fail_directory(path, nearest.string() + ": " + std::strerror(errno));
}

void print_summary(const sfsm::Summary& summary, const std::map<std::string, std::string>& settings) {
    const auto percent = [](double share) { return 100.0 * share; };
    std::printf("%s people on %s\n", settings.at("people").c_str(), settings.at("device").c_str());
    std::printf("law %s, target %.1f ms, %lld frames, camera %s\n", settings.at("law").c_str(), summary.target_ms,
                static_cast<long long>(summary.frames), settings.at("camera").c_str());
    std::printf("frame time    mean %.2f ms   median %.2f ms   99th percentile %.2f ms\n", summary.mean_ms,
                summary.p50_ms, summary.p99_ms);
    std::printf(
        "control rate  %.1f %%   within 5 %%: %.1f %%   within 10 %%: %.1f %%   over by 5 %%: %.1f %% of frames\n",
        percent(summary.control_rate), percent(summary.within_5pct), percent(summary.within_10pct),
        percent(summary.over_5pct));
    std::printf("frames        state 0: %lld   state 1: %lld   state 2: %lld\n",
                static_cast<long long>(summary.state_frames[0]), static_cast<long long>(summary.state_frames[1]),
                static_cast<long long>(summary.state_frames[2]));
    std::printf("error         motion %.2f px at most   splats %.2f px at most   FLIP %.4f expected, %.4f at most\n",
                summary.max_motion_error_px, summary.max_splat_error_px, summary.predicted_flip,
                summary.worst_predicted_flip);
    if (const std::string& bound = settings.at("max_error_px"); bound != "none" && summary.out_of_reach_frames > 0)
        std::printf("time let go   in %lld frames: nothing within --max-error %s was expected to meet the target\n",
                    static_cast<long long>(summary.out_of_reach_frames), bound.c_str());
    std::printf("memory        %s at most\n", bytes_text(peak_memory()).c_str());
}

// `frames` are those of the rows, and must live as long as the report.
sfsm::Report report_of(std::span<const sfsm::TraceRow> rows, std::span<const sfsm::FrameRecord> frames,
                       const std::map<std::string, std::string>& settings) {
    sfsm::Report report;
    report.title = settings.at("people") + " people on " + settings.at("device");
    report.recordings.push_back({"this run",
                                 sfsm::facts_of_trace(settings),
                                 {},
                                 frames,
                                 sfsm::figures_of(frames, 0, sfsm::usual_limits_ms),
                                 sfsm::stutters_of(frames),
                                 sfsm::over_targets(frames, [&](std::size_t i) { return rows[i].target_ms; })});
    const std::string& state = settings.at("state");
    report.runs.push_back(sfsm::report_run(state == "auto" ? settings.at("law") : "state " + state, rows));
    report.runs_title = "What the controller decided";
    report.runs_words = std::string(sfsm::decision_words);
    return report;
}

}  // namespace

void write_png(OutputFile& file, const render::Image& image) {
    const std::vector<std::uint8_t> bytes = render::encode_png(image);
    file.stream().write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.commit();
}

void write_png(const std::string& path, const render::Image& image) {
    OutputFile file(path);
    write_png(file, image);
}

StadiumOutputs::StadiumOutputs(const StadiumOptions& options) : options_(options) {
    if (!options.trace.empty()) trace_.emplace(options.trace);
    if (!options.png.empty()) png_.emplace(options.png);
    if (!options.summary.empty()) summary_.emplace(options.summary);
    if (!options.report.empty()) report_.emplace(options.report);
    if (options.png_every > 0) check_directory(options.png_directory);
}

bool StadiumOutputs::wants_picture(std::int64_t frame) const {
    return options_.png_every > 0 && frame % options_.png_every == 0;
}

void StadiumOutputs::write_picture(std::int64_t frame, const render::Image& image) const {
    std::error_code error;
    std::filesystem::create_directories(options_.png_directory, error);
    if (error) fail_directory(options_.png_directory, error.message());
    char name[40];
    std::snprintf(name, sizeof name, "/frame%06lld.png", static_cast<long long>(frame));
    write_png(options_.png_directory + name, image);
}

void StadiumOutputs::finish(std::span<const sfsm::TraceRow> rows, const std::map<std::string, std::string>& settings,
                            std::span<const std::string> warnings, const render::Image& last_picture) {
    const sfsm::Summary summary = sfsm::summarize(rows);
    if (trace_) {
        sfsm::write_trace_header(trace_->stream(), settings);
        for (const sfsm::TraceRow& row : rows) sfsm::write_trace_row(trace_->stream(), row);
        trace_->commit();
    }
    if (png_) write_png(*png_, last_picture);
    if (summary_) {
        summary_->stream() << sfsm::summary_json(summary, settings, warnings);
        summary_->commit();
    }
    if (report_) {
        std::vector<sfsm::FrameRecord> frames;
        for (const sfsm::TraceRow& row : rows) frames.push_back(sfsm::frame_record(row));
        sfsm::write_report_html(report_->stream(), report_of(rows, frames, settings));
        report_->commit();
    }
    const bool stdout_taken =
        options_.trace == "-" || options_.png == "-" || options_.summary == "-" || options_.report == "-";
    if (!stdout_taken) print_summary(summary, settings);
}

}  // namespace apps
