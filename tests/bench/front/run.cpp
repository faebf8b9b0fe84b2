#include "tests/bench/front/run.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "apps/interrupt.h"
#include "apps/output.h"
#include "tests/bench/front/crops.h"
#include "tests/bench/front/files.h"
#include "tests/bench/front/marks.h"

namespace bench::front {

namespace {

const Row* find(const std::vector<Row>& rows, const Step& step) {
    const auto at = std::ranges::find_if(rows, [&](const Row& row) { return step.is_of(row); });
    return at == rows.end() ? nullptr : &*at;
}

void write_crop(const std::filesystem::path& path, const render::Image& image, const Place& place) {
    apps::OutputFile file(path);
    file.stream() << encode_crop(cut(image, place));
    file.commit();
}

// A step after the other; what the last one needed, of crowd and view, serves the next.
class Run {
public:
    explicit Run(const RunOptions& options) : options_(options), references_(options.references) {
        if (!options.crops.empty()) make_folder(options.crops);
    }

    Row measure(const Step& step) {
        look_at(step.people, step.view);
        const Measured measured = step.setting ? front::measure(*sight_, *step.setting, options_.effort) : mark(step);
        if (!options_.crops.empty())
            write_crop(options_.crops / crop_name(measured.row), measured.picture, crop_place_);
        return measured.row;
    }

private:
    Measured mark(const Step& step) {
        if (step.recorded) return front::mark(*sight_, step.law, step.target_ms, *step.recorded, options_.effort);
        if (!loop_ || loop_->law() != step.law) loop_ = std::make_unique<Loop>(*sight_, step.law);
        return loop_->mark(step.target_ms, Patience{}, options_.effort);
    }

    void look_at(std::int64_t people, const std::string& view) {
        if (sight_ && venue_->people() == people && sight_->shot().name == view) return;
        loop_.reset();
        sight_.reset();
        if (!venue_ || venue_->people() != people) {
            venue_.reset();  // two large crowds need not be there at once
            venue_ = std::make_unique<Venue>(people, options_.size, options_.with_opengl);
        }
        const Size size = options_.size;
        const std::vector<Shot> all = shots(venue_->stage().place.cameras, size.height);
        const auto shot = std::ranges::find(all, view, &Shot::name);
        if (shot == all.end()) throw std::logic_error("no view " + view);
        sight_ = std::make_unique<Sight>(*venue_, *shot, references_);
        const Judge& judge = sight_->judge();
        crop_place_ = busiest(detail_of(judge.reference().now, judge.crowd()), size.width, size.height);
        if (!options_.crops.empty())
            write_crop(options_.crops / crop_name_of_reference(people, view), judge.reference().now, crop_place_);
    }

    const RunOptions& options_;
    References references_;
    std::unique_ptr<Venue> venue_;
    std::unique_ptr<Sight> sight_;
    std::unique_ptr<Loop> loop_;
    Place crop_place_;
};

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[sizeof "2026-11-26"];
    std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
    return text;
}

}  // namespace

std::vector<Row> run(std::span<const Step> steps, const RunOptions& options, const std::vector<Row>& known,
                     const std::function<void(const Row& row, double share_done)>& keep) {
    double all_s = 0, done_s = 0;
    for (const Step& step : steps)
        if (!find(known, step)) all_s += step.expected_s();
    std::vector<Row> rows;
    Run one(options);
    for (const Step& step : steps) {
        if (const Row* row = find(known, step)) {
            rows.push_back(*row);
            continue;
        }
        apps::throw_if_interrupted();
        rows.push_back(one.measure(step));
        done_s += step.expected_s();
        keep(rows.back(), done_s / all_s);
    }
    return rows;
}

std::string about(const RunOptions& options, const Machine& machine) {
    constexpr std::int64_t few = 1000;
    Venue venue(few, options.size, false);
    return venue.key() + " " + std::to_string(options.size.width) + "x" + std::to_string(options.size.height) + ", " +
           machine.processor + ", " + std::to_string(machine.threads) + " threads, " + machine.opengl;
}

Machine this_machine(const std::string& opengl) {
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return {processor_name(), static_cast<int>(threads), opengl, today()};
}

}  // namespace bench::front
