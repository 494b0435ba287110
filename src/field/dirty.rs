//! Which texels changed: what follows from the field need be derived anew only there.

use super::Region;

/// The texels that changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Dirty {
    /// None.
    #[default]
    Nothing,
    /// Those of some regions.
    Regions(Regions),
    /// As many as the field has, or more: one pass over all of it is as good.
    All,
}

/// Regions that changed. They may share texels: [`BlockList`](super::blocks::BlockList) counts none twice.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Regions {
    list: Vec<Region>,
    /// Of all of them together.
    texels: u64,
}

impl Dirty {
    /// Adds a region of a field of this size.
    pub fn add(&mut self, region: Region, field: [u32; 2]) {
        let regions = match self {
            Self::All => return,
            Self::Nothing => {
                *self = Self::Regions(Regions::default());
                return self.add(region, field);
            }
            Self::Regions(regions) => regions,
        };
        // A brush that rests, a simulation's own rectangle: the same one, time and again.
        if regions.list.last() == Some(&region) {
            return;
        }
        regions.list.push(region);
        regions.texels += region.area();
        if regions.texels >= Region::all(field).area() {
            *self = Self::All;
        }
    }

    /// Adds all that another holds.
    pub fn merge(&mut self, other: &Self, field: [u32; 2]) {
        match other {
            Self::Nothing => {}
            Self::Regions(regions) => regions.list.iter().for_each(|region| self.add(*region, field)),
            Self::All => *self = Self::All,
        }
    }

    /// The regions to derive anew in a field of this size.
    pub fn regions(&self, field: [u32; 2]) -> Vec<Region> {
        match self {
            Self::Nothing => Vec::new(),
            Self::Regions(regions) => regions.list.clone(),
            Self::All => vec![Region::all(field)],
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const FIELD: [u32; 2] = [100, 60];

    fn texels(region: Region) -> impl Iterator<Item = [u32; 2]> {
        let [x, y] = region.origin;
        (y..y + region.extent[1]).flat_map(move |y| (x..x + region.extent[0]).map(move |x| [x, y]))
    }

    proptest! {
        #[test]
        fn every_texel_that_was_added_is_held(
            added in prop::collection::vec((0..90_u32, 0..50_u32, 1..10_u32, 1..10_u32), 0..200)
        ) {
            let (mut dirty, mut merged) = (Dirty::Nothing, Dirty::Nothing);
            let mut changed = std::collections::HashSet::new();
            for (x, y, width, height) in added {
                let region = Region { origin: [x, y], extent: [width, height] };
                dirty.add(region, FIELD);
                changed.extend(texels(region));
            }
            merged.merge(&dirty, FIELD);
            prop_assert_eq!(&merged, &dirty);
            let held: std::collections::HashSet<_> = dirty.regions(FIELD).into_iter().flat_map(texels).collect();
            prop_assert!(changed.is_subset(&held));
            prop_assert_eq!(dirty == Dirty::Nothing, changed.is_empty());
            prop_assert!(dirty == Dirty::All || held.len() == changed.len());
        }
    }

    #[test]
    fn as_many_texels_as_the_field_has_are_all() {
        let mut dirty = Dirty::Nothing;
        dirty.add(Region { origin: [0, 0], extent: [100, 59] }, FIELD);
        dirty.add(Region { origin: [0, 0], extent: [100, 59] }, FIELD);
        assert_eq!(dirty.regions(FIELD).len(), 1);
        dirty.add(Region { origin: [0, 59], extent: [100, 1] }, FIELD);
        assert_eq!(dirty, Dirty::All);
    }
}
