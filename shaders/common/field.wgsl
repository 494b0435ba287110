// The height field, as everything that traces it reads it.
//
//   height        r32float         1 = reference surface, 0 = deepest; texel centres at integer lattice positions
//   pyramid       r32float, mips   upper bound of the bilinear surface over a node
//   normal_map    rgba16float, mips  level 0: unit normal in field space, height; above it their means
//   material_map  r32uint          soot, bare, post, gloss, heat: see common/material.wgsl
//   bounds        r32float         range of the bilinear surface over a node, levels side by side: see common/range.wgsl
//   cover_map     rgba16float      what a simulation lays over the surface, for its albedo; 1×1 where none does
//
// Composed after common/view.wgsl.

@group(1) @binding(0) var height: texture_2d<f32>;
@group(1) @binding(1) var pyramid: texture_2d<f32>;
@group(1) @binding(2) var normal_map: texture_2d<f32>;
@group(1) @binding(3) var material_map: texture_2d<u32>;
// Binding 4 is the picture of surface/albedo_image.wgsl.
@group(1) @binding(5) var cover_map: texture_2d<f32>;
@group(1) @binding(6) var bounds: texture_2d<f32>;

// The texel that an unbounded coordinate means, an axis.
fn address(texel: vec2i) -> vec2i {
    let size = vec2i(view.field_size);
    if !view_wraps() {
        return clamp(texel, vec2i(0), size - 1);
    }
    return field_wrapped(texel, size);
}

// The remainder of a division that rounds down. By floats, twice, and a last step: exact for every texel, and a seventh of the cost of
// `%`, for which no adapter has vectors.
fn field_wrapped(texel: vec2i, size: vec2i) -> vec2i {
    let once = texel - size * vec2i(floor(vec2f(texel) / vec2f(size)));
    let twice = once - size * vec2i(floor(vec2f(once) / vec2f(size)));
    let risen = select(twice, twice + size, twice < vec2i(0));
    return select(risen, risen - size, risen >= size);
}

fn load_height(texel: vec2i) -> f32 {
    return textureLoad(height, address(texel), 0).r;
}

// Where the corners of a cell meet, in the texture: what is gathered there is half a texel from any other choice, so that a cell may be
// as far beyond the border as positions are known to half a texel. One gather takes lavapipe a third of the time of four loads.
fn gather_uv(cell: vec2i) -> vec2f {
    return vec2f(cell + 1) / vec2f(view.field_size);
}

// The four corners of a cell: (x, y), (x+1, y), (x, y+1), (x+1, y+1). What the sampler does beyond the border is the field's addressing.
fn load_corners(cell: vec2i) -> vec4f {
    return textureGather(0, height, nearest, gather_uv(cell)).wzxy;
}

// The surface at a lattice position, in full precision: hardware filters have about 8 bits of fraction.
fn load_surface(lattice: vec2f) -> f32 {
    let cell = floor(lattice);
    let z = load_corners(vec2i(cell));
    let f = lattice - cell;
    return mix(mix(z.x, z.y, f.x), mix(z.z, z.w, f.x), f.y);
}

// Where a lattice position lies in the texture.
fn uv_of(lattice: vec2f) -> vec2f {
    return (lattice + 0.5) / vec2f(view.field_size);
}
