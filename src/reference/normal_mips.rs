//! Normal mips: means of the normals and heights beneath each texel of a level. Specification of `shaders/field/normal_mips.wgsl`.

use super::HeightField;
use super::normals::normal;
use super::pyramid::parent;

/// One level.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// The mean of the unit normals and the mean height, row by row.
    pub means: Vec<[f64; 4]>,
}

/// Every level, the field's own normals and heights first. A texel of any other is the mean over all texels of the field whose
/// ancestor on that level it is, by the rule of parents that the pyramid has.
pub fn normal_mips(field: &HeightField, slope_per_height: [f64; 2]) -> Vec<Level> {
    let [width, height] = field.size;
    let texels = || (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let finest: Vec<[f64; 4]> = texels()
        .map(|[x, y]| {
            let [u, v, out] = normal(field, x, y, slope_per_height);
            [u, v, out, field.texel(x.into(), y.into())]
        })
        .collect();
    let mut ancestors: Vec<[u32; 2]> = texels().collect();
    let mut levels = vec![Level { size: field.size, means: finest.clone() }];
    let mut size = field.size;
    while size != [1, 1] {
        size = size.map(|size| (size / 2).max(1));
        let mut sums = vec![([0.0; 4], 0.0); (size[0] * size[1]) as usize];
        for (ancestor, own) in ancestors.iter_mut().zip(&finest) {
            *ancestor = [parent(ancestor[0], size[0]), parent(ancestor[1], size[1])];
            let (sum, count) = &mut sums[(ancestor[1] * size[0] + ancestor[0]) as usize];
            (0..4).for_each(|channel| sum[channel] += own[channel]);
            *count += 1.0;
        }
        levels.push(Level { size, means: sums.into_iter().map(|(sum, count)| sum.map(|sum| sum / count)).collect() });
    }
    levels
}
