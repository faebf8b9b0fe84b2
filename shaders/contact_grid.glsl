// How much all feet that are near leave of a colour. They are found by the cell of a grid that a place is in.
#include "contact.glsl"

struct Feet {
    vec4 at;    // camera-relative [m]; w: peak
    vec4 fall;  // x
};
layout(std430, binding = contact_feet_binding) readonly buffer ContactFeet { Feet contact_feet[]; };
// Of each cell the first, then the total.
layout(std430, binding = contact_cells_binding) readonly buffer ContactCells { uint first_feet[]; };

// Camera-relative [m].
float left_at(vec3 at) {
    vec2 cell = floor((at.xz - ContactGrid.corner_and_scale.xy) * ContactGrid.corner_and_scale.z);
    vec2 size = ContactGrid.size.xy;
    if (any(lessThan(cell, vec2(0.0))) || any(greaterThanEqual(cell, size))) return 1.0;
    int index = int(cell.y) * int(size.x) + int(cell.x);
    float left = 1.0;
    for (uint i = first_feet[index]; i < first_feet[index + 1]; ++i)
        left *= left_by(at - contact_feet[i].at.xyz, contact_feet[i].at.w, contact_feet[i].fall.x);
    return left;
}
