// What points cost to make, and how far a character drawn by them is from its mesh: bin/point_errors [FILE [CLIP
// SECONDS]] > CSV, by default of the built-in person. docs/measurements/point-errors.md says what the columns are.
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "pointsample/sample.h"
#include "tests/bench/canvas.h"
#include "tests/bench/closeness.h"
#include "tests/bench/flip.h"
#include "tests/bench/subject.h"

namespace {

using bench::Canvas;
using bench::Subject;
using pointsample::Order;
using pointsample::PointModel;

constexpr std::size_t fewest = 64, most = 16384;

// Half octaves.
std::vector<std::size_t> counts() {
    std::vector<std::size_t> all;
    for (double count = fewest; count < most * 1.01; count *= std::numbers::sqrt2)
        all.push_back(static_cast<std::size_t>(std::lround(count)));
    return all;
}

// Processor time, which other work on the machine lengthens little; on one thread it is what a clock would show.
double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct TimedModel {
    PointModel model;
    double seconds;  // median
};

TimedModel sample(const Subject& subject, std::size_t count, Order order) {
    constexpr std::size_t runs = 7;
    TimedModel timed;
    std::array<double, runs> seconds{};
    for (double& run : seconds) {
        const double start = processor_seconds();
        timed.model = pointsample::sample(subject.character.mesh, {&subject.pose, 1}, {.count = count, .order = order});
        run = processor_seconds() - start;
    }
    std::nth_element(seconds.begin(), seconds.begin() + runs / 2, seconds.end());
    timed.seconds = seconds[runs / 2];
    return timed;
}

// Pictures of the mesh from around, 200 pixels high.
class Pictures {
public:
    explicit Pictures(const Subject& subject) : subject_(subject) {
        constexpr int directions = 6, margin = 4;
        constexpr float height_px = 200, elevation = 0.15f;
        for (int i = 0; i < directions; ++i) {
            const float azimuth = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / directions + 0.3f;
            views_.push_back(bench::view_of(subject.bounds, azimuth, elevation, height_px / subject.height(), margin));
            Canvas canvas(views_.back(), background);
            canvas.draw_mesh(subject);
            meshes_.push_back(canvas.image());
        }
    }

    struct Error {
        double difference = 0;  // mean absolute, of sRGB codes in [0, 1]
        double flip = 0;        // mean
    };

    // Of the first `count` points as discs.
    Error error_of(const PointModel& model, std::size_t count, double radius) const {
        Error error;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            Canvas canvas(views_[i], background);
            canvas.draw_points(subject_, model, count, static_cast<float>(radius));
            const render::Image image = canvas.image();
            double sum = 0;
            for (std::size_t k = 0; k < image.pixels.size(); ++k)
                sum += std::abs(int{image.pixels[k]} - int{meshes_[i].pixels[k]});
            error.difference += sum / (255.0 * static_cast<double>(image.pixels.size() * views_.size()));
            error.flip += bench::mean_flip_error(meshes_[i], image) / static_cast<double>(views_.size());
        }
        return error;
    }

private:
    static constexpr glm::vec3 background{0.5f};  // linear light
    const Subject& subject_;
    std::vector<bench::View> views_;
    std::vector<render::Image> meshes_;
};

class Report {
public:
    explicit Report(const Subject& subject) : subject_(subject), pictures_(subject) {
        constexpr std::size_t spots = 400'000;
        spots_ =
            bench::seen_spots(subject, bench::random_spots(subject.character.mesh, subject.pose.positions, spots, 1));
        std::printf("# %s: %zu triangles, %zu of %zu spots of its surface can be seen\n",
                    subject.character.name.c_str(), subject.character.mesh.triangle_count(), spots_.size(), spots);
        std::puts("kind,points,seconds,covering_max,covering_99,chamfer,difference,flip");
    }

    // The first `count` points of the model, which took so long to make. Lengths are shares of the height.
    void add(const char* kind, const PointModel& model, std::size_t count, double seconds) const {
        const auto points = std::span(model.positions).first(count);
        const bench::Covering covering = bench::covering_of(spots_, points);
        const double chamfer = 0.5 * (covering.mean + bench::mean_distance_to_surface(points, subject_.character.mesh,
                                                                                      subject_.pose.positions));
        const Pictures::Error error = pictures_.error_of(model, count, covering.percentile_99);
        const double height = subject_.height();
        std::printf("%s,%zu,%.3g,%.4g,%.4g,%.4g,%.4g,%.4g\n", kind, count, seconds, covering.largest / height,
                    covering.percentile_99 / height, chamfer / height, error.difference, error.flip);
        std::fflush(stdout);
    }

private:
    const Subject& subject_;
    Pictures pictures_;
    std::vector<glm::vec3> spots_;
};

void run(const Subject& subject) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Report report(subject);
    for (const auto& [kind, order] :
         {std::pair{"progressive", Order::progressive}, {"even", Order::even}, {"uniform", Order::uniform}}) {
        for (const std::size_t count : counts()) {
            const auto [model, seconds] = sample(subject, count, order);
            report.add(kind, model, count, seconds);
        }
    }
    const auto [model, seconds] = sample(subject, most, Order::progressive);
    for (const std::size_t count : counts()) report.add("prefix", model, count, seconds);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> arguments(argv + 1, argv + argc);
        run(bench::load_subject(arguments));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "point_errors: %s\n", error.what());
        return 1;
    }
}
