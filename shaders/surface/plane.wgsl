// Plane: the flat relief among other things, with a depth buffer. Needs surface/surface and surface/raster.
//
//   radiance  rgba16float   write  blended by the share of the pixel that shows the plane
//   depth     depth32float  write  the polygon's, or behind a switch the relief's

fn plane_depth(shaded: Shaded, pixel: PixelRay) -> f32 {
    let height = select(1.0, shaded.hit.height, view.displaced_depth == 1u);
    let lattice = select(pixel.lattice, shaded.hit.lattice, view.displaced_depth == 1u);
    return raster_depth(world_of(lattice, height));
}

@fragment
fn plane(outline: Outline) -> ColourAndDepth {
    outline_view(outline);
    let pixel = pixel_ray(outline.position.xy);
    let coverage = plane_coverage(pixel);
    if coverage == 0.0 {
        discard;
    }
    frame = plane_frame();
    let shaded = shade(pixel.ray);
    return ColourAndDepth(vec4f(shown(shaded), coverage), plane_depth(shaded, pixel));
}

@fragment
fn plane_channel(outline: Outline) -> ColourAndDepth {
    outline_view(outline);
    let pixel = pixel_ray(outline.position.xy);
    if !shows_plane(pixel) {
        discard;
    }
    frame = plane_frame();
    let shaded = shade(pixel.ray);
    return ColourAndDepth(channel_part(channel_of(shaded)), plane_depth(shaded, pixel));
}
