#include "apps/stage.h"

#include "apps/interrupt.h"
#include "apps/progress.h"
#include "scene/places/stadium.h"

namespace apps {

std::unique_ptr<Stage> build_stage(const std::vector<CharacterFile>& characters, std::int64_t people,
                                   std::uint64_t seed, const PointCache& cache, const figures::Way& way, bool strict,
                                   bool verbose) {
    auto stage = std::make_unique<Stage>();
    Preparation preparation{.seed = seed, .cache = cache, .way = way, .strict = strict, .verbose = verbose};
    if (characters.empty()) add_person(*stage, preparation);
    for (const CharacterFile& character : characters) {
        preparation.byte_budget = Preparation::pose_byte_budget / characters.size();
        add_character(*stage, character, preparation);
    }
    throw_if_interrupted();
    ProgressBar bar("Seating the crowd");
    const auto show = [&](double fraction) {
        throw_if_interrupted();
        bar(fraction);
    };
    std::vector<double> weights;
    for (const CharacterFile& character : characters) weights.push_back(character.weight);
    stage->place = scene::make_stadium({people, stage->cast, stage->poses, seed, show, weights});
    return stage;
}

}  // namespace apps
