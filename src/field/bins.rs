//! Binning discs, and discs swept along a segment, into tiles, on the CPU: which tiles they touch, and in which order each tile must
//! gather them.
//!
//! A counting sort by tile, stable: within a tile the discs keep the order of their submission, so that ordered blends are
//! deterministic. Where the field wraps, a disc over a border is gathered once for each image of the field that it covers.

use bytemuck::{Pod, Zeroable};

use super::{Dirty, Region};

/// A disc upon the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Its centre, lattice coordinates.
    pub centre: [f32; 2],
    /// Its radius, texels. A disc whose radius is not positive touches nothing, nor does one that is not finite, or so far off that
    /// an f32 no longer tells one texel from the next.
    pub radius: f32,
}

/// A disc swept along a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Where the segment begins.
    pub disc: Disc,
    /// From there to its end, texels; zero for a disc.
    pub span: [f32; 2],
}

impl From<Disc> for Capsule {
    fn from(disc: Disc) -> Self {
        Self { disc, span: [0.0; 2] }
    }
}

impl Capsule {
    /// The least and the largest coordinate of its segment along an axis.
    fn along(&self, axis: usize) -> [f64; 2] {
        let start = f64::from(self.disc.centre[axis]);
        let end = start + f64::from(self.span[axis]);
        [start.min(end), start.max(end)]
    }
}

/// A disc as a tile sees it: what the shader decides by whether a texel lies within.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Member {
    /// The disc's centre, where its segment begins, in texels from the tile's first one; in the image of the field that this is about. Small numbers, so that
    /// nothing is lost where the field wraps.
    pub centre: [f32; 2],
    /// The disc's radius, texels.
    pub radius: f32,
    /// Which of the discs, counted from the last [`Bins::clear`].
    pub disc: u32,
}

/// A tile that discs touch, and where its members stand.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Tile {
    /// Its column and row, in units of tiles.
    pub tile: [u32; 2],
    /// The first of its members in [`Bins::members`].
    pub first: u32,
    /// How many they are.
    pub count: u32,
}

/// Why discs could not be binned.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BinError {
    /// The lists would not fit the adapter's buffers.
    #[error(
        "{discs} discs touch about {entries} tiles of the field in all, more than the {limit} that a buffer of this adapter \
         holds; press fewer or smaller ones"
    )]
    TooMany {
        /// Number of discs.
        discs: usize,
        /// Number of pairs of disc and tile.
        entries: u64,
        /// The most that fit.
        limit: u64,
    },
    /// The discs themselves would not.
    #[error(
        "{discs} discs fall in one frame, more than the {limit} that a buffer of this adapter holds; press fewer, or cut time into \
         shorter frames"
    )]
    TooManyDiscs {
        /// Number of discs.
        discs: usize,
        /// The most that fit.
        limit: u64,
    },
}

impl BinError {
    /// Refuses a list of discs that is longer than a buffer holds, whatever tiles they touch.
    ///
    /// # Errors
    ///
    /// It is.
    pub fn check(discs: usize, limit: u64) -> Result<(), Self> {
        if discs as u64 > limit { Err(Self::TooManyDiscs { discs, limit }) } else { Ok(()) }
    }
}

/// The tiles that some discs touch. Its vectors keep their capacity: a steady state allocates nothing.
#[derive(Debug, Default)]
pub struct Bins {
    /// The touched tiles, row by row within a batch.
    pub tiles: Vec<Tile>,
    /// What each gathers, tile by tile.
    pub members: Vec<Member>,
    discs: u32,
    counts: Vec<u32>,
    pairs: Vec<(u32, Member)>,
}

/// What one call of [`Bins::add`] appended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Batch {
    /// The first of its tiles.
    pub first_tile: u32,
    /// The number of its tiles.
    pub tile_count: u32,
    /// The texels that its discs may cover.
    pub dirty: Dirty,
}

/// Texels by which a disc is taken larger than it is: the shader decides in f32 whether a texel lies within, and no texel that it
/// finds within may be missed here. 2⁻⁸ is sixteen times the rounding of a lattice coordinate of 16,384.
const SLACK: f64 = 1.0 / 256.0;

/// The field that discs fall upon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ground {
    /// Its size, texels.
    pub size: [u32; 2],
    /// Whether it repeats beyond its border.
    pub wrap: bool,
    /// Width and height of a tile, texels.
    pub tile: [u32; 2],
}

impl Bins {
    /// Forgets everything but the capacity.
    pub fn clear(&mut self) {
        self.tiles.clear();
        self.members.clear();
        self.discs = 0;
    }

