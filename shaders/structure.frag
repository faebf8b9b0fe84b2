// What stands in a place: the vertices' colour.
flat in vec3 surface_color;
out vec4 color;

void main() { color = vec4(surface_color, 1.0); }
