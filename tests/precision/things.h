// What else is drawn: what stands in a place, and people so far away that each is one splat.
#pragma once

#include "tests/precision/setting.h"

namespace precision {

// Where corners of a structure fall in the native picture that lie within `spread` [m] of its origin, which is the
// setting's.
Errors errors_of_structure(const Setting& setting, double spread = 30);

// People a little over a pixel tall, natively, or two metres away: how far the middle of what they cover is off [px],
// times what they cover, and how much that is off [px^2] from what is in proportion to the square of their height.
struct CoverageErrors {
    Errors middle, area;
};
CoverageErrors errors_of_coverage(const Setting& setting);

// [px^2] That a person covers who is so high [px] in an 8K picture; the truth is in proportion to the square.
double area_of_person(double height_px);

// [m] View depth from which on two people half a metre apart aren't told apart any more, by doubling:
double depth_limit_of_frame();   // in Person::depth
double depth_limit_of_buffer();  // in float32 near / depth, as depth buffers have it
double depth_limit_of_sort();    // by the native order, of people who are drawn one by one

}  // namespace precision
