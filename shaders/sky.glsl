// The sky: haze at the horizon, its colour above, and the sun. Shared with C++.
const float sun_glow = 0.85f;   // of what glows around it, which is a hundred-thousandth there
const float sun_rim = 0.9996f;  // cosine of the sun's drawn radius, 1.6 degrees: with its glare

// sRGB where the view's right and upper edges are at 1.
vec3 sky_at(vec2 screen) {
    vec3 ray = normalize(vec3(Frame.view_forward) + screen.x * vec3(Frame.view_right) + screen.y * vec3(Frame.view_up));
    vec3 sky = mix(vec3(Frame.sky_haze), vec3(Frame.sky_zenith), sqrt(max(ray.y, 0.0f)));
    real sun = max(dot(ray, vec3(Frame.sun_direction)), 0.0f);
    if (!somewhere(sun > sun_glow)) return sky;
    real glow = 0.35f * pow(sun, 64.0f) + select(sun > sun_rim, 1.0f, 0.0f);
    return sky + select(sun > sun_glow, glow, 0.0f) * vec3(Frame.sky_glare);
}
