// Point models kept between runs: one .pts file each in a folder of the user's, named by what it was made from.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pointsample/point_model.h"

namespace apps {

// $XDG_CACHE_HOME/grandstand, else $HOME/.cache/grandstand; empty (no cache) where neither is set.
std::filesystem::path default_cache();

class PointCache {
public:
    // The folder is made when the first model is kept; empty: nothing is kept.
    explicit PointCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // The model of this key: as it is kept, else what `make` gives, kept for the next time. Always as it comes back
    // from a file, so that runs with and without a cache draw the same. A file that is damaged, of another version or
    // of another key is made again; several programs may do so at once, since a file is renamed into its place whole.
    // Without room or rights to keep it, the model is used all the same.
    pointsample::PointModel get(const std::string& key, const std::function<pointsample::PointModel()>& make) const;

private:
    std::filesystem::path folder_;
};

}  // namespace apps