    /// Appends a batch of discs, swept or not: its tiles list its discs alone. `limit` is the most members that all batches together may have.
    pub fn add<T: Into<Capsule>>(
        &mut self,
        ground: Ground,
        discs: impl Iterator<Item = T>,
        limit: u64,
    ) -> Result<Batch, BinError> {
        let [columns, rows] = [0, 1].map(|axis| ground.size[axis].div_ceil(ground.tile[axis]));
        let first_tile = self.tiles.len() as u32;
        let mut dirty = Dirty::Nothing;

        self.pairs.clear();
        let (mut seen, mut excess) = (0, 0);
        for disc in discs {
            let disc: Capsule = disc.into();
            seen += 1;
            let room = limit.saturating_sub((self.members.len() + self.pairs.len()) as u64);
            let estimate = tile_estimate(ground, disc);
            if excess > 0 || estimate > room as f64 {
                // Go on counting, for the message, without listing. The cast saturates.
                excess += estimate as u64;
            } else {
                self.add_disc(ground, disc, &mut dirty);
            }
            self.discs += 1;
        }
        if excess > 0 {
            let entries = (self.members.len() + self.pairs.len()) as u64 + excess;
            return Err(BinError::TooMany { discs: seen, entries, limit });
        }

        // The counting sort: how many, then where each tile's members begin, then the members.
        self.counts.clear();
        self.counts.resize((columns * rows) as usize, 0);
        for (tile, _) in &self.pairs {
            self.counts[*tile as usize] += 1;
        }
        let mut first = self.members.len() as u32;
        for (index, count) in self.counts.iter_mut().enumerate() {
            if *count > 0 {
                let tile = [index as u32 % columns, index as u32 / columns];
                self.tiles.push(Tile { tile, first, count: *count });
                // From here on the count is the place of the tile's next member.
                (*count, first) = (first, first + *count);
            }
        }
        self.members.resize(first as usize, Member::zeroed());
        for (tile, member) in &self.pairs {
            let place = &mut self.counts[*tile as usize];
            self.members[*place as usize] = *member;
            *place += 1;
        }
        Ok(Batch { first_tile, tile_count: self.tiles.len() as u32 - first_tile, dirty })
    }

    /// Lists the tiles that one disc touches, in each image of the field that it meets.
    fn add_disc(&mut self, ground: Ground, capsule: Capsule, dirty: &mut Dirty) {
        let Some([xs, ys]) = images(ground, capsule) else { return };
        let Capsule { disc, span } = capsule;
        let reach = [0, 1].map(|axis| capsule.along(axis));
        let swept = span != [0.0; 2];
        let span = span.map(f64::from);
        let radius = f64::from(disc.radius) + SLACK;
        let tile = ground.tile.map(f64::from);
        let columns = ground.size[0].div_ceil(ground.tile[0]);
        // The casts hold: the caller has bounded the number of images, and `images` their distance.
        for y in ys.0 as i64..=ys.1 as i64 {
            for x in xs.0 as i64..=xs.1 as i64 {
                let image = [x, y].map(|image| image as f64);
                let shift = [0, 1].map(|axis| image[axis] * f64::from(ground.size[axis]));
                let centre = [0, 1].map(|axis| f64::from(disc.centre[axis]) - shift[axis]);
                // The texels that may lie within; none if the disc slips between two rows of them.
                let first = [0, 1].map(|axis| (reach[axis][0] - shift[axis] - radius).ceil().max(0.0));
                let last =
                    [0, 1].map(|axis| (reach[axis][1] - shift[axis] + radius).floor().min(f64::from(ground.size[axis] - 1)));
                if first[0] > last[0] || first[1] > last[1] {
                    continue;
                }
                let (origin, end) = (first.map(|value| value as u32), last.map(|value| value as u32 + 1));
                dirty.add(Region { origin, extent: [end[0] - origin[0], end[1] - origin[1]] }, ground.size);
                let (low, high) =
                    ([0, 1].map(|axis| origin[axis] / ground.tile[axis]), [0, 1].map(|axis| (end[axis] - 1) / ground.tile[axis]));
                for row in low[1]..=high[1] {
                    for column in low[0]..=high[0] {
                        let from_tile = [centre[0] - f64::from(column) * tile[0], centre[1] - f64::from(row) * tile[1]];
                        // What of the box the disc does not reach is left out: corners, or all that a segment aslant passes by.
                        let away = if swept {
                            squared_distance(from_tile, span, tile.map(|side| side - 1.0))
                        } else {
                            squared_gap(from_tile, tile.map(|side| side - 1.0))
                        };
                        if away < radius * radius {
                            let centre = from_tile.map(|from_tile| from_tile as f32);
                            let member = Member { centre, radius: disc.radius, disc: self.discs };
                            self.pairs.push((row * columns + column, member));
                        }
                    }
                }
            }
        }
    }
}

