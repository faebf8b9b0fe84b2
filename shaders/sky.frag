#include "sky.glsl"
in vec2 screen;
out vec4 color;

void main() { color = vec4(sky_at(screen), 1.0); }
