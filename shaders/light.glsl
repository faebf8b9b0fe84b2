// Daylight: the sun, and what comes from above and below, of which `open` gets there. Shared with C++.
vec3 lit(vec3 normal, real open) {
    vec3 surroundings = mix(vec3(Frame.ground_light), vec3(Frame.sky_light), 0.5f + 0.5f * normal.y);
    return surroundings * open + vec3(Frame.sun_color) * max(dot(normal, vec3(Frame.sun_direction)), 0.0f);
}
vec3 lit(vec3 normal) { return lit(normal, 1.0f); }