/// The squared distance from a point to the box from the origin to this corner.
fn squared_gap(point: [f64; 2], corner: [f64; 2]) -> f64 {
    let gap = [0, 1].map(|axis| (-point[axis]).max(point[axis] - corner[axis]).max(0.0));
    gap[0] * gap[0] + gap[1] * gap[1]
}

/// The squared distance from a segment to the box from the origin to this corner.
fn squared_distance(start: [f64; 2], span: [f64; 2], corner: [f64; 2]) -> f64 {
    // What of the segment lies between the box's sides, an axis after the other.
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if span[axis] == 0.0 {
            if !(0.0..=corner[axis]).contains(&start[axis]) {
                leaves = -1.0;
            }
        } else {
            let ends = [-start[axis] / span[axis], (corner[axis] - start[axis]) / span[axis]];
            (enters, leaves) = (enters.max(ends[0].min(ends[1])), leaves.min(ends[0].max(ends[1])));
        }
    }
    if enters <= leaves {
        return 0.0;
    }
    // Apart, they are nearest where one of them has a corner or an end.
    let end = [start[0] + span[0], start[1] + span[1]];
    let length = span[0] * span[0] + span[1] * span[1];
    let to_segment = |x: f64, y: f64| {
        let t = (((x - start[0]) * span[0] + (y - start[1]) * span[1]) / length).clamp(0.0, 1.0);
        let away = [x - start[0] - t * span[0], y - start[1] - t * span[1]];
        away[0] * away[0] + away[1] * away[1]
    };
    [squared_gap(start, corner), squared_gap(end, corner)]
        .into_iter()
        .chain([to_segment(0.0, 0.0), to_segment(corner[0], 0.0), to_segment(0.0, corner[1]), to_segment(corner[0], corner[1])])
        .fold(f64::INFINITY, f64::min)
}

/// The first and last image of the field, along x and y, that the disc's box meets. As floats: a huge disc on a small field meets
/// more than any integer counts.
fn images(ground: Ground, capsule: Capsule) -> Option<[(f64, f64); 2]> {
    const FARTHEST: f32 = 16_777_216.0;
    let Capsule { disc, span } = capsule;
    let near = disc.centre.iter().chain(&span).all(|value| value.abs() <= FARTHEST);
    if !near || !disc.radius.is_finite() || disc.radius <= 0.0 {
        return None;
    }
    let radius = f64::from(disc.radius) + SLACK;
    let range = |axis: usize| {
        let ([low, high], size) = (capsule.along(axis), f64::from(ground.size[axis]));
        // The texels of image k stand at k·size … k·size + size − 1.
        let first = ((low - radius - (size - 1.0)) / size).ceil();
        let last = ((high + radius) / size).floor();
        if ground.wrap { (first, last) } else { (first.max(0.0), last.min(0.0)) }
    };
    let ranges = [range(0), range(1)];
    ranges.iter().all(|(first, last)| first <= last).then_some(ranges)
}

/// At least as many tiles as the disc touches, in all images together.
fn tile_estimate(ground: Ground, capsule: Capsule) -> f64 {
    let Some(ranges) = images(ground, capsule) else { return 0.0 };
    let along = |axis: usize| {
        let (first, last) = ranges[axis];
        let tiles = f64::from(ground.size[axis].div_ceil(ground.tile[axis]));
        let [low, high] = capsule.along(axis);
        let across = ((high - low + 2.0 * (f64::from(capsule.disc.radius) + SLACK)) / f64::from(ground.tile[axis])).floor() + 2.0;
        (last - first + 1.0) * across.min(tiles)
    };
    along(0) * along(1)
}

