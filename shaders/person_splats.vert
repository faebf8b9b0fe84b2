// A very far person as one splat: as large as their silhouette, of its mean light. figures/splats.h says what that is;
// render/native/far_people.cpp does the same.
layout(location = attribute_far_center) in vec4 center;  // from the block's origin [m]; w: side of a square as large as the surface [m]
layout(location = attribute_far_turn) in vec2 turn;      // sin, cos of the yaw
layout(location = attribute_far_character) in uint character;
layout(location = attribute_far_palette) in vec4 palette[slot_count];
layout(location = attribute_far_key) in uint key;
layout(location = uniform_far_eye) uniform vec3 eye;     // the camera [m], from there as well
// By character: across, the nodes of a ring for each azimuth of the sun, for each slot; down, the rings for each key.
// Of a slot the light where its own colour is white; the fourth values are those of no slot, and the silhouette in
// shares of the surface.
layout(binding = texture_unit_looks) uniform sampler2DArray looks;
flat out vec3 splat_color;

// An angle in [0, 4] of (x, z), as render/native/directions.h has it.
float diamond(vec2 v) {
    float along = v.x / max(abs(v.x) + abs(v.y), 1e-30);
    if (v.y < 0.0) return 2.0 - along;
    return v.x < 0.0 ? 4.0 + along : along;
}

vec2 unturned(vec3 v) { return vec2(turn.y * v.x - turn.x * v.z, turn.y * v.z + turn.x * v.x); }

void main() {
    vec3 position = center.xyz - eye;
    gl_Position = Frame.clip_from_camera_relative * vec4(position, 1.0);
    gl_Position.xy *= Frame.splat.zw;
    vec3 to_eye = -position;
    float up = to_eye.y / (abs(to_eye.y) + length(to_eye.xz));
    vec2 at = vec2(diamond(unturned(to_eye)) * 0.25 * far_nodes, (up + 1.0) * 0.5 * (far_rings - 1.0));
    float sun = min(diamond(unturned(Frame.sun_direction.xyz)) * 0.25 * far_suns, far_suns - 0.001);
    vec2 texel = vec2(at.x + 0.5, float(key) * far_rings + at.y + 0.5);
    const float across = far_nodes + 1.0;
    vec2 size = vec2(textureSize(looks, 0).xy);
    vec3 light = vec3(0.0), untinted = vec3(0.0);
    float silhouette = 0.0;
    for (int slot = 0; slot < slot_count; ++slot) {
        vec4 seen = vec4(0.0);
        for (int side = 0; side < 2; ++side) {
            float azimuth = mod(floor(sun) + float(side), far_suns);
            vec2 from = texel + vec2((float(slot) * far_suns + azimuth) * across, 0.0);
            float share = side == 0 ? 1.0 - fract(sun) : fract(sun);
            seen += share * textureLod(looks, vec3(from / size, float(character)), 0.0);
        }
        light += palette[slot].rgb * palette[slot].rgb * seen.rgb;
        if (slot < 3) untinted[slot] = seen.w;
        else silhouette = seen.w;
    }
    float pixels = center.w * Frame.splat.y / gl_Position.w;
    // Off the picture's middle a silhouette's image is larger, as it is cast aslant.
    float area = silhouette * pixels * pixels * length(position) / gl_Position.w;
    gl_PointSize = max(sqrt(area), 1.0);
    // Who covers a part of a pixel is seen with that chance, always the same of a person.
    uint bits = uint(gl_VertexID) * 2654435769u;
    bits = (bits ^ bits >> 15) * 2246822519u;
    if (float((bits ^ bits >> 13) >> 8) > area * 16777216.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    splat_color = sqrt(light + untinted);
}
