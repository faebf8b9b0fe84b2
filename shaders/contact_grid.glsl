// How much all feet that are near leave of a colour. They are found by the cell of a grid that a place is in.
#include "contact.glsl"

struct Feet {
    float x, y, z;  // camera-relative [m]
    float radius, peak, fall;
};
layout(std430, binding = contact_feet_binding) readonly buffer ContactFeet { Feet contact_feet[]; };
// Of each cell the first of its numbers, then of how many there are; and the numbers.
layout(std430, binding = contact_cells_binding) readonly buffer ContactCells { uint first_number[]; };
layout(std430, binding = contact_numbers_binding) readonly buffer ContactNumbers { uint feet_numbers[]; };

// Camera-relative [m].
float left_at(vec3 at) {
    vec2 cell = floor((at.xz - ContactGrid.corner_and_scale.xy) * ContactGrid.corner_and_scale.z);
    vec2 size = ContactGrid.size.xy;
    if (any(lessThan(cell, vec2(0.0))) || any(greaterThanEqual(cell, size))) return 1.0;
    int index = int(cell.y) * int(size.x) + int(cell.x);
    float left = 1.0;
    for (uint i = first_number[index]; i < first_number[index + 1]; ++i) {
        Feet feet = contact_feet[feet_numbers[i]];
        left *= left_by(at - vec3(feet.x, feet.y, feet.z), feet.peak, feet.fall);
    }
    return left;
}
