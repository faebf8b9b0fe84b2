// Letters on pictures.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "render/image.h"

namespace apps {

// [px] Of a line of letters, times their size.
inline constexpr int letter_height = 12;

// Writes a line whose top left corner is at (x, y) [px], each dot of its letters a square of `size` px. What is not in
// ASCII shows as '?'; what leaves the picture is cut.
void write_text(render::Image& image, int x, int y, int size, glm::u8vec3 color, std::string_view text);

int text_width(std::string_view text, int size);  // [px]

}  // namespace apps
