// A point of the front: a crowd in a view, drawn in a setting.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "tests/bench/front/judge.h"
#include "tests/bench/front/offsets.h"
#include "tests/bench/front/row.h"
#include "tests/bench/front/settings.h"
#include "tests/bench/front/venue.h"
#include "tests/bench/front/views.h"

namespace bench::front {

// Until which frames are timed: whatever comes first.
struct Effort {
    int most_frames = 0;  // beside the one whose picture is judged, which is the first that is timed
    double most_ms = 0;   // of these together
};
inline constexpr Effort usual_effort{40, 200};

// A view of a crowd, with all of it that serves every setting.
class Sight {
public:
    // References are drawn, if they weren't. `venue` must outlive it.
    Sight(Venue& venue, const Shot& shot, References& references);

    Venue& venue() const { return venue_; }
    const Shot& shot() const { return shot_; }
    const Judge& judge() const { return judge_; }
    // In pictures so many times as large. Found when first asked for.
    const Present& present(sfsm::Drawing drawing, int factor) const;

private:
    Venue& venue_;
    Shot shot_;
    Judge judge_;
    mutable std::map<std::pair<sfsm::Drawing, int>, Present> present_;
};

struct Measured {
    Row row;
    render::Image picture;  // of the shot's `now`
};

// Draws the frame before and the frame, and judges them; then times that frame and some more, of a camera that is
// nudged by a millimetre a frame so that nothing of a frame is kept. All but the times is the same in every run. Of a
// row the law and its target are left empty. `decision`: instead of the setting's own.
Measured measure(const Sight& sight, const Setting& setting, Effort effort,
                 const std::optional<sfsm::Decision>& decision = {});

}  // namespace bench::front
