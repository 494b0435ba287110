//! Which texels changed: what follows from the field need be derived anew only there.

use super::Region;

/// The texels that changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Dirty {
    /// None.
    #[default]
    Nothing,
    /// Those of at most [`Dirty::MAX_REGIONS`] regions, which share no texel.
    Regions(Vec<Region>),
    /// More than half of the field: one pass over all of it is as good.
    All,
}

impl Dirty {
    /// The most regions that are kept apart: each is a dispatch of every pass that follows, and of every level of the pyramid.
    pub const MAX_REGIONS: usize = 8;

    /// Adds a region of a field of this size, merging what touches, and the nearest where there are too many.
    pub fn add(&mut self, region: Region, field: [u32; 2]) {
        let regions = match self {
            Self::All => return,
            Self::Nothing => {
                *self = Self::Regions(Vec::with_capacity(Self::MAX_REGIONS + 1));
                return self.add(region, field);
            }
            Self::Regions(regions) => regions,
        };
        absorb(regions, region);
        while regions.len() > Self::MAX_REGIONS {
            let (a, b) = cheapest_pair(regions);
            // b is the later of the two, so taking it away leaves a where it is.
            let later = regions.swap_remove(b);
            let merged = union(regions.swap_remove(a), later);
            absorb(regions, merged);
        }
        let area: u64 = regions.iter().map(|region| region.area()).sum();
        if 2 * area > Region::all(field).area() {
            *self = Self::All;
        }
    }

    /// Adds all that another holds.
    pub fn merge(&mut self, other: &Self, field: [u32; 2]) {
        match other {
            Self::Nothing => {}
            Self::Regions(regions) => regions.iter().for_each(|region| self.add(*region, field)),
            Self::All => *self = Self::All,
        }
    }

    /// The regions to derive anew in a field of this size.
    pub fn regions(&self, field: [u32; 2]) -> Vec<Region> {
        match self {
            Self::Nothing => Vec::new(),
            Self::Regions(regions) => regions.clone(),
            Self::All => vec![Region::all(field)],
        }
    }
}

/// Puts a region among others that touch neither each other nor, afterwards, it.
fn absorb(regions: &mut Vec<Region>, mut region: Region) {
    while let Some(touching) = regions.iter().position(|other| touch(*other, region)) {
        region = union(region, regions.swap_remove(touching));
    }
    regions.push(region);
}

/// The two regions, in order, whose union adds the fewest texels.
fn cheapest_pair(regions: &[Region]) -> (usize, usize) {
    let growth = |&(a, b): &(usize, usize)| {
        let (a, b) = (regions[a], regions[b]);
        union(a, b).area() - a.area() - b.area()
    };
    (0..regions.len())
        .flat_map(|a| (a + 1..regions.len()).map(move |b| (a, b)))
        .min_by_key(growth)
        .expect("there are more than MAX_REGIONS regions, hence a pair")
}

fn end(region: Region, axis: usize) -> u32 {
    region.origin[axis] + region.extent[axis]
}

/// Whether the two share a texel or a border: then one region serves both.
fn touch(a: Region, b: Region) -> bool {
    (0..2).all(|axis| a.origin[axis] <= end(b, axis) && b.origin[axis] <= end(a, axis))
}

/// The smallest region that holds both.
fn union(a: Region, b: Region) -> Region {
    let origin = [0, 1].map(|axis| a.origin[axis].min(b.origin[axis]));
    Region { origin, extent: [0, 1].map(|axis| end(a, axis).max(end(b, axis)) - origin[axis]) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const FIELD: [u32; 2] = [100, 60];

    fn texels(region: Region) -> impl Iterator<Item = [u32; 2]> {
        (region.origin[1]..end(region, 1)).flat_map(move |y| (region.origin[0]..end(region, 0)).map(move |x| [x, y]))
    }

    proptest! {
        #[test]
        fn every_texel_that_was_added_is_held_once(
            added in prop::collection::vec((0..90_u32, 0..50_u32, 1..10_u32, 1..10_u32), 0..30)
        ) {
            let mut dirty = Dirty::Nothing;
            let mut changed = std::collections::HashSet::new();
            for (x, y, width, height) in added {
                let region = Region { origin: [x, y], extent: [width, height] };
                dirty.add(region, FIELD);
                changed.extend(texels(region));
            }
            let held: Vec<_> = dirty.regions(FIELD).into_iter().flat_map(texels).collect();
            let distinct: std::collections::HashSet<_> = held.iter().copied().collect();
            prop_assert_eq!(held.len(), distinct.len());
            prop_assert!(changed.is_subset(&distinct));
            prop_assert!(dirty.regions(FIELD).len() <= Dirty::MAX_REGIONS);
            prop_assert_eq!(dirty == Dirty::Nothing, changed.is_empty());
        }
    }

    #[test]
    fn distant_regions_stay_apart_and_more_than_half_is_all() {
        let mut dirty = Dirty::Nothing;
        let corner = |x, y| Region { origin: [x, y], extent: [3, 3] };
        for region in [corner(0, 0), corner(97, 0), corner(0, 57), corner(97, 57)] {
            dirty.add(region, FIELD);
        }
        assert_eq!(dirty.regions(FIELD).iter().map(Region::area).sum::<u64>(), 36);
        dirty.add(Region { origin: [10, 10], extent: [80, 45] }, FIELD);
        assert_eq!(dirty, Dirty::All);
    }
}
