// Grass: blades of several greens over earth, dark at the roots, and daisies.
//
// What lies deep is shadowed by what stands around it: [Steep] takes it to be as dark as it is deep. The daisies' layout is that
// of the base `grass` (src/field/base/strands.rs).

override DAISY_CELL: f32; // metres, the side of the cells that hold at most one each

// How dark the roots are.
const GRASS_ROOT: f32 = 0.12;

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let patch_noise = noise_over(metres, 11.0, 121u);
    let blade = value_noise(metres * 420.0, 122u);
    let green = mix(vec3f(0.090, 0.215, 0.030), vec3f(0.245, 0.400, 0.070), patch_noise);
    let dry = vec3f(0.46, 0.42, 0.16);
    let tip = smoothstep(0.45, 0.95, point.height);
    let leaf = mix(green * mix(0.75, 1.25, blade), dry, 0.35 * tip * smoothstep(0.62, 0.9, blade));
    let earth = vec3f(0.10, 0.070, 0.045);
    let ground = mix(earth, leaf, smoothstep(0.05, 0.22, point.height));
    let deep = mix(GRASS_ROOT, 1.0, smoothstep(0.06, 0.78, point.height));
    var colour = ground * deep * mix(0.95, 1.3, tip);

    let at = metres / DAISY_CELL;
    let cell = vec2i(floor(at));
    let radius = 0.0065 + 0.0030 * hash_cell(cell, 104u);
    let top = 0.82 + 0.10 * hash_cell(cell, 105u);
    let centre = 0.2 + 0.6 * vec2f(hash_cell(cell, 102u), hash_cell(cell, 103u));
    let from_centre = length(fract(at) - centre) * DAISY_CELL / radius;
    if hash_cell(cell, 101u) < 0.4 && from_centre < 1.02 {
        let petal = mix(vec3f(0.86, 0.84, 0.80), vec3f(0.80, 0.66, 0.70), smoothstep(0.75, 1.0, from_centre));
        let head = mix(vec3f(0.86, 0.56, 0.05), petal, smoothstep(0.28, 0.36, from_centre));
        // A height field has no stalk: below the petals the column under the head is as dark as the grass that would hide it.
        let below = green * 0.45 * deep;
        colour = mix(below, head, smoothstep(top - 0.17, top - 0.13, point.height));
    }
    return sooty(colour, stamped.r);
}
