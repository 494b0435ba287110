// Parallax mapping (Kaneko): as far down the ray as the surface is deep where the ray starts.
//
//   height  r32float  read  through sample_height, level 0: one bilinear sample  16 bytes
//
// On a level surface that is exact; elsewhere the ray meets another height than the one it was moved for. Its offset,
// −(1 − h) · depth · V.xy / V.z with V toward the eye, grows without bound for rays that graze.
//
// Specification: src/reference/trace_parallax.rs. Needs surface/march.

fn trace(ray: Ray) -> Hit {
    let gap = march_gap(ray, 0.0);
    if gap <= 0.0 {
        return hit_at(ray, 0.0, 1u);
    }
    // A ray that does not fall never comes down to it.
    if ray.rise >= 0.0 || gap > -ray.rise * ray.t_end {
        return end_of(ray, 1u);
    }
    return hit_at(ray, gap / -ray.rise, 1u);
}
