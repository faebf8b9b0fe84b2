#include "apps/lettering.h"

#include <stb_easy_font.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace apps {

namespace {

// As stb_easy_font wants it: a string of its own, of characters that it has.
std::string printable(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c < ' ' || c > '~') c = '?';
    return out;
}

void fill(render::Image& image, int left, int top, int right, int bottom, glm::u8vec3 color) {
    for (int y = std::max(top, 0); y < std::min(bottom, image.height); ++y) {
        for (int x = std::max(left, 0); x < std::min(right, image.width); ++x) {
            const auto at =
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
            for (int channel = 0; channel < 3; ++channel)
                image.pixels[at + static_cast<std::size_t>(channel)] = color[channel];
        }
    }
}

}  // namespace

void write_text(render::Image& image, int x, int y, int size, glm::u8vec3 color, std::string_view text) {
    struct Corner {
        float x, y, z;
        std::array<unsigned char, 4> color;
    };
    constexpr std::size_t most_corners_a_letter = 64;
    std::string letters = printable(text);
    std::vector<Corner> corners(most_corners_a_letter * (letters.size() + 1));
    const int quads = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                          static_cast<int>(corners.size() * sizeof(Corner)));
    for (std::size_t i = 0; i < static_cast<std::size_t>(quads); ++i) {
        const Corner &first = corners[4 * i], &opposite = corners[4 * i + 2];
        fill(image, x + size * static_cast<int>(first.x), y + size * static_cast<int>(first.y),
             x + size * static_cast<int>(opposite.x), y + size * static_cast<int>(opposite.y), color);
    }
}

int text_width(std::string_view text, int size) {
    std::string letters = printable(text);
    return size * stb_easy_font_width(letters.data());
}

}  // namespace apps
