// Height samples by four loads, where the adapter cannot filter r32float.

fn sample_height(lattice: vec2f) -> f32 {
    return load_surface(lattice);
}
