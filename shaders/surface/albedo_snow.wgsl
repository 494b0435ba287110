// Snow: white where light falls, blue in the hollows, packed and a little grey where something stood, grains that sparkle.

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let grain = noise_over(metres, 420.0, 3u);
    let drift = noise_over(metres, 6.0, 5u);
    // Snow swallows red first: what light has gone deep is blue.
    let deep = smoothstep(0.35, 0.95, point.height);
    let fresh = mix(vec3f(0.72, 0.80, 0.92), vec3f(0.93, 0.945, 0.96), deep) * mix(0.96, 1.02, grain) * mix(0.97, 1.01, drift);
    let packed = vec3f(0.70, 0.775, 0.86) * mix(0.93, 1.03, grain);
    var matter = sooty(mix(fresh, packed, saturate(1.2 * stamped.a)), stamped.r);

    // One crystal in a few hundred faces the eye as it faces the light; from afar they are a sheen.
    let seen = footprint_metres() / 0.004;
    let apart = detail_left(seen);
    if apart > 0.0 && point.visibility > 0.0 {
        let cell = vec2i(floor(metres / 0.004));
        let tilt = vec3f(hash_cell(cell, 31u), hash_cell(cell, 32u), hash_cell(cell, 33u)) - 0.5;
        let facet = normalize(point.normal_world + 1.6 * tilt);
        let halfway = normalize(point.toward_eye + view.light_world);
        let spark = smoothstep(0.990, 0.999, dot(facet, halfway));
        matter.glow = 1.6 * apart * spark * (1.0 - stamped.a) * point.visibility * view.light_radiance;
    }
    return matter;
}
