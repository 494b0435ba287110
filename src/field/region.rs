//! Rectangles of texels, and what a changed rectangle changes in turn.

use crate::scene::Addressing;

/// A rectangle of texels inside the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Its first texel.
    pub origin: [u32; 2],
    /// Width and height, texels.
    pub extent: [u32; 2],
}

impl Region {
    /// The whole of a field.
    pub fn all(size: [u32; 2]) -> Self {
        Self { origin: [0, 0], extent: size }
    }

    /// How many texels it has.
    pub fn area(&self) -> u64 {
        u64::from(self.extent[0]) * u64::from(self.extent[1])
    }

    /// The nodes of the next pyramid level that have one of these nodes as a child; `size` is that level's size.
    pub fn parents(&self, size: [u32; 2]) -> Self {
        // parent(i) = min(i >> 1, size − 1): the last node takes the remainder.
        self.map(|origin, end, size| ((origin >> 1).min(size - 1), ((end - 1) >> 1).min(size - 1) + 1), size)
    }

    fn map(&self, axis: impl Fn(u32, u32, u32) -> (u32, u32), size: [u32; 2]) -> Self {
        let (x0, x1) = axis(self.origin[0], self.origin[0] + self.extent[0], size[0]);
        let (y0, y1) = axis(self.origin[1], self.origin[1] + self.extent[1], size[1]);
        Self { origin: [x0, y0], extent: [x1 - x0, y1 - y0] }
    }

    /// The region grown by so many texels at its low and high sides: wrapped and split where the field wraps, else cut.
    pub fn grown(&self, low: u32, high: u32, size: [u32; 2], addressing: Addressing) -> Vec<Self> {
        let axis = |axis: usize| grown_axis(self.origin[axis], self.extent[axis], low, high, size[axis], addressing);
        let columns = axis(0);
        let rows = axis(1);
        rows.iter()
            .flat_map(|&(y, height)| columns.iter().map(move |&(x, width)| Self { origin: [x, y], extent: [width, height] }))
            .collect()
    }
}

/// The spans, one or two, of a span grown by `low` and `high`.
fn grown_axis(origin: u32, extent: u32, low: u32, high: u32, size: u32, addressing: Addressing) -> Vec<(u32, u32)> {
    let (begin, end) = (i64::from(origin) - i64::from(low), i64::from(origin + extent) + i64::from(high));
    let size = i64::from(size);
    let spans = match addressing {
        _ if end - begin >= size => vec![(0, size)],
        Addressing::Clamp => vec![(begin.max(0), end.min(size))],
        Addressing::Wrap if begin < 0 => vec![(0, end), (begin + size, size)],
        Addressing::Wrap if end > size => vec![(0, end - size), (begin, size)],
        Addressing::Wrap => vec![(begin, end)],
    };
    // Every bound lies in 0..=size by construction, so the casts lose nothing.
    spans.into_iter().map(|(begin, end)| (begin as u32, (end - begin) as u32)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(x: u32, y: u32, width: u32, height: u32) -> Region {
        Region { origin: [x, y], extent: [width, height] }
    }

    #[test]
    fn growth_wraps_splits_and_cuts() {
        let size = [10, 8];
        assert_eq!(region(3, 3, 2, 2).grown(1, 1, size, Addressing::Wrap), [region(2, 2, 4, 4)]);
        assert_eq!(region(0, 3, 2, 2).grown(1, 0, size, Addressing::Wrap), [region(0, 2, 2, 3), region(9, 2, 1, 3)]);
        assert_eq!(region(9, 7, 1, 1).grown(0, 1, size, Addressing::Wrap).len(), 4);
        assert_eq!(region(0, 7, 2, 1).grown(1, 1, size, Addressing::Clamp), [region(0, 6, 3, 2)]);
        assert_eq!(region(1, 0, 9, 8).grown(1, 1, size, Addressing::Wrap), [region(0, 0, 10, 8)]);
    }

    #[test]
    fn parents_take_the_remainder() {
        // 5 nodes have 2 parents: node 4 belongs to the last, which takes three.
        assert_eq!(region(4, 0, 1, 1).parents([2, 2]), region(1, 0, 1, 1));
        assert_eq!(region(1, 1, 3, 3).parents([2, 2]), region(0, 0, 2, 2));
        assert_eq!(region(0, 0, 1, 1).parents([1, 1]), region(0, 0, 1, 1));
    }
}
