// Daylight, for vertex shaders: the sun, and what comes from above and below.
vec3 lit(vec3 normal) {
    vec3 surroundings = mix(Frame.ground_light.rgb, Frame.sky_light.rgb, 0.5 + 0.5 * normal.y);
    return surroundings + Frame.sun_color.rgb * max(dot(normal, Frame.sun_direction.xyz), 0.0);
}
