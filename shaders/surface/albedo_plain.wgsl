// Plain: one material, like unglazed clay: paler where it is level, a little darker where it is steep or deep.

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let grain = noise_over(plane_metres(point.lattice), 90.0, 3u);
    let level = smoothstep(0.45, 0.92, point.level);
    let deep = mix(0.62, 1.0, smoothstep(0.0, 0.55, point.height));
    let clay = mix(vec3f(0.36, 0.225, 0.150), vec3f(0.60, 0.51, 0.41), level) * deep * mix(0.90, 1.08, grain);
    return sooty(mix(clay, vec3f(0.70, 0.66, 0.60), 0.7 * stamped.g), stamped.r);
}
