// Rules that other renderers draw crowds by, in the seat of ours: the same survey, the same renderer, the same pieces
// that people are drawn as. Only who gets how many points is theirs.
#pragma once

#include <span>
#include <vector>

#include "figures/choices.h"
#include "render/drawing_rule.h"

namespace bench::front {

// By character: all that its people can be drawn as natively.
using Cast = std::vector<figures::Choices>;
Cast cast_of(std::span<const figures::Figure> figures);

class Rival : public render::DrawingRule {
public:
    explicit Rival(Cast cast) : cast_(std::move(cast)) {}

    // What holds until the next time. `people`: all who are drawn alone in a frame, in any order (roll.h).
    void settle(std::vector<render::Subject> people);

    // Of somebody so large: as many points, or infinitely many, which is their mesh.
    virtual float points_of(const render::Subject& subject) const = 0;

    Shape shape_of(const render::Subject& subject) const final;
    // As S = 1 px would.
    bool is_splat(const render::Subject& subject) const override;
    int period_of(const render::Subject&) const final { return 1; }
    // Cells of a pixel, unless people's points are so far apart that they would leave holes.
    double splat_size() const final { return splat_size_; }

protected:
    // The most that anybody gets: points half a pixel apart, or their mesh where that is believed to cost less.
    struct Detail {
        double points = 0;  // of a mesh, as many as are believed to cost what it does
        bool is_mesh = false;
    };
    Detail full_of(const render::Subject& subject) const;
    // At least as much for everybody.
    static double least_of(const Detail& full);

    const figures::Choices& choices_of(const render::Subject& subject) const { return cast_[subject.character]; }

private:
    // People are in order of their surface, the smallest first.
    virtual void decide(std::span<const render::Subject> people) = 0;

    Cast cast_;
    double splat_size_ = 1;
};

}  // namespace bench::front
