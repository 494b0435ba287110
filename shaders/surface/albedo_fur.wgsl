// Fur: a leopard's coat, golden with broken rosettes, dark at the roots.
//
// What lies deep is shadowed by what stands around it: [Steep] takes it to be as dark as it is deep, and casts no shadow ray.

// How dark the roots are.
const FUR_ROOT: f32 = 0.06;

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    // Hairs carry the pattern of their roots: its borders are ragged by a hair's length.
    let ragged = vec2f(value_noise(metres * 1400.0, 111u), value_noise(metres * 1400.0, 112u)) - 0.5;
    let place = metres / 0.034 + 0.10 * ragged + 0.28 * (vec2f(value_noise(metres * 40.0, 113u), value_noise(metres * 40.0, 114u)) - 0.5);
    let home = vec2i(floor(place));
    var nearest = 1e9;
    var rosette = vec2i(0);
    var toward = vec2f(0.0);
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let cell = home + vec2i(x, y);
            let centre = vec2f(cell) + 0.5 + 0.45 * (vec2f(hash_cell(cell, 115u), hash_cell(cell, 116u)) - 0.5);
            let away = place - centre;
            if length(away) < nearest {
                nearest = length(away);
                rosette = cell;
                toward = away;
            }
        }
    }
    // A ring with gaps, around a darker gold.
    let size = mix(0.75, 1.1, hash_cell(rosette, 117u));
    let ring = smoothstep(0.17, 0.24, nearest / size) * (1.0 - smoothstep(0.34, 0.42, nearest / size));
    let broken = smoothstep(0.28, 0.44, value_noise(toward * 5.5 + 31.0 * vec2f(rosette), 118u));
    let hue = noise_over(metres, 26.0, 119u);
    let hair = value_noise(metres * 1900.0, 123u);
    let gold = mix(vec3f(0.62, 0.37, 0.13), vec3f(0.86, 0.68, 0.42), hue);
    let inner = mix(gold * vec3f(0.72, 0.60, 0.48), gold, smoothstep(0.16, 0.30, nearest / size));
    let coat = mix(inner, vec3f(0.035, 0.022, 0.014), 0.95 * ring * broken);
    // Tips are paler than what they grow from.
    let tip = smoothstep(0.45, 0.95, point.height);
    let deep = mix(FUR_ROOT, 1.0, smoothstep(0.24, 0.86, point.height));
    return sooty(coat * deep * mix(0.80, 1.15, hair) * mix(0.95, 1.20, tip), stamped.r);
}
