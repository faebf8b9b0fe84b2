// Who is drawn alone in a frame: a rule that draws nothing well and notes whom it was asked about.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "tests/bench/front/rivals/rival.h"

namespace bench::front {

class Roll final : public render::DrawingRule {
public:
    // Of those whom the rival doesn't draw with their block. It must outlive this.
    explicit Roll(const Rival& rival) : rival_(rival) {}

    Shape shape_of(const render::Subject& subject) const override {
        people_.local().push_back(subject);
        return {};
    }
    bool is_splat(const render::Subject& subject) const override { return rival_.is_splat(subject); }
    int period_of(const render::Subject&) const override { return 1; }
    double splat_size() const override { return 1; }

    // In any order.
    std::vector<render::Subject> people() const {
        std::vector<render::Subject> all;
        for (const auto& some : people_) all.insert(all.end(), some.begin(), some.end());
        return all;
    }

private:
    const Rival& rival_;
    mutable tbb::enumerable_thread_specific<std::vector<render::Subject>> people_;
};

}  // namespace bench::front
