#include "pointsample/sample.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "model/cutout.h"
#include "pointsample/attributes.h"
#include "pointsample/candidates.h"
#include "pointsample/coverage.h"
#include "pointsample/even.h"
#include "pointsample/farthest_order.h"
#include "pointsample/hidden.h"
#include "pointsample/opening.h"
#include "pointsample/surface.h"
#include "pointsample/surface_line.h"
#include "pointsample/uniform.h"

namespace pointsample {
namespace {

constexpr std::size_t batch_size = 65536;

// Rising fractions to somebody who may not care, in steps of a hundredth and more.
class Progress {
public:
    explicit Progress(const std::function<void(double)>& report) : report_(report) {}

    void operator()(double fraction) {
        if (!report_ || fraction < last_ + 0.01) return;
        last_ = fraction;
        report_(fraction);
    }
    // For a stage that lasts from one fraction to another.
    std::function<void(double)> part(double from, double to) {
        return [this, from, to](double share) { (*this)(from + (to - from) * share); };
    }

private:
    const std::function<void(double)>& report_;
    double last_ = 0;
};

// What all stages know.
struct Job {
    const Surface& surface;
    const SampleOptions& options;
    HiddenTest* hidden;      // null: everything counts as visible
    const model::Mesh* cut;  // null: there is a surface everywhere
    Progress& progress;
};

// A model's points before they are described.
struct Draft {
    std::vector<motion::SurfacePoint> points;
    std::vector<float> spacing;       // PointModel's
    std::size_t hidden_removed = 0;   // PointModel's
    std::vector<float> first_radius;  // measure_coverage's
    Spots spots;                      // measure_coverage's
};

// The search for visible points would not end where there are next to none.
void refuse_the_hidden(std::size_t visible, std::size_t tried) {
    if (1000 * visible < tried)
        throw std::runtime_error("found " + std::to_string(visible) + " of " + std::to_string(tried) +
                                 " points visible from outside; expected at least one in a thousand");
}

void refuse_the_transparent(std::size_t there, std::size_t tried) {
    if (1000 * there < tried)
        throw std::runtime_error("found a surface that is transparent; expected one in a thousand of it not to be");
}

// One element a point: whether a masked material leaves it there.
std::vector<char> are_there(const model::Mesh& mesh, std::span<const motion::SurfacePoint> points) {
    std::vector<char> there(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        there[i] = model::has_surface(mesh, points[i].triangle, points[i].u, points[i].v);
    return there;
}

// What is to be left of candidates for so many points: `per_point` each up to 200,000 points, which then share theirs
// with more until each has six; and enough for a few points too.
std::size_t candidate_count(std::size_t points, std::size_t per_point) {
    constexpr std::size_t most_points = 200000, fewest_per_point = 6, least = 8192;
    return std::max({per_point * std::min(points, most_points), fewest_per_point * points, least});
}

struct VisibleCandidates {
    Candidates candidates;
    std::size_t made = 0;  // hidden ones too, but none where no surface is
    double cell_area = 0;  // that each stands for [units^2]

    double visible_area() const { return cell_area * static_cast<double>(candidates.count); }
};

// One candidate to each of `made` cells of the surface's line, without the hidden ones.
VisibleCandidates make_candidates(const Job& job, std::span<const std::uint32_t> line, std::size_t made,
                                  std::size_t expected, const std::function<void(double)>& progress) {
    VisibleCandidates out{{}, made, job.surface.total_area() / static_cast<double>(made)};
    out.candidates.reserve(expected + expected / 64);
    Stratifier stratifier(job.surface, line, made, job.options.seed);
    while (stratifier.left() > 0) {
        const std::size_t before = out.candidates.count;
        stratifier.append(batch_size, out.candidates);
        if (job.cut != nullptr) {
            const std::size_t appended = out.candidates.count - before;
            out.candidates.keep(before,
                                are_there(*job.cut, std::span(out.candidates.surface).subspan(before, appended)));
            out.made -= appended - (out.candidates.count - before);
        }
        if (job.hidden != nullptr) {
            const std::span<const motion::SurfacePoint> all = out.candidates.surface;
            out.candidates.keep(before, job.hidden->visible(all.subspan(before, out.candidates.count - before)));
        }
        progress(1 - static_cast<double>(stratifier.left()) / static_cast<double>(made));
    }
    return out;
}

// As many visible candidates as are `wanted`, nearly; `least` of them at least.
VisibleCandidates make_visible_candidates(const Job& job, std::size_t wanted, std::size_t least,
                                          const std::function<void(double)>& progress) {
    constexpr std::size_t estimate = 8192;
    const std::vector<std::uint32_t> line = order_along_line(job.surface);
    double share = 1;
    if (job.hidden != nullptr || job.cut != nullptr) {
        const VisibleCandidates some = make_candidates(job, line, estimate, estimate, [](double) {});
        const std::size_t seen = some.candidates.count;
        refuse_the_transparent(some.made, estimate);
        refuse_the_hidden(seen, some.made);
        share = static_cast<double>(seen) / static_cast<double>(estimate);
    }
    VisibleCandidates out;
    do {  // again if the estimate was far off
        const std::size_t made = static_cast<std::size_t>(std::ceil(static_cast<double>(wanted) / share));
        out = make_candidates(job, line, made, wanted, progress);
        share *= 0.5;
    } while (out.candidates.count < least);
    out.candidates.pad();
    return out;
}

// Evenly along the line, so many that measuring coverage is bounded.
Spots spots_of(const VisibleCandidates& from) {
    const std::size_t stride = (from.candidates.count + most_spots - 1) / most_spots;
    Spots spots{{}, from.cell_area * static_cast<double>(stride)};
    for (std::size_t i = 0; i < from.candidates.count; i += stride) spots.places.push_back(from.candidates.surface[i]);
    return spots;
}

// The nearest-neighbour distance of the densest packing of so many points [units].
double densest(double area, std::size_t points) {
    return 2 * std::sqrt(area / (2 * std::numbers::sqrt3 * static_cast<double>(points)));
}

// With `area` [units^2] to cover. What the opening leaves is room for twice as many even points.
std::vector<std::uint32_t> opening_of(const Job& job, const Candidates& candidates, double area) {
    constexpr double even = 0.72;  // of the densest packing's distance
    const double least_apart = even * densest(area, 2 * opening_size) / job.surface.unit();
    return opening(candidates, std::min(job.options.count, opening_size), static_cast<float>(least_apart),
                   job.options.seed);
}

void take(const FarthestOrder& order, const Candidates& candidates, double unit, Draft& draft) {
    for (const std::uint32_t i : order.candidates) draft.points.push_back(candidates.surface[i]);
    for (const float spacing : order.spacing) draft.spacing.push_back(static_cast<float>(unit * spacing));
}

std::size_t hidden_beside(std::size_t points, const VisibleCandidates& from) {
    const double visible = static_cast<double>(from.candidates.count), made = static_cast<double>(from.made);
    return static_cast<std::size_t>(std::llround(static_cast<double>(points) * (made - visible) / visible));
}

Draft progressive(const Job& job) {
    const std::size_t count = job.options.count;
    VisibleCandidates from = make_visible_candidates(job, candidate_count(count, 16), count, job.progress.part(0, 0.3));
    const FarthestOrder order =
        farthest_order(from.candidates, count, opening_of(job, from.candidates, from.visible_area()),
                       coverage_marks(count), job.progress.part(0.3, 0.9));
    Draft draft;
    draft.hidden_removed = hidden_beside(count, from);
    take(order, from.candidates, job.surface.unit(), draft);
    const double between = std::sqrt(0.5 * from.cell_area);
    for (const float radius : order.radius)
        draft.first_radius.push_back(static_cast<float>(job.surface.unit() * radius + between));
    if (job.surface.poses().size() > 1) draft.spots = spots_of(from);
    return draft;
}

Draft even(const Job& job) {
    const std::size_t count = job.options.count;
    VisibleCandidates from = make_visible_candidates(job, candidate_count(count, 24), count, job.progress.part(0, 0.2));
    Candidates& candidates = from.candidates;
    Draft draft;
    draft.hidden_removed = hidden_beside(count, from);
    draft.spots = spots_of(from);

    constexpr double wanted = 0.76;  // of the densest packing's
    const double area = from.visible_area();
    FarthestOrder order =
        farthest_order(candidates, count, opening_of(job, candidates, area), {}, job.progress.part(0.2, 0.4));
    const std::vector<std::uint32_t> points =
        make_even(candidates, std::move(order.candidates),
                  static_cast<float>(wanted * densest(area, count) / job.surface.unit()), job.progress.part(0.4, 0.9));
    // What was moved is in no order any more.
    std::vector<char> kept(candidates.count, 0);
    for (const std::uint32_t point : points) kept[point] = 1;
    candidates.keep(0, kept);
    candidates.pad();
    order = farthest_order(candidates, count, opening_of(job, candidates, area), {});
    take(order, candidates, job.surface.unit(), draft);
    return draft;
}

Draft uniform(const Job& job) {
    constexpr std::size_t fewest_tried = 4096;
    const std::size_t count = job.options.count;
    const AliasTable table(job.surface);
    Draft draft;
    draft.points.reserve(count + batch_size);
    std::size_t tried = 0;
    while (draft.points.size() < count) {
        const std::size_t before = draft.points.size();
        const std::size_t missing = count - before;  // some of what is tried for them will be hidden
        std::size_t batch =
            job.hidden != nullptr ? std::clamp(2 * missing, fewest_tried, batch_size) : std::min(batch_size, missing);
        for (std::size_t i = 0; i < batch; ++i) draft.points.push_back(table.draw(job.options.seed, tried + i));
        tried += batch;
        if (job.cut != nullptr) {
            const std::vector<char> there = are_there(*job.cut, std::span(draft.points).subspan(before));
            std::size_t to = before;
            for (std::size_t i = 0; i < batch; ++i)
                if (there[i]) draft.points[to++] = draft.points[before + i];
            draft.points.resize(to);
            batch = to - before;
            if (tried >= fewest_tried) refuse_the_transparent(to, tried);
        }
        if (job.hidden != nullptr) {
            const std::vector<char> seen = job.hidden->visible(std::span(draft.points).subspan(before));
            std::size_t to = before;
            for (std::size_t i = 0; i < batch && to < count; ++i) {
                if (seen[i])
                    draft.points[to++] = draft.points[before + i];
                else
                    ++draft.hidden_removed;
            }
            draft.points.resize(to);
            if (to < count) refuse_the_hidden(to, tried);
        }
        job.progress(0.9 * static_cast<double>(draft.points.size()) / static_cast<double>(count));
    }
    const VisibleCandidates from =
        make_visible_candidates(job, std::min(candidate_count(count, 16), most_spots), 1, [](double) {});
    draft.spots = spots_of(from);
    draft.spacing.push_back(std::numeric_limits<float>::infinity());
    for (std::size_t i = 1; i < count; ++i)
        draft.spacing.push_back(static_cast<float>(0.5 * std::sqrt(from.visible_area() / static_cast<double>(i))));
    return draft;
}

Draft make_draft(const Job& job) {
    switch (job.options.order) {
        case Order::even:
            return even(job);
        case Order::uniform:
            return uniform(job);
        default:
            return progressive(job);
    }
}

// [units^2] In the first pose, without what masked materials leave out.
double area_of(const Surface& surface, const model::Mesh& mesh) {
    double area = surface.total_first_area();
    if (!model::has_cutouts(mesh)) return area;
    // Finely, but no longer than sampling takes.
    constexpr std::size_t all_places = std::size_t{1} << 24, most_places = 4096;
    const int places = static_cast<int>(std::min(all_places / surface.triangle_count() + 1, most_places));
    for (std::size_t t = 0; t < surface.triangle_count(); ++t)
        area -= surface.first_area(t) * (1 - model::surface_share(mesh, t, places));
    return area;
}

}  // namespace

PointModel sample(const model::Mesh& mesh, std::span<const PosedMesh> poses, const SampleOptions& options,
                  const std::function<void(double)>& report) {
    assert(options.count >= 1 && !poses.empty());
    Progress progress(report);
    const Surface surface(mesh.indices, poses);
    std::optional<HiddenTest> hidden;
    if (options.visible_only) hidden.emplace(surface, mesh);
    Draft draft = make_draft(
        {surface, options, hidden ? &*hidden : nullptr, model::has_cutouts(mesh) ? &mesh : nullptr, progress});
    hidden.reset();  // frees the ray-tracing scenes

    PointModel model;
    model.origin = mesh.origin;
    model.area = static_cast<float>(area_of(surface, mesh));
    model.hidden_removed = draft.hidden_removed;
    model.surface = std::move(draft.points);
    model.spacing = std::move(draft.spacing);
    describe(mesh, surface.poses().front(), model);
    model.coverage =
        measure_coverage(surface, draft.spots, model.surface, coverage_marks(options.count), draft.first_radius);
    if (report) report(1.0);
    return model;
}

}  // namespace pointsample
