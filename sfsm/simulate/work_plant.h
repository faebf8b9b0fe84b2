// A renderer that can say what it will draw. A frame costs prices times counts of work, as in the real one. A law is
// told the counts of every candidate beforehand, but not the prices.
#pragma once

#include <functional>
#include <vector>

#include "sfsm/prices.h"
#include "sfsm/simulate/plant.h"

namespace sfsm::simulate {

// Counts foreseen, in shares of those drawn; 1: an honest forecast.
struct Foresight {
    double person = 1, triangle = 1, point = 1, update = 1;
};

// What the camera sees. The share of people nearer than x L is x^farness: a crowd on the far stands has a large
// farness. People beyond D are all taken to be about L away, where equation 1 gives f = 1 + theta (L - D).
struct View {
    double people = 0;
    double range = 300;            // L [m]
    double farness = 2;            // > 0
    double theta = 0.1;            // [1/m] of equation 1
    double triangles_each = 1000;  // of a person
    double points_each = 1500;     // of a person at S = 1 px; in proportion to 1 / S
    double surface_px = 0.05;      // how far a moving person's surface gets in a frame [px]
    Foresight foresight = {};
};

// What views and prices don't say.
struct Unforeseen {
    OverFrames load = {};         // multiplies all prices; empty: 1
    OverFrames unpriced_ms = {};  // on top, of no kind of work; empty: 0
    bool is_silent = false;       // work is counted, but there is no forecast
};

// Half way from one view to another at 0.5. `share` in [0, 1].
View between(const View& from, const View& to, double share);

// Loss [px] of a decision: poses are half a period old on average, outlines half a splat off; the two add up. Detail is
// 1 / (1 + loss): 1 where nothing is lost, a half where a pixel is.
class WorkPlant final : public Plant {
public:
    using ViewAt = std::function<std::size_t(std::int64_t frame)>;  // an index into `views`

    WorkPlant(const Prices& prices, std::vector<View> views, ViewAt view_at, Unforeseen unforeseen = {});

    double range(std::int64_t frame) const override;
    const Forecast* forecast(std::int64_t frame) const override;
    double cost_ms(std::int64_t frame, const Decision& decision) const override;
    Work work(std::int64_t frame, const Decision& decision) const override;
    double detail(std::int64_t frame, const Decision& decision) const override;
    Decision optimum(std::int64_t frame, double limit_ms) const override;

private:
    struct Tables {
        std::vector<Step> motion, shapes;
        Forecast forecast;
    };

    static Tables tables_of(const View& view);
    const View& view(std::int64_t frame) const { return views_[view_at_(frame)]; }
    double load(std::int64_t frame) const { return unforeseen_.load ? unforeseen_.load(frame) : 1.0; }
    double unpriced_ms(std::int64_t frame) const {
        return unforeseen_.unpriced_ms ? unforeseen_.unpriced_ms(frame) : 0.0;
    }

    Prices prices_;
    std::vector<View> views_;
    std::vector<Tables> tables_;  // of each view
    ViewAt view_at_;
    Unforeseen unforeseen_;
};

}  // namespace sfsm::simulate
