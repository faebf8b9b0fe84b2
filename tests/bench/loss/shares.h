// How much is expected to show of whom a frame draws: as render/select.cpp counts it.
#pragma once

#include <vector>

#include "apps/stage.h"
#include "render/frame.h"

namespace bench::loss {

// Of each block of the crowd: of each of its people that others leave to be seen.
std::vector<float> visible_shares(const apps::Stage& stage, const render::View& view);

// [px] Of somebody whose silhouette is a quarter of their surface.
double shown_of(const render::Person& person, const apps::Stage& stage, const render::View& view, float share);

}  // namespace bench::loss
