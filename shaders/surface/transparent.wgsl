// What water and glass share: what they mirror, where the view goes on beneath, and how the relief gathers light.
//
// Needs surface/sky, surface/matter and a height part.

// Share of the light that a surface of this index of refraction mirrors (Schlick).
fn transparent_mirror(index: f32, cosine: f32) -> f32 {
    let head_on = (index - 1.0) * (index - 1.0) / ((index + 1.0) * (index + 1.0));
    return head_on + (1.0 - head_on) * pow(1.0 - cosine, 5.0);
}

// Where the view is reflected to. What would go into the relief is seen as if by its next slope: upward.
fn transparent_reflected(point: SurfacePoint) -> vec3f {
    let reflected = reflect(-point.toward_eye, point.normal_world);
    let up = frame_normal(point.lattice);
    return reflected + max(-2.0 * dot(reflected, up), 0.0) * up;
}

// What it mirrors.
fn transparent_mirrored(point: SurfacePoint) -> vec3f {
    let reflected = transparent_reflected(point);
    return sky(reflected) + sky_suns(reflected);
}

// Light that arrives on a floor `below_metres` under a lattice position, over what would arrive through a level surface: a
// crest gathers it, a trough spreads it (paraxial: the floor's image of a small patch shrinks by
// 1 − distance · (1 − 1 / index) · curvature).
fn transparent_caustic(lattice: vec2f, below_metres: f32, index: f32) -> f32 {
    let spread = 3.0;
    let here = load_surface(lattice);
    let around = sample_height(lattice + vec2f(spread, 0.0)) + sample_height(lattice - vec2f(spread, 0.0))
        + sample_height(lattice + vec2f(0.0, spread)) + sample_height(lattice - vec2f(0.0, spread));
    let texels = spread * view.texel_metres;
    let curvature = (around - 4.0 * here) * view.depth_metres / (texels * texels);
    return clamp(1.0 / max(1.0 + (1.0 - 1.0 / index) * below_metres * curvature, 0.22), 0.45, 2.6);
}
