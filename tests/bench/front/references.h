// What pictures are held against: everybody at full triangles, moved every frame, and the place without anybody. Drawn
// natively 4 times as wide and high, box-filtered in linear light; each is drawn once and kept in a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/image.h"
#include "tests/bench/front/venue.h"
#include "tests/bench/front/views.h"

namespace bench::front {

struct Reference {
    render::Image before, now;
    render::Image nobody;  // now

    // Of the pixels of `now`: 1 where somebody shows, or their shade; else 0.
    std::vector<std::uint8_t> crowd() const;
};

class References {
public:
    // The folder is made when the first picture is kept.
    explicit References(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // As they are kept, else drawn and kept for the next time. A file's name says all that determines its picture, so
    // what was drawn by another renderer isn't found. Throws what apps::OutputFile throws.
    Reference of(Venue& venue, const Shot& shot);

    int drawn() const { return drawn_; }  // pictures, until now

private:
    enum class Who { everybody, nobody };
    render::Image picture(Venue& venue, const scene::CameraPose& pose, std::int64_t tick, Who who);

    std::filesystem::path folder_;
    int drawn_ = 0;
};

}  // namespace bench::front
