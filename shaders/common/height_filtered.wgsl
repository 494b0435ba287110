// Height samples by the hardware's bilinear filter, where the adapter filters r32float: [POM] §3.1 relies on it, and on no more
// than its 8 bits of fraction.

fn sample_height(lattice: vec2f) -> f32 {
    return textureSampleLevel(height, bilinear, uv_of(lattice), 0.0).r;
}
