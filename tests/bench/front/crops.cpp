#include "tests/bench/front/crops.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>

#include "sfsm/number_text.h"
#include "tests/bench/front/files.h"
#include "tests/bench/front/marks.h"

namespace bench::front {

namespace {

// Letters, digits and points; whatever lies between is one dash.
std::string as_file_name(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const bool stays = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
        if (stays)
            name += c;
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    return name + ".jpg";
}

// Sums over all pixels above and to the left of each corner.
std::vector<std::int64_t> corner_sums(const std::vector<std::uint8_t>& detail, int width, int height) {
    const std::size_t stride = static_cast<std::size_t>(width) + 1;
    std::vector<std::int64_t> sums(stride * (static_cast<std::size_t>(height) + 1));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sums[(y + 1) * stride + x + 1] = sums[y * stride + x + 1] + sums[(y + 1) * stride + x] -
                                             sums[y * stride + x] + detail[static_cast<std::size_t>(y) * width + x];
    return sums;
}

// Those that laws are marked in come first.
std::vector<std::int64_t> crowds_by_use(const Front& front) {
    std::vector<std::int64_t> crowds;
    for (const bool marked : {true, false})
        for (const Row& row : front.rows)
            if (marked == is_marked(row.people) && std::ranges::find(crowds, row.people) == crowds.end())
                crowds.push_back(row.people);
    return crowds;
}

Crops crops_of(const Front& front, std::int64_t people, const std::filesystem::path& folder) {
    Crops crops;
    for (std::size_t i = 0; i < front.rows.size(); ++i) {
        const Row& row = front.rows[i];
        if (!row.is_preset || row.people != people) continue;
        std::string image = contents_of(folder / crop_name(row)).value_or("");
        if (!image.empty()) crops.of_rows.push_back({i, std::move(image)});
        const auto [at, is_new] = crops.references.try_emplace({row.people, row.view});
        if (is_new) at->second = contents_of(folder / crop_name_of_reference(row.people, row.view)).value_or("");
    }
    std::erase_if(crops.references, [](const auto& reference) { return reference.second.empty(); });
    return crops;
}

std::size_t size_of(const Crops& crops) {
    std::size_t bytes = 0;
    for (const Crop& crop : crops.of_rows) bytes += crop.image.size();
    for (const auto& [where, image] : crops.references) bytes += image.size();
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> detail_of(const render::Image& image, const std::vector<std::uint8_t>& crowd) {
    std::vector<std::uint8_t> detail(crowd.size());
    const auto at = [&](int x, int y) {
        const std::size_t pixel = static_cast<std::size_t>(std::min(y, image.height - 1)) * image.width +
                                  static_cast<std::size_t>(std::min(x, image.width - 1));
        constexpr int channels = 3;
        return &image.pixels[channels * pixel];
    };
    const auto apart = [](const std::uint8_t* a, const std::uint8_t* b) {
        return (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 6;  // two of them fit a byte
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::size_t pixel = static_cast<std::size_t>(y) * image.width + x;
            const int differs = apart(at(x, y), at(x + 1, y)) + apart(at(x, y), at(x, y + 1));
            if (crowd[pixel] != 0) detail[pixel] = static_cast<std::uint8_t>(differs);
        }
    return detail;
}

Place busiest(const std::vector<std::uint8_t>& detail, int width, int height) {
    const std::vector<std::int64_t> sums = corner_sums(detail, width, height);
    const auto sum_at = [&](int x, int y) { return sums[static_cast<std::size_t>(y) * (width + 1) + x]; };
    Place best{0, 0, std::min(crop_width, width), std::min(crop_height, height)};
    std::int64_t most = -1;
    for (int y = 0; y + best.height <= height; ++y)
        for (int x = 0; x + best.width <= width; ++x) {
            const std::int64_t sum = sum_at(x + best.width, y + best.height) - sum_at(x, y + best.height) -
                                     sum_at(x + best.width, y) + sum_at(x, y);
            if (sum <= most) continue;
            most = sum;
            best.x = x;
            best.y = y;
        }
    return best;
}

render::Image cut(const render::Image& image, const Place& place) {
    render::Image out{place.width, place.height, {}};
    for (int y = place.y; y < place.y + place.height; ++y) {
        const auto first = image.pixels.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{y} * image.width + place.x);
        out.pixels.insert(out.pixels.end(), first, first + std::ptrdiff_t{3} * place.width);
    }
    return out;
}

std::string encode_crop(const render::Image& image) {
    constexpr int quality = 85, channels = 3;
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    stbi_write_jpg_to_func(append, &bytes, image.width, image.height, channels, image.pixels.data(), quality);
    return bytes;
}

std::string crop_name(const Row& row) {
    const std::string place = std::to_string(row.people) + '-' + row.view + '-';
    if (row.is_mark()) return as_file_name(place + row.law + '-' + sfsm::number_text(row.target_ms));
    return as_file_name(place + row.family + '-' + row.setting);
}

std::string crop_name_of_reference(std::int64_t people, const std::string& view) {
    return as_file_name(std::to_string(people) + '-' + view + "-reference");
}

Crops read_crops(const Front& front, const std::filesystem::path& folder) {
    constexpr std::size_t most_bytes = 2'500'000;
    Crops all;
    std::size_t bytes = 0;
    for (const std::int64_t people : crowds_by_use(front)) {
        Crops crops = crops_of(front, people, folder);
        bytes += size_of(crops);
        if (bytes > most_bytes && !all.of_rows.empty()) break;
        std::ranges::move(crops.of_rows, std::back_inserter(all.of_rows));
        all.references.merge(crops.references);
    }
    return all;
}

}  // namespace bench::front
