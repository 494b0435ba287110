// Gas: the clouds of a gas planet. The dye chooses between creams, ochres, rusts and browns, density whitens what stands high, and
// vorticity tints what turns. What the eye takes for filaments are the narrow stops of the palette: the dye that the flow
// stretched crosses several of them within a band. Made for the simulation `gas`, whose cover it reads: density, dye, vorticity
// (1/s), velocity along u (m/s).

// The cover between texels, by a spline of the third degree: bilinear would show its creases where the palette is steep.
fn gas_cover(lattice: vec2f) -> vec4f {
    let cell = floor(lattice);
    let f = lattice - cell;
    let first = vec2i(cell);
    let g = 1.0 - f;
    let across = vec4f(g.x * g.x * g.x, 4.0 + 3.0 * f.x * f.x * (f.x - 2.0), 4.0 + 3.0 * g.x * g.x * (g.x - 2.0), f.x * f.x * f.x) / 6.0;
    let down = vec4f(g.y * g.y * g.y, 4.0 + 3.0 * f.y * f.y * (f.y - 2.0), 4.0 + 3.0 * g.y * g.y * (g.y - 2.0), f.y * f.y * f.y) / 6.0;
    var sum = vec4f(0.0);
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            sum += across[x] * down[y] * textureLoad(cover_map, address(first + vec2i(x - 1, y - 1)), 0);
        }
    }
    return sum;
}

// A stop of the palette: what was before it, and this colour from there on.
fn gas_stop(before: vec3f, colour: vec3f, at: f32, width: f32, dye: f32) -> vec3f {
    return mix(before, colour, smoothstep(at - width, at + width, dye));
}

fn gas_palette(dye: f32) -> vec3f {
    var colour = vec3f(0.30, 0.085, 0.030);                                    // the red of great storms
    colour = gas_stop(colour, vec3f(0.235, 0.105, 0.050), 0.11, 0.05, dye);    // rust
    colour = gas_stop(colour, vec3f(0.360, 0.190, 0.095), 0.22, 0.05, dye);    // brown belts
    colour = gas_stop(colour, vec3f(0.270, 0.150, 0.088), 0.30, 0.03, dye);
    colour = gas_stop(colour, vec3f(0.500, 0.310, 0.160), 0.38, 0.05, dye);    // ochre
    colour = gas_stop(colour, vec3f(0.440, 0.330, 0.240), 0.48, 0.04, dye);    // grey where belts end
    colour = gas_stop(colour, vec3f(0.660, 0.520, 0.350), 0.56, 0.05, dye);    // sand
    colour = gas_stop(colour, vec3f(0.760, 0.660, 0.500), 0.68, 0.06, dye);    // cream
    colour = gas_stop(colour, vec3f(0.700, 0.610, 0.480), 0.77, 0.03, dye);
    return gas_stop(colour, vec3f(0.880, 0.830, 0.740), 0.88, 0.07, dye);      // white zones and ovals
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let cover = gas_cover(point.lattice);
    let turning = clamp(0.12 * cover.z, -1.0, 1.0);
    let dye = clamp(cover.y + 0.05 * cover.x + 0.05 * turning, 0.0, 1.0);
    var cloud = gas_palette(dye);
    // What stands high is younger and whiter, what lies low is seen through haze, bluish and dark.
    cloud = mix(cloud, vec3f(0.90, 0.87, 0.80), 0.35 * smoothstep(0.45, 1.1, cover.x));
    cloud = mix(cloud, cloud * vec3f(0.62, 0.66, 0.74), smoothstep(0.35, 1.0, -cover.x));
    return sooty(cloud, stamped.r);
}
