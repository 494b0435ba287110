//! Numbered series of images: which files they are, checked by their headers before anything runs, and a player that has what a moment
//! needs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::colour_image;
use super::height_image::{self, HeightImage, ImageError};
use crate::field::sequence::Images;
use crate::scene::{Addressing, Between, Scene, Sequence};
use crate::surface::albedo_image::ColourImage;

/// Why a series cannot be played.
#[derive(Debug, thiserror::Error)]
pub enum SequenceError {
    /// One of its images is unfit.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// Its folder cannot be listed.
    #[error("cannot list the images {}: {}", path.display(), height_image::explain(cause))]
    Unlisted {
        /// The folder.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// Its files are no series.
    #[error("{} {problem}", path.display())]
    Unfit {
        /// The file, folder or pattern.
        path: PathBuf,
        /// What is the matter, and what to do about it.
        problem: String,
    },
}

fn unfit<T>(path: impl Into<PathBuf>, problem: impl Into<String>) -> Result<T, SequenceError> {
    Err(SequenceError::Unfit { path: path.into(), problem: problem.into() })
}

/// A name with a number in it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Numbered {
    prefix: String,
    suffix: String,
    digits: String,
}

impl Numbered {
    /// Splits a file's name at its last number before the ending.
    fn split(name: &str) -> Option<Self> {
        let stem = name.rfind('.')?;
        let end = name[..stem].rfind(|c: char| c.is_ascii_digit())? + 1;
        let start = name[..end].rfind(|c: char| !c.is_ascii_digit()).map_or(0, |last| {
            // The character before the digits may be of several bytes.
            last + name[last..].chars().next().map_or(1, char::len_utf8)
        });
        Some(Self { prefix: name[..start].to_owned(), digits: name[start..end].to_owned(), suffix: name[end..].to_owned() })
    }

    fn number(&self) -> Option<u64> {
        self.digits.parse().ok()
    }
}

/// The files of a series, by number, in order and without a gap. `place` is a folder or a pattern.
///
/// # Errors
///
/// There are none, one is missing, two have one number, or a folder holds several series.
pub fn files(place: &Path) -> Result<Vec<PathBuf>, SequenceError> {
    let name = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (folder, wanted) = if place.is_dir() {
        (place.to_owned(), None)
    } else {
        let Some(wanted) = Wanted::read(&name) else {
            if place.is_file() {
                return unfit(place, "is one image: name a series with %d or * in the place of its number, or its folder");
            }
            let has_folder = place.parent().is_none_or(|parent| parent.as_os_str().is_empty() || parent.is_dir());
            let problem = if has_folder && place.extension().is_none() {
                "is neither a folder nor a pattern: check the path, or write %d or * in the place of the number, as in depth_%05d.png"
            } else {
                "is no pattern: write %d or * in the place of the number, once, as in depth_%05d.png or depth_*.png"
            };
            return unfit(place, problem);
        };
        let parent = place.parent().filter(|parent| !parent.as_os_str().is_empty());
        (parent.unwrap_or(Path::new(".")).to_owned(), Some(wanted))
    };

    let unlisted = |cause| SequenceError::Unlisted { path: folder.clone(), cause };
    let mut found: BTreeMap<u64, Numbered> = BTreeMap::new();
    for entry in std::fs::read_dir(&folder).map_err(unlisted)? {
        let entry = entry.map_err(unlisted)?;
        let name = entry.file_name();
        let Some(name) = name.to_str() else { continue };
        let numbered = match &wanted {
            Some(wanted) => wanted.matches(name),
            // What some systems hide beside each image is none.
            None => Numbered::split(name).filter(|numbered| {
                let ending = numbered.suffix.to_ascii_lowercase();
                !name.starts_with('.') && (ending.ends_with(".png") || ending.ends_with(".exr"))
            }),
        };
        let Some((number, numbered)) = numbered.and_then(|numbered| Some((numbered.number()?, numbered))) else { continue };
        if entry.path().is_dir() {
            continue;
        }
        if let Some(other) =
            found.values().next().filter(|other| (&other.prefix, &other.suffix) != (&numbered.prefix, &numbered.suffix))
        {
            let [one, other] = sorted(other.name(), name.to_owned());
            return unfit(
                &folder,
                format!("holds more than one series, {one} and {other}: name one by a pattern like {}", pattern_of(&numbered)),
            );
        }
        if let Some(other) = found.insert(number, numbered) {
            let [one, other] = sorted(other.name(), name.to_owned());
            return unfit(&folder, format!("holds {one} and {other}, both number {number}: remove one of them"));
        }
    }
    let (Some((&first, example)), Some((&last, _))) = (found.first_key_value(), found.last_key_value()) else {
        return match wanted {
            Some(_) => unfit(place, "matches no file: check the path and the pattern"),
            None => unfit(place, "holds no numbered PNG or EXR images: name another folder"),
        };
    };
    if let Some(missing) = (first..=last).find(|number| !found.contains_key(number)) {
        let width = example.digits.len();
        let name = format!("{}{missing:0width$}{}", example.prefix, example.suffix);
        return unfit(
            folder.join(name),
            format!("is missing from a series of {first} to {last}: add it, or number the images without a gap"),
        );
    }
    Ok(found.values().map(|numbered| folder.join(numbered.name())).collect())
}

