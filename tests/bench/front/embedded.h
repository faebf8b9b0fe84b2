// A front as the page's script reads it.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/front/page_crops.h"
#include "tests/bench/front/scene.h"

namespace bench::front {

// JSON, safe inside a <script>: errors, laws, families, kinds of work; scenes with their rows, and by error the front
// and the sentences about it; crops by their row as data: addresses. Numbers that are not finite are strings that
// Number() of the script knows. Throws as page_of does.
std::string embedded(const Front& front, const std::vector<Scene>& scenes, const Crops& crops);

}  // namespace bench::front
