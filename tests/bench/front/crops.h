// Small parts of pictures, to look at: of each row of a view the same place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/image.h"
#include "tests/bench/front/page_crops.h"
#include "tests/bench/front/row.h"

namespace bench::front {

inline constexpr int crop_width = 120, crop_height = 80;  // [px]

struct Place {
    int x = 0, y = 0, width = 0, height = 0;  // [px]
};

// What there is to lose of each of the crowd's pixels (an element each, 1 or 0): how far it differs from those to the
// right of it and below.
std::vector<std::uint8_t> detail_of(const render::Image& image, const std::vector<std::uint8_t>& crowd);

// Where the sum of these (an element a pixel of a picture so large) is largest; the first from the top of several. All
// of a picture that is smaller than a crop.
Place busiest(const std::vector<std::uint8_t>& detail, int width, int height);

render::Image cut(const render::Image& image, const Place& place);

// As a JPEG file's bytes.
std::string encode_crop(const render::Image& image);

// "20000-close-native-points-S-1.4.jpg"; of what a law chose: "20000-close-paper-16.6.jpg"; of the reference:
// "20000-close-reference.jpg".
std::string crop_name(const Row& row);
std::string crop_name_of_reference(std::int64_t people, const std::string& view);

// Those of presets that are in the folder: of as many crowds as leave the page small enough to be sent, those first
// that laws are marked in.
Crops read_crops(const Front& front, const std::filesystem::path& folder);

}  // namespace bench::front