fn sorted(a: String, b: String) -> [String; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

fn pattern_of(numbered: &Numbered) -> String {
    format!("{}*{}", numbered.prefix, numbered.suffix)
}

impl Numbered {
    fn name(&self) -> String {
        format!("{}{}{}", self.prefix, self.digits, self.suffix)
    }
}

/// A pattern: what stands before and after the number, and how many digits it has at the least.
struct Wanted {
    prefix: String,
    suffix: String,
    padded: Option<usize>,
}

impl Wanted {
    /// Reads `name_%05d.png`, `name_%d.png` or `name_*.png`.
    fn read(name: &str) -> Option<Self> {
        if let Some((prefix, suffix)) = name.split_once('*') {
            let one = !suffix.contains(['*', '%']) && !prefix.contains('%');
            return one.then(|| Self { prefix: prefix.to_owned(), suffix: suffix.to_owned(), padded: None });
        }
        let (prefix, rest) = name.split_once('%')?;
        let (width, suffix) = rest.split_once('d')?;
        if suffix.contains('%') || !(width.is_empty() || width.starts_with('0')) {
            return None;
        }
        let padded = if width.is_empty() { None } else { Some(width.parse().ok().filter(|digits| (1..=19).contains(digits))?) };
        Some(Self { prefix: prefix.to_owned(), suffix: suffix.to_owned(), padded })
    }

    fn matches(&self, name: &str) -> Option<Numbered> {
        let digits = name.strip_prefix(self.prefix.as_str())?.strip_suffix(self.suffix.as_str())?;
        let whole = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        // Longer numbers than the padding asks for stand without it.
        let fits = self.padded.is_none_or(|padded| digits.len() == padded || (digits.len() > padded && !digits.starts_with('0')));
        (whole && fits).then(|| Numbered { prefix: self.prefix.clone(), suffix: self.suffix.clone(), digits: digits.to_owned() })
    }
}

/// A series whose files all have been found fit by their headers.
#[derive(Clone, Debug, PartialEq)]
pub struct SequenceFiles {
    heights: Vec<PathBuf>,
    colours: Vec<PathBuf>,
    size: [u32; 2],
}

impl SequenceFiles {
    /// Finds the files that a scene's sequence names, and checks the header of each.
    ///
    /// # Errors
    ///
    /// A series has a gap, an image is unfit or of another size than the first, or there are more or fewer colours than heights.
    pub fn find(sequence: &Sequence) -> Result<Self, SequenceError> {
        let heights = files(&sequence.heights)?;
        let size = same_size(&heights, height_image::size)?;
        let colours = sequence.colours.as_deref().map(files).transpose()?.unwrap_or_default();
        if let Some(place) = sequence.colours.as_deref() {
            same_size(&colours, colour_image::size)?;
            if colours.len() != heights.len() {
                let (colours, heights) = (colours.len(), heights.len());
                return unfit(place, format!("has {colours} images for {heights} of heights: there must be as many"));
            }
        }
        Ok(Self { heights, colours, size })
    }

    /// Width and height of every image of heights.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// How many images there are.
    pub fn count(&self) -> usize {
        self.heights.len()
    }
}

/// The size of the first image, which all must have.
fn same_size(files: &[PathBuf], read: impl Fn(&Path) -> Result<[u32; 2], ImageError>) -> Result<[u32; 2], SequenceError> {
    let mut first: Option<[u32; 2]> = None;
    for path in files {
        let size = read(path)?;
        let [width, height] = *first.get_or_insert(size);
        if size != [width, height] {
            let problem = format!(
                "is {}x{} pixels, and the first of its series, {}, is {width}x{height}: scale it to that",
                size[0],
                size[1],
                files[0].file_name().unwrap_or_default().to_string_lossy()
            );
            return unfit(path, problem);
        }
    }
    // `files` never returns an empty series.
    Ok(first.unwrap_or([1, 1]))
}

/// Bytes of decoded images that a player keeps.
const CACHE_BYTES: usize = 256 << 20;

/// Plays a series: has what a moment needs, and keeps what it has decoded as far as there is room.
#[derive(Debug)]
pub struct Player {
    files: SequenceFiles,
    sequence: Sequence,
    size: [u32; 2],
    addressing: Addressing,
    heights: BTreeMap<usize, Arc<[f32]>>,
    colours: BTreeMap<usize, Arc<ColourImage>>,
    shown: Option<Arc<Images>>,
}

impl Player {
    /// A player of a scene's sequence.
    pub fn new(files: SequenceFiles, scene: &Scene, sequence: &Sequence) -> Self {
        let (size, addressing) = (scene.field.size, scene.field.addressing);
        let (heights, colours) = (BTreeMap::new(), BTreeMap::new());
        Self { files, sequence: sequence.clone(), size, addressing, heights, colours, shown: None }
    }

    /// Takes over how it is played: what has been decoded stays, unless its range changes.
    pub fn set(&mut self, sequence: &Sequence) {
        if self.sequence.range != sequence.range {
            self.heights.clear();
            self.shown = None;
        }
        self.sequence = sequence.clone();
    }

    /// Decodes every image that these times need, so that no later one fails.
    ///
    /// # Errors
    ///
    /// An image is damaged, or has a value that is no height.
    pub fn check(&mut self, times_seconds: impl Iterator<Item = f64>) -> Result<(), ImageError> {
        let mut checked = vec![false; self.files.count()];
        for time in times_seconds {
            let Between { first, second, share } = self.sequence.between(self.files.count(), time);
            for index in [Some(first), (share > 0.0).then_some(second)].into_iter().flatten() {
                if !std::mem::replace(&mut checked[index], true) {
                    self.heights_of(index)?;
                    self.colours_of(index)?;
                }
            }
            if checked.iter().all(|checked| *checked) {
                break;
            }
        }
        Ok(())
    }

    /// What a moment shows.
    ///
    /// # Errors
    ///
    /// An image is damaged, or has a value that is no height.
    pub fn at(&mut self, time_seconds: f64) -> Result<Arc<Images>, ImageError> {
        let between = self.sequence.between(self.files.count(), time_seconds);
        if let Some(shown) = self.shown.as_ref().filter(|shown| shown.between == between) {
            return Ok(shown.clone());
        }
        let Between { first, second, share } = between;
        let mut heights = self.heights_of(first)?;
        let mut colours = self.colours_of(first)?;
        if share > 0.0 && first != second {
            let later = self.heights_of(second)?;
            heights = heights.iter().zip(later.iter()).map(|(a, b)| mean(*a, *b, share)).collect();
            if let (Some(earlier), Some(later)) = (&colours, self.colours_of(second)?) {
                // Of the bytes as they stand: a cross-fade, as video players show it.
                let byte = |(a, b): (&u8, &u8)| mean(f32::from(*a), f32::from(*b), share).round() as u8;
                let rgba = earlier.rgba.iter().zip(&later.rgba).map(byte).collect();
                colours = Some(Arc::new(ColourImage { size: earlier.size, rgba }));
            }
        }
        let images = Arc::new(Images { between, heights, colours });
        self.shown = Some(images.clone());
        Ok(images)
    }

    fn heights_of(&mut self, index: usize) -> Result<Arc<[f32]>, ImageError> {
        if let Some(heights) = self.heights.get(&index) {
            return Ok(heights.clone());
        }
        let image = HeightImage::read(&self.files.heights[index], self.sequence.range)?;
        let heights: Arc<[f32]> = image.resampled(self.size, self.addressing).heights.into();
        make_room(&mut self.heights, index, heights.len() * size_of::<f32>());
        self.heights.insert(index, heights.clone());
        Ok(heights)
    }

    fn colours_of(&mut self, index: usize) -> Result<Option<Arc<ColourImage>>, ImageError> {
        let Some(path) = self.files.colours.get(index) else { return Ok(None) };
        if let Some(colours) = self.colours.get(&index) {
            return Ok(Some(colours.clone()));
        }
        let colours = Arc::new(colour_image::read(path)?);
        make_room(&mut self.colours, index, colours.rgba.len());
        self.colours.insert(index, colours.clone());
        Ok(Some(colours))
    }
}

/// Between two values, the second of which counts by `share`.
fn mean(a: f32, b: f32, share: f64) -> f32 {
    (f64::from(a) + share * (f64::from(b) - f64::from(a))) as f32
}

/// Drops what is farthest from `index` while another of so many bytes would not fit.
fn make_room<T>(kept: &mut BTreeMap<usize, T>, index: usize, bytes: usize) {
    while !kept.is_empty() && (kept.len() + 1) * bytes > CACHE_BYTES {
        let farthest = kept.keys().copied().max_by_key(|other| other.abs_diff(index));
        farthest.and_then(|farthest| kept.remove(&farthest));
    }
}
