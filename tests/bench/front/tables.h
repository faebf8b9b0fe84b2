// The page's tables, for those who read without charts and on paper.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/front/scene.h"
#include "tests/bench/front/verdicts.h"

namespace bench::front {

// Of a scene: the front's settings and what the laws chose, with times and all errors. page/table.js is its twin.
std::string front_table(const Scene& scene, const ErrorKind& error);

// What the default law is worth: a table of summaries and one of all its choices.
std::string verdict_tables(const Verdicts& verdicts);

// What Lyu et al. 2018 give, beside the best of the scene in the same time: of 20,000 people, as theirs.
std::string paper_table(const std::vector<Scene>& scenes);

}  // namespace bench::front
