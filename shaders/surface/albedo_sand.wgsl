// Sand: pale and warm where the wind winnows it, darker where heavier grains stay in the lee and in the troughs of ripples.

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let grain = noise_over(metres, 420.0, 91u);
    let drift = noise_over(metres, 5.0, 95u);
    let high = smoothstep(0.05, 0.75, point.height + 0.25 * (drift - 0.5));
    let level = smoothstep(0.70, 0.98, point.level);
    let dark = vec3f(0.43, 0.235, 0.115);
    let pale = vec3f(0.82, 0.55, 0.315);
    let colour = mix(dark, pale, mix(high, level, 0.35)) * mix(0.86, 1.10, grain);
    return sooty(mix(colour, vec3f(0.86, 0.66, 0.44), 0.6 * stamped.g), stamped.r);
}
