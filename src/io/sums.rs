//! Sums: what tells whether a run starts from what another one started from. Heights and images come from files, which may have
//! changed since.

use serde::{Deserialize, Serialize};

use crate::field::stamp::StampImage;

/// The sums of what a field starts from, CRC-32 each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sums {
    /// Of its heights: from an image or a font, or made.
    pub heights: u32,
    /// Of the images that stamps may have for their form.
    pub images: u32,
}

impl Sums {
    /// Of these heights and images.
    pub fn of(heights: &[f32], images: &[StampImage]) -> Self {
        let mut sum = crc32fast::Hasher::new();
        for image in images {
            sum.update(bytemuck::cast_slice(&image.size));
            sum.update(bytemuck::cast_slice(&image.values));
        }
        Self { heights: crc32fast::hash(bytemuck::cast_slice(heights)), images: sum.finalize() }
    }

    /// What is wrong with a file of these sums, where a run has others, and what to do about it.
    pub fn problem(self, run: Self) -> Option<&'static str> {
        if self.heights != run.heights {
            Some("started from other heights than this run: put the image or the font back that it was made with")
        } else if self.images != run.images {
            Some("had other images to imprint than this run: put those back that it was made with")
        } else {
            None
        }
    }
}
