#include "apps/point_cache.h"

#include <cstdlib>
#include <exception>
#include <optional>

#include "apps/interrupt.h"
#include "apps/output.h"
#include "pointsample/points_file.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

std::optional<pointsample::PointModel> kept(const fs::path& path, const std::string& key) {
    try {
        const pointsample::PointsFile file(path);
        if (file.key() == key) return file.unpack();
    } catch (const std::exception&) {
        // Not there, damaged or of another version: made anew.
    }
    return {};
}

void keep(const fs::path& path, const pointsample::PointModel& model, const std::string& key) {
    try {
        fs::create_directories(path.parent_path());
        OutputFile file(path);
        pointsample::write_pts(file.stream(), model, key);
        file.commit();
    } catch (const std::exception&) {
        throw_if_interrupted();  // else: no room, no rights; the next run makes it again
    }
}

}  // namespace

fs::path default_cache() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return fs::path(cache) / "grandstand";
    if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "grandstand";
    return {};
}

pointsample::PointModel PointCache::get(const std::string& key,
                                        const std::function<pointsample::PointModel()>& make) const {
    const fs::path path = folder_.empty() ? fs::path() : folder_ / (key + ".pts");
    if (!path.empty()) {
        if (auto model = kept(path, key)) return std::move(*model);
    }
    const pointsample::PointModel made = make();
    if (!path.empty()) keep(path, made, key);
    return pointsample::as_stored(made);
}

}  // namespace apps
