// The sky: haze at the horizon, its colour above, and the sun.
in vec2 screen;
out vec4 color;

const float sun_rim = 0.9996;  // cosine of the sun's drawn radius, 1.6 degrees: with its glare

void main() {
    vec3 ray = normalize(Frame.view_forward.xyz + screen.x * Frame.view_right.xyz + screen.y * Frame.view_up.xyz);
    vec3 sky = mix(Frame.sky_haze.rgb, Frame.sky_zenith.rgb, sqrt(max(ray.y, 0.0)));
    float sun = max(dot(ray, Frame.sun_direction.xyz), 0.0);
    float glow = 0.35 * pow(sun, 64.0) + (sun > sun_rim ? 1.0 : 0.0);
    color = vec4(sky + glow * Frame.sky_glare.rgb, 1.0);
}
