// The reference's picture of each preset beside the renderer's, and where they differ: bin/reference_pictures FOLDER
// [PEOPLE] [WIDTHxHEIGHT]. Writes FOLDER/PRESET-STATE.png, from the left: drawn, reference, difference (grey: may
// differ, for it is beside an edge; from yellow to red: off by more than the tolerance), and prints how they compare.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/gl/headless.h"
#include "tests/bench/canvas.h"
#include "tests/reference/stadium.h"

namespace {

render::Image difference(const reference::Frame& frame) {
    render::Image image{frame.drawn.width, frame.drawn.height, {}};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double off = reference::distance(frame.drawn, frame.expected, x, y);
            const bool wrong = off > reference::tolerance;
            const bool edge = frame.expected.shades[static_cast<std::size_t>(y) * image.width + x].size() > 1;
            const auto green = static_cast<std::uint8_t>(off > 64 ? 0 : 255 - 4 * off);
            const std::uint8_t grey = edge ? 215 : 255;
            for (const std::uint8_t value :
                 {wrong ? std::uint8_t{255} : grey, wrong ? green : grey, wrong ? std::uint8_t{0} : grey})
                image.pixels.push_back(value);
        }
    }
    return image;
}

void write(const std::string& path, const reference::Frame& frame) {
    const int width = frame.drawn.width, height = frame.drawn.height;
    render::Image sheet{3 * width, height, std::vector<std::uint8_t>(std::size_t{9} * width * height)};
    bench::paste(sheet, frame.drawn, 0, 0);
    bench::paste(sheet, frame.expected.image(), width, 0);
    bench::paste(sheet, difference(frame), 2 * width, 0);
    const std::vector<std::uint8_t> bytes = render::encode_png(sheet);
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) throw std::runtime_error(path + ": could not be written");
}

// A positive whole number, or throws.
int number(const std::string& text) {
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (text.empty() || *end != 0 || value < 1 || value > 1'000'000)
        throw std::runtime_error("found '" + text + "', expected a whole number from 1 to 1000000");
    return static_cast<int>(value);
}

void shoot_all(const std::string& folder, int people, int width, int height) {
    const render::gl::HeadlessContext context;
    const tests::SmallScene scene(people);
    reference::Stadium stadium(scene, width, height);
    constexpr std::int64_t tick = 1234;
    constexpr double motion_distance = 40, splat_size = 2;
    const sfsm::Decision decisions[] = {
        {}, {sfsm::State::slowed, motion_distance, 0}, {sfsm::State::points, motion_distance, splat_size}};
    for (const auto& [preset, seconds] :
         {std::pair{"still", 0.0}, {"close", 0.0}, {"medium", 0.0}, {"remote", 0.0}, {"roam", 33.0}}) {
        for (const sfsm::Decision& decision : decisions) {
            const reference::Frame frame = stadium.shoot(stadium.preset(preset, seconds), decision, tick);
            const std::string name = std::string(preset) + "-" + std::to_string(static_cast<int>(decision.state));
            write(folder + "/" + name + ".png", frame);
            std::printf("%-9s %s\n", name.c_str(), reference::compare(frame.drawn, frame.expected).text().c_str());
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> arguments(argv + 1, argv + argc);
        const std::string size = arguments.size() > 2 ? arguments[2] : "640x360";
        const std::size_t cross = size.find('x');
        if (arguments.empty() || arguments.size() > 3 || cross == std::string::npos)
            throw std::runtime_error("expected FOLDER [PEOPLE] [WIDTHxHEIGHT]");
        shoot_all(arguments[0], number(arguments.size() > 1 ? arguments[1] : "3000"), number(size.substr(0, cross)),
                  number(size.substr(cross + 1)));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "reference_pictures: %s\n", error.what());
        return 1;
    }
}
