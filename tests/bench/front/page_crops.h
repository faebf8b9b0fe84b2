// Small pictures of what the rows of a front were measured on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bench::front {

struct Crop {
    std::size_t row = 0;  // into Front::rows
    std::string image;    // the bytes of a PNG or JPEG
};

struct Crops {
    std::vector<Crop> of_rows;                                               // not of every row
    std::map<std::pair<std::int64_t, std::string>, std::string> references;  // by people and view: PNG or JPEG
};

}  // namespace bench::front
