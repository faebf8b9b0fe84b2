// The colour of what stands for a part of a person: its own, by shares in the slots of the person's palette.
layout(location = attribute_shares) in vec4 shares[slot_vectors];

float share_of(int slot) { return shares[(slot - 1) / 4][(slot - 1) % 4]; }

// What the person's own palette makes of its colour.
vec3 tint() {
    float untinted = 1.0;
    for (int i = 0; i < slot_vectors; ++i) untinted -= dot(shares[i], vec4(1.0));
    vec3 sum = vec3(untinted);
    for (int slot = 1; slot <= slot_count; ++slot) sum += share_of(slot) * palette_color(slot);
    return sum;
}
