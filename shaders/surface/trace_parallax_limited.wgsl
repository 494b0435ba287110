// Parallax mapping with offset limiting (Welsh): `parallax` without the division by V.z, so that the offset is never longer than
// the surface is deep.
//
//   height  r32float  read  through sample_height, level 0: one bilinear sample  16 bytes
//
// Over the true ray that is a share of V.z of the way down to the surface's height.
//
// Specification: src/reference/trace_parallax_limited.rs. Needs surface/march.

fn trace(ray: Ray) -> Hit {
    let gap = march_gap(ray, 0.0);
    if gap <= 0.0 {
        return hit_at(ray, 0.0, 1u);
    }
    // A ray that does not fall never comes down to it.
    if ray.rise >= 0.0 || gap > -ray.rise * ray.t_end {
        return end_of(ray, 1u);
    }
    return hit_at(ray, march_cosine(ray) * gap / -ray.rise, 1u);
}
