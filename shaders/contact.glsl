// Around the feet of who stands it is darker. Shared with C++; render/contact_shade.h tells what its numbers are.

// How much is left of a colour as it is stored, `from_feet` [m] away from them.
real left_by(vec3 from_feet, real peak, real fall) {
    real dark = max(peak - fall * dot(from_feet, from_feet), 0.0f);
    return 1.0f - dark * dark;
}
