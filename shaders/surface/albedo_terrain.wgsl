// Terrain: meadows in the valley, woods above them, rock where it is steep, scree below it, snow where it is high and lies. Made for
// the base `landscape`, and for whatever else looks like one.

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    // In widths of the plane: another plane is the same land, larger.
    let place = uv_of(point.lattice) * vec2f(1.0, view.plane_size_metres.y / view.plane_size_metres.x);
    let per_width = 1.0 / view.plane_size_metres.x;
    let metres = plane_metres(point.lattice);
    let fine = noise_over(metres, 210.0 * per_width, 91u);
    let patch_noise = noise_over(metres, 31.0 * per_width, 95u);
    let broad = noise_over(metres, 7.0 * per_width, 99u);
    // Climate is ragged.
    let altitude = point.height + 0.10 * (patch_noise - 0.5) + 0.05 * (fine - 0.5);

    let meadow = mix(vec3f(0.115, 0.150, 0.035), vec3f(0.225, 0.215, 0.070), patch_noise) * mix(0.75, 1.15, fine);
    let wood = mix(vec3f(0.022, 0.050, 0.018), vec3f(0.050, 0.085, 0.028), fine) * mix(0.8, 1.1, broad);
    let heath = mix(vec3f(0.165, 0.130, 0.070), vec3f(0.215, 0.180, 0.105), patch_noise) * mix(0.8, 1.1, fine);
    // Strata, tilted a little.
    let layers = fractal_noise(vec2f(point.height * 42.0 + 2.0 * place.x, 3.0 * broad), 103u);
    let rock = mix(vec3f(0.155, 0.140, 0.125), vec3f(0.330, 0.300, 0.265), layers) * mix(0.72, 1.15, fine);
    let scree = vec3f(0.270, 0.250, 0.225) * mix(0.8, 1.1, fine);
    let snow = vec3f(0.86, 0.89, 0.94);

    var ground = mix(meadow, wood, smoothstep(0.11, 0.17, altitude) * smoothstep(0.30, 0.55, broad + 0.5 * patch_noise));
    ground = mix(ground, heath, smoothstep(0.30, 0.40, altitude));
    ground = mix(ground, scree, smoothstep(0.48, 0.60, altitude));
    let steep = 1.0 - smoothstep(0.52, 0.76, point.level + 0.12 * (fine - 0.5));
    ground = mix(ground, rock, steep);
    let lies = smoothstep(0.48, 0.72, point.level + 0.20 * (altitude - 0.5));
    let snowy = smoothstep(0.50, 0.62, altitude) * lies;
    // The sea is level; where land is near it is shallow, and a beach lies above it.
    let wet = (1.0 - smoothstep(0.0502, 0.0515, point.height)) * step(0.9995, point.level);
    let beach = 1.0 - smoothstep(0.056, 0.072, point.height + 0.01 * (fine - 0.5));
    ground = mix(ground, vec3f(0.34, 0.29, 0.20) * mix(0.85, 1.1, fine), beach * smoothstep(0.7, 0.9, point.level));
    if wet > 0.0 {
        let near = 0.011 * f32(view.field_size.x);
        let around = sample_height(point.lattice + vec2f(near, 0.0)) + sample_height(point.lattice - vec2f(near, 0.0))
            + sample_height(point.lattice + vec2f(0.0, near)) + sample_height(point.lattice - vec2f(0.0, near));
        let shallow = smoothstep(0.0, 0.05, 0.25 * around - point.height + 0.008 * (patch_noise - 0.5));
        ground = mix(ground, mix(vec3f(0.012, 0.040, 0.065), vec3f(0.045, 0.165, 0.165), shallow), wet);
    }
    let bare = mix(mix(ground, snow, snowy), vec3f(0.30, 0.26, 0.21), 0.7 * stamped.g);
    var matter = sooty(bare, stamped.r);
    // Snow and water glisten, meadows do not.
    matter.specular *= mix(mix(0.12, 0.5, snowy), 1.0, wet);
    // Water mirrors the sky, the more the flatter one looks at it.
    let seen = max(dot(point.normal_world, point.toward_eye), 0.02);
    matter.glow = vec3f(wet * (0.02 + 0.98 * pow(1.0 - seen, 5.0)) * (1.0 - stamped.r)) * 1.25 * view.sky;
    return matter;
}
