// A clear afternoon: horizon haze to blue, and the sun.
in vec2 screen;
out vec4 color;

void main() {
    vec3 ray = normalize(Frame.view_forward.xyz + screen.x * Frame.view_right.xyz + screen.y * Frame.view_up.xyz);
    float height = max(ray.y, 0.0);
    vec3 sky = mix(vec3(0.62, 0.76, 0.88), vec3(0.13, 0.31, 0.63), sqrt(height));
    float sun = max(dot(ray, Frame.sun_direction.xyz), 0.0);
    float glow = pow(sun, 64.0) * 0.35 + (sun > 0.9996 ? 1.0 : 0.0);
    color = vec4(sky + glow * vec3(1.0, 0.93, 0.75), 1.0);
}
