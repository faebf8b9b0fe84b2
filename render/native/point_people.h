// People who are drawn as points: each made ready once a frame, then drawn tile by tile.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/frame.h"
#include "render/native/gains.h"
#include "render/native/splat.h"
#include "render/native/splat_model.h"
#include "scene/light.h"

namespace render::native {

class PointPeople {
public:
    // `figures` must outlive it. A character's model is made when somebody of it is first drawn.
    PointPeople(std::span<const figures::Figure> figures, const scene::Light& light);

    // Of one frame; `splat_size` S > 0 [px]. Their characters' models have been made. Parallel.
    void prepare(const View& view, double splat_size, std::span<const Person* const> people);

    // Of a character; made now, if it isn't yet.
    const SplatModel& model(std::uint32_t character) {
        if (!kinds_[character]) make_kind(character);
        return kinds_[character]->model;
    }
    float cell() const { return cell_; }  // [px] the side of everybody's cells
    std::span<const SplatPerson> people() const { return people_; }
    std::span<const Rect> bounds() const { return bounds_; }  // [px] that each of them may touch
    float reach_of(const Person& person) const;               // [m] from the middle of anybody's box
    const SplatLight& light() const { return light_; }

private:
    // A character's model, and what its points' areas are multiplied by.
    struct Kind {
        Kind(const figures::Figure& figure, const scene::Light& light) : model(figure, light) {}
        SplatModel model;
        Gains gains;
    };

    void make_kind(std::uint32_t character);
    Gains::Trial draw_alone(std::uint32_t character, float cells, float alike, int trial, PatchRoom& room) const;
    void ready(const View& view, const Person& person, float cell, SplatPerson& out) const;

    std::vector<figures::Figure> figures_;
    std::vector<std::unique_ptr<Kind>> kinds_;  // by character; null: not needed yet
    scene::Light daylight_;
    SplatLight light_;
    float cell_ = 1.0f;
    std::vector<SplatPerson> people_;
    std::vector<Rect> bounds_;
};

}  // namespace render::native
