#include "tests/bench/loss/measure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "apps/interrupt.h"
#include "figures/points.h"
#include "render/native/backdrop.h"
#include "tests/bench/loss/in_front.h"
#include "tests/bench/loss/shares.h"

namespace bench::loss {

namespace {

using sfsm::Drawing;

// [px^2] Classes that are expected to show less, and show less, are of no weight.
constexpr double least_pixels = 30;

// Who is alike: heights by half octaves, of points by octaves; spacings by quarters of one.
using Class = std::tuple<What, int, int>;
constexpr double mesh_heights = 2, point_heights = 1, spacings = 4;  // an octave

int bin_of(double value, double per_octave) {
    return static_cast<int>(std::floor(per_octave * std::log2(std::max(value, 1e-3))));
}

double middle_of(int bin, double per_octave) {
    return std::exp2((bin + 0.5) / per_octave);
}

// Sums by class, and each one's class.
class Classes {
public:
    explicit Classes(std::size_t people) : of_person_(people) {}

    // `spacing`: 0 without points of one's own.
    void add(std::size_t person, What what, double height, double spacing, double shown) {
        const double heights = what == What::points ? point_heights : mesh_heights;
        const Class key{what, bin_of(height, heights), spacing > 0 ? bin_of(spacing, spacings) : 0};
        const auto [at, is_new] = index_.try_emplace(key, sums_.size());
        if (is_new) sums_.push_back({.what = what, .height = middle_of(std::get<1>(key), heights)});
        Sum& sum = sums_[at->second];
        sum.shown += shown;
        if (spacing > 0) sum.spacing += shown * std::log(spacing);
        of_person_[person] = at->second;
    }
    Sum& of(std::size_t person) { return sums_[of_person_[person]]; }
    std::vector<Sum> take(double cell) {
        for (Sum& sum : sums_) {
            sum.cell = cell;
            if (sum.what == What::points) sum.spacing = std::exp(sum.spacing / std::max(sum.shown, 1e-9));
        }
        std::erase_if(sums_, [](const Sum& sum) { return sum.shown < least_pixels && sum.pixels < least_pixels; });
        return std::move(sums_);
    }

private:
    std::map<Class, std::size_t> index_;
    std::vector<Sum> sums_;
    std::vector<std::size_t> of_person_;
};

std::vector<bool> far_blocks_of(const render::Frame& frame, std::size_t blocks) {
    std::vector<bool> far(blocks);
    for (const render::FarBlock& block : frame.far_blocks) far[block.block] = true;
    return far;
}

double height_of(const render::Person& person, const motion::PoseTable& poses, const render::View& view) {
    return static_cast<double>(person.instance.scale * poses.rest_height * view.pixels_per_metre(person.depth));
}

double spacing_of(const render::Person& person, const motion::PoseTable& poses, const render::View& view) {
    const float pixels = person.instance.scale * view.pixels_per_metre(person.depth);
    return static_cast<double>(pixels * std::sqrt(poses.area / static_cast<float>(person.count)));
}

double sum_of(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double backdrop_error(const apps::Stage& stage, const render::View& view,
                      const render::native::BackdropErrors& errors) {
    namespace native = render::native;
    const int across = native::blocks_across(view.width), down = native::blocks_across(view.height);
    native::BackdropPicture picture{view.width,
                                    view.height,
                                    native::Plane<std::uint32_t>(view.width, view.height),
                                    native::Plane<float>(view.width, view.height),
                                    native::Plane<float>(across, down),
                                    native::Plane<float>(across, down)};
    native::Backdrop backdrop(stage.place.structure, stage.place.ground, stage.place.light, errors);
    backdrop.aim(view.from(stage.place.structure.origin));
    backdrop.paint({0, 0, view.width, view.height}, picture);
    return native::mean_error(picture);
}

Picture named(const front::Sight& sight, const std::string& recipe, Drawing drawing) {
    return {sight.venue().people(), sight.shot().name, sight.shot().is_preset, drawing, recipe, {}};
}

}  // namespace

Subject::Subject(const front::Sight& sight, Drawing drawing)
    : sight_(sight),
      drawing_(drawing),
      way_(front::way_of(drawing)),
      view_(sight.shot().view_now(sight.venue().size().width, sight.venue().size().height)),
      flip_(sight.judge().reference().now),
      present_(sight.present(drawing, 1)),
      in_front_(in_front(present_, sight.venue().stage(), view_)),
      shares_(visible_shares(sight.venue().stage(), view_)) {
    const auto& blocks = sight.venue().stage().place.crowd.blocks;
    std::size_t block = 0;
    for (const std::uint32_t number : present_.numbers) {
        while (number >= blocks[block].first + blocks[block].count) ++block;
        block_of_.push_back(block);
    }
}

std::vector<Picture> Subject::by_recipes() const {
    std::vector<figures::Choices> choices;
    for (const figures::Figure& figure : sight_.venue().stage().figures()) choices.emplace_back(figure, way_);
    std::vector<Picture> pictures;
    for (const Recipe& recipe : recipes(way_.has_cells)) {
        apps::throw_if_interrupted();
        pictures.push_back(drawn_by(recipe, choices));
    }
    return pictures;
}

Picture Subject::drawn_by(const Recipe& recipe, std::span<const figures::Choices> choices) const {
    render::Renderer& renderer = sight_.venue().renderer(drawing_);
    renderer.resize(view_.width, view_.height);
    Shooter& shooter = sight_.venue().shooter(drawing_);
    const std::int64_t tick = sight_.shot().tick;
    const double background_error = shooter.survey(view_, tick).background_error;
    const RecipeRule rule(recipe, choices, way_);
    const render::Frame& frame = recipe.rate > 0
                                     ? shooter.select({.state = sfsm::State::points, .rate = recipe.rate}, tick)
                                     : shooter.select(rule, tick);
    shooter.draw(frame);
    Picture picture = named(sight_, recipe.name, drawing_);
    picture.sums = sums_of(frame, background_error, flip_.errors(renderer.read_image()));
    return picture;
}

std::vector<Sum> Subject::sums_of(const render::Frame& frame, double background_error,
                                  const std::vector<float>& flip) const {
    const apps::Stage& stage = sight_.venue().stage();
    const std::vector<bool> is_far = far_blocks_of(frame, stage.place.crowd.blocks.size());
    const double cell = way_.has_cells ? std::max(1.0, figures::cell_share * frame.splat_size) : 1;
    const figures::PointsErrors points_errors(way_.error, cell);
    Classes classes(present_.people.size());
    double shown = 0, expected = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < present_.people.size(); ++i) {
        const bool far = is_far[block_of_[i]];
        const render::Person& person = far ? present_.people[i] : frame.people.at(next++);
        const motion::PoseTable& poses = stage.poses[person.character];
        const What what = far                                                   ? What::splats
                          : way_.representations[person.representation].is_mesh ? What::mesh
                                                                                : What::points;
        const double height = height_of(person, poses, view_),
                     pixels = shown_of(person, stage, view_, shares_[block_of_[i]]);
        const double spacing = what == What::points ? spacing_of(person, poses, view_) : 0;
        classes.add(i, what, height, spacing, pixels);
        shown += pixels;
        expected += pixels * (what == What::mesh     ? way_.error.of_mesh(height)
                              : what == What::points ? points_errors.at(static_cast<float>(spacing))
                                                     : way_.error.of_splat(height) * way_.error.times_in_cells(cell));
    }
    if (next != frame.people.size()) throw std::logic_error("a frame draws somebody who isn't visible");
    const auto all = static_cast<double>(flip.size());
    Sum background{.what = What::background, .shown = std::max(all - shown, 0.0)}, shade{.what = What::shade};
    const std::vector<std::uint8_t>& crowd = sight_.judge().crowd();
    for (std::size_t i = 0; i < flip.size(); ++i) {
        Sum& sum = crowd[i] == 0            ? background
                   : in_front_[i] == nobody ? shade
                                            : classes.of(static_cast<std::size_t>(in_front_[i]));
        sum.pixels += 1;
        sum.flip += static_cast<double>(flip[i]);
    }
    std::vector<Sum> sums = classes.take(cell);
    // What the selector expects beside shapes and background.
    const double motion = (frame.expected_flip - background_error) * all - expected;
    sums.push_back({.what = What::motion, .shown = motion / way_.error.motion_growth});
    sums.push_back(shade);
    sums.push_back(background);
    sums.push_back({.what = What::frame, .shown = all, .pixels = all, .flip = sum_of(flip)});
    return sums;
}

Picture of_nobody(const front::Sight& sight) {
    front::Venue& venue = sight.venue();
    const render::View view = sight.shot().view_now(venue.size().width, venue.size().height);
    const render::Image drawn = venue.nobody().picture(view, triangles(), sight.shot().tick);
    const std::vector<float> flip = flip_errors(sight.judge().reference().nobody, drawn);
    const auto all = static_cast<double>(flip.size());
    Picture picture = named(sight, "nobody", Drawing::native);
    const auto term = [&](What what, const render::native::BackdropErrors& errors) {
        picture.sums.push_back({.what = what,
                                .shown = all * backdrop_error(venue.stage(), view, errors),
                                .pixels = all,
                                .flip = sum_of(flip)});
    };
    term(What::all, {1, 0, 0});
    term(What::ground, {0, 1, 0});
    term(What::unrest, {0, 0, 1});
    return picture;
}

std::vector<Picture> measure(const std::vector<Part>& parts, front::References& references, bool with_opengl,
                             const std::function<void(double)>& progress) {
    std::vector<Picture> pictures;
    const auto names = [](const std::vector<std::string>& views, const std::string& view) {
        return std::ranges::find(views, view) != views.end();
    };
    double done = 0;
    for (const Part& part : parts) {
        front::Venue venue(part.people, {}, with_opengl);
        std::vector<front::Shot> shots = front::shots(venue.stage().place.cameras, venue.size().height);
        std::erase_if(shots, [&](const auto& shot) { return !part.views.empty() && !names(part.views, shot.name); });
        for (const front::Shot& shot : shots) {
            const front::Sight sight(venue, shot, references);
            const auto add = [&](std::vector<Picture> more) { std::ranges::move(more, std::back_inserter(pictures)); };
            add({of_nobody(sight)});
            add(Subject(sight, Drawing::native).by_recipes());
            if (with_opengl && names(part.opengl_in, shot.name)) add(Subject(sight, Drawing::opengl).by_recipes());
            done += 1.0 / static_cast<double>(parts.size() * shots.size());
            progress(std::min(done, 1.0));
        }
    }
    return pictures;
}

}  // namespace bench::loss
