// Pictures of a character drawn by its points: bin/point_pictures FOLDER [FILE [CLIP SECONDS]], by default of the
// built-in person. FOLDER/points.png: the first 16, 64, 256, 1 k, 4 k and 16 k points and the mesh; above as discs as
// wide as closes the surface, below as dots on it. FOLDER/point-orders.png: 1 k dots in progressive, even and uniform
// order.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "pointsample/sample.h"
#include "tests/bench/canvas.h"
#include "tests/bench/closeness.h"
#include "tests/bench/subject.h"

namespace {

using bench::Canvas;
using bench::Subject;
using bench::View;
using pointsample::Order;
using pointsample::PointModel;

constexpr float azimuth = 0.5f, elevation = 0.12f;  // [rad]
constexpr glm::vec3 paper(1), clay(0.5f);           // linear light

PointModel sample(const Subject& subject, std::size_t count, Order order) {
    return pointsample::sample(subject.character.mesh, {&subject.pose, 1}, {.count = count, .order = order});
}

// Side by side, row by row; all of the same size.
render::Image sheet_of(std::span<const render::Image> parts, int columns) {
    const int rows = static_cast<int>(parts.size()) / columns, width = parts[0].width, height = parts[0].height;
    render::Image sheet{columns * width, rows * height, {}};
    sheet.pixels.resize(std::size_t{3} * sheet.width * sheet.height);
    for (int i = 0; i < columns * rows; ++i) bench::paste(sheet, parts[i], i % columns * width, i / columns * height);
    return sheet;
}

void write(const std::string& path, const render::Image& image) {
    const std::vector<std::uint8_t> bytes = render::encode_png(image);
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) throw std::runtime_error(path + ": could not be written");
}

// Dots on a bare body, which hides those of its far side.
render::Image dots(const Subject& subject, const View& view, const PointModel& model, std::size_t count,
                   float radius_px) {
    Canvas canvas(view, paper);
    canvas.draw_mesh(subject, clay);
    const float radius = radius_px / view.pixels_per_unit;
    canvas.draw_points(subject, model, count, radius, radius);
    return canvas.image();
}

void draw_prefixes(const Subject& subject, const std::string& path) {
    constexpr float height_px = 360;
    constexpr int margin = 24;
    constexpr std::size_t spots = 100'000;
    const View view = bench::view_of(subject.bounds, azimuth, elevation, height_px / subject.height(), margin);
    const PointModel model = sample(subject, 16384, Order::progressive);
    const std::vector<glm::vec3> surface =
        bench::seen_spots(subject, bench::random_spots(subject.character.mesh, subject.pose.positions, spots, 1));
    std::vector<render::Image> closed, bare;
    for (const std::size_t count : {16, 64, 256, 1024, 4096, 16384}) {
        const auto prefix = std::span(model.positions).first(count);
        const auto radius = static_cast<float>(bench::covering_of(surface, prefix).percentile_99);
        Canvas canvas(view, paper);
        canvas.draw_points(subject, model, count, radius);
        closed.push_back(canvas.image());
        constexpr float dot_share = 0.4f, largest_dot_px = 4;
        bare.push_back(
            dots(subject, view, model, count, std::min(dot_share * radius * view.pixels_per_unit, largest_dot_px)));
    }
    Canvas mesh(view, paper);
    mesh.draw_mesh(subject);
    closed.push_back(mesh.image());
    bare.push_back(mesh.image());
    const int columns = static_cast<int>(closed.size());
    closed.insert(closed.end(), bare.begin(), bare.end());
    write(path, sheet_of(closed, columns));
}

void draw_orders(const Subject& subject, const std::string& path) {
    constexpr float height_px = 640, radius_px = 2.2f;
    constexpr int margin = 12;
    constexpr std::size_t count = 1024;
    const View view = bench::view_of(subject.bounds, azimuth, elevation, height_px / subject.height(), margin);
    std::vector<render::Image> parts;
    for (const Order order : {Order::progressive, Order::even, Order::uniform})
        parts.push_back(dots(subject, view, sample(subject, count, order), count, radius_px));
    write(path, sheet_of(parts, static_cast<int>(parts.size())));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> arguments(argv + 1, argv + argc);
        if (arguments.empty()) throw std::runtime_error("found no arguments, expected FOLDER [FILE [CLIP SECONDS]]");
        const Subject subject = bench::load_subject(std::span(arguments).subspan(1));
        draw_prefixes(subject, arguments[0] + "/points.png");
        draw_orders(subject, arguments[0] + "/point-orders.png");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "point_pictures: %s\n", error.what());
        return 1;
    }
}
