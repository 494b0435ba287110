// Image: the colours of a picture over the field, pale where a shot broke it open.
//
//   albedo_map  rgba8unorm-srgb, mips  the picture over the whole tile, at its own size; addressed as the field is

@group(1) @binding(4) var albedo_map: texture_2d<f32>;

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    // As fine as the pixel sees: the footprint in the image's own texels.
    let seen = footprint.texels * vec2f(textureDimensions(albedo_map)) / vec2f(view.field_size);
    let level = log2(max(max(seen.x, seen.y), 1.0));
    let colour = textureSampleLevel(albedo_map, bilinear, uv_of(point.lattice), level).rgb;
    return sooty(mix(colour, 0.35 + 0.5 * colour, 0.6 * stamped.g), stamped.r);
}
