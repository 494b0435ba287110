//! Normals: the slope of the height field by a 3×3 Sobel gradient. Specification of `shaders/field/normals.wgsl`.

use super::HeightField;

/// The unit normal of a texel in field space: u right, v down, out.
///
/// `slope_per_height` is the depth of the field over the width and the height of a texel.
pub fn normal(field: &HeightField, x: u32, y: u32, slope_per_height: [f64; 2]) -> [f64; 3] {
    let [dx, dy] = gradient(field, i64::from(x), i64::from(y));
    let (nx, ny) = (-dx * slope_per_height[0], -dy * slope_per_height[1]);
    let length = (nx * nx + ny * ny + 1.0).sqrt();
    [nx / length, ny / length, 1.0 / length]
}

/// Height gained for each texel along u and v.
pub fn gradient(field: &HeightField, x: i64, y: i64) -> [f64; 2] {
    let at = |dx: i64, dy: i64| field.texel(x + dx, y + dy);
    [
        (at(1, -1) + 2.0 * at(1, 0) + at(1, 1) - at(-1, -1) - 2.0 * at(-1, 0) - at(-1, 1)) / 8.0,
        (at(-1, 1) + 2.0 * at(0, 1) + at(1, 1) - at(-1, -1) - 2.0 * at(0, -1) - at(1, -1)) / 8.0,
    ]
}