/// Workgroups, one a tile, in a grid whose sides the baseline of WebGPU allows; the last row may be longer than needed.
pub fn tile_workgroups(tile_count: u32) -> [u32; 2] {
    const LONGEST: u32 = 65_535;
    [tile_count.min(LONGEST), tile_count.div_ceil(LONGEST)]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The distance from a point to a segment.
    fn away(point: [f64; 2], start: [f32; 2], span: [f32; 2]) -> f64 {
        let (start, span) = (start.map(f64::from), span.map(f64::from));
        let length = span[0] * span[0] + span[1] * span[1];
        let dot = (point[0] - start[0]) * span[0] + (point[1] - start[1]) * span[1];
        let t = if length > 0.0 { (dot / length).clamp(0.0, 1.0) } else { 0.0 };
        (point[0] - start[0] - t * span[0]).hypot(point[1] - start[1] - t * span[1])
    }

    /// For each texel the discs that reach it, one entry an image, by trying every image of the field: in order of submission.
    fn by_hand(ground: Ground, capsules: &[Capsule]) -> Vec<Vec<u32>> {
        let mut reached = vec![Vec::new(); (ground.size[0] * ground.size[1]) as usize];
        // No disc of the test reaches farther than 80 texels.
        let images = [0, 1].map(|axis| {
            if ground.wrap { -80 / i64::from(ground.size[axis]) - 1..=80 / i64::from(ground.size[axis]) + 1 } else { 0..=0 }
        });
        for (number, Capsule { disc, span }) in (0..).zip(capsules) {
            for image_y in images[1].clone() {
                for image_x in images[0].clone() {
                    for (index, reached) in reached.iter_mut().enumerate() {
                        let x = (index as u32 % ground.size[0]) as f64 + (image_x * i64::from(ground.size[0])) as f64;
                        let y = (index as u32 / ground.size[0]) as f64 + (image_y * i64::from(ground.size[1])) as f64;
                        if away([x, y], disc.centre, *span) < f64::from(disc.radius) {
                            reached.push(number);
                        }
                    }
                }
            }
        }
        reached
    }

    /// The same by the tiles' lists, deciding as the shader does.
    fn by_tiles(ground: Ground, bins: &Bins, capsules: &[Capsule]) -> Vec<Vec<u32>> {
        let mut reached = vec![Vec::new(); (ground.size[0] * ground.size[1]) as usize];
        for tile in &bins.tiles {
            for member in &bins.members[tile.first as usize..][..tile.count as usize] {
                for y in 0..ground.tile[1] {
                    for x in 0..ground.tile[0] {
                        let texel = [tile.tile[0] * ground.tile[0] + x, tile.tile[1] * ground.tile[1] + y];
                        let span = capsules[member.disc as usize].span;
                        if away([x, y].map(f64::from), member.centre, span) < f64::from(member.radius)
                            && texel[0] < ground.size[0]
                            && texel[1] < ground.size[1]
                        {
                            reached[(texel[1] * ground.size[0] + texel[0]) as usize].push(member.disc);
                        }
                    }
                }
            }
        }
        reached
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn tiles_gather_for_each_texel_the_discs_that_reach_it_in_their_order(
            size in (1..24_u32, 1..24_u32),
            wrap: bool,
            // Quarters of texels, so that both sides agree about borders.
            discs in prop::collection::vec((-40..140_i32, -40..140_i32, 1..60_i32, -80..80_i32, -80..80_i32, 0..3_i32), 0..12),
            cut in 0..12_usize,
        ) {
            let ground = Ground { size: [size.0, size.1], wrap, tile: [8, 4] };
            let quarter = |value: i32| value as f32 / 4.0;
            // One in three is a disc, one lies along an axis, one aslant.
            let discs: Vec<_> = discs
                .iter()
                .map(|(x, y, r, across, down, kind)| Capsule {
                    disc: Disc { centre: [quarter(*x), quarter(*y)], radius: quarter(*r) },
                    span: [[0.0, 0.0], [quarter(*across), 0.0], [quarter(*across), quarter(*down)]][*kind as usize],
                })
                .collect();
            // In two batches: the numbers go on, and each batch has its own tiles.
            let (first, second) = discs.split_at(cut.min(discs.len()));
            let mut bins = Bins::default();
            let a = bins.add(ground, first.iter().copied(), u64::MAX).expect("there is no limit");
            let b = bins.add(ground, second.iter().copied(), u64::MAX).expect("there is no limit");
            prop_assert_eq!(a.tile_count, b.first_tile);
            prop_assert_eq!(by_tiles(ground, &bins, &discs), by_hand(ground, &discs));
        }
    }

    #[test]
    fn the_members_that_are_listed_are_few() {
        let ground = Ground { size: [1024, 1024], wrap: true, tile: [16, 8] };
        let mut bins = Bins::default();
        bins.add(ground, std::iter::once(Disc { centre: [511.5, 511.5], radius: 8.0 }), u64::MAX).expect("there is no limit");
        // A box of 16×16 in the middle of four tiles meets 2×4, the disc as well but for none of its corners.
        assert!(bins.members.len() <= 8, "{}", bins.members.len());
    }

    #[test]
    fn a_swept_disc_is_listed_where_its_segment_passes_and_not_in_its_box() {
        let ground = Ground { size: [1024, 1024], wrap: false, tile: [16, 8] };
        let mut bins = Bins::default();
        let slant = Capsule { disc: Disc { centre: [100.0, 100.0], radius: 2.0 }, span: [800.0, 800.0] };
        bins.add(ground, std::iter::once(slant), u64::MAX).expect("there is no limit");
        // It crosses 50 columns and 100 rows of tiles, and grazes some beside them; its box holds 5,151.
        assert!((150..=250).contains(&bins.members.len()), "{}", bins.members.len());
    }

    #[test]
    fn tiles_beyond_one_row_of_workgroups_make_more_rows() {
        assert_eq!(tile_workgroups(1), [1, 1]);
        assert_eq!(tile_workgroups(65_535), [65_535, 1]);
        assert_eq!(tile_workgroups(65_536), [65_535, 2]);
    }
}
