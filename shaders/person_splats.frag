flat in vec3 splat_color;
out vec4 color;

void main() { color = vec4(splat_color, 1.0); }
