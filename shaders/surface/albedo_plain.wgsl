// Plain: one material, like unglazed clay: paler where it is level, a little darker where it is steep or deep.

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let grain = fractal_noise(plane_metres(point.lattice) * 90.0, 3u);
    let level = smoothstep(0.35, 0.95, point.normal_world.y);
    let deep = mix(0.72, 1.0, smoothstep(0.0, 0.9, point.height));
    let clay = mix(vec3f(0.40, 0.235, 0.155), vec3f(0.66, 0.56, 0.46), level) * deep * mix(0.88, 1.08, grain);
    return sooty(mix(clay, vec3f(0.74, 0.69, 0.62), 0.7 * stamped.g), stamped.r);
}
