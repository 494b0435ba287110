//! `rilievo compare`.

use std::path::PathBuf;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::CommonOptions;
use super::values::{camera, field_width, frames, samples, shadow, shadows_help, technique, techniques_help, truth, whole_u32};
use crate::io::scene_file::CameraPlacement;
use crate::surface::{Shadow, Technique};

/// `rilievo compare`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CompareOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    #[arg(long, value_name = "LIST", value_parser = technique, value_delimiter = ',', conflicts_with = "technique")]
    #[arg(help = techniques_help())]
    techniques: Vec<Technique>,

    #[arg(long, value_name = "LIST", value_parser = shadow, value_delimiter = ',', conflicts_with = "shadow")]
    #[arg(help = shadows_help())]
    shadows: Vec<Shadow>,

    /// Compare from here: eye and target, metres; may be given several times [default: the scene's camera, or that of --camera]
    #[arg(long, value_name = "EX,EY,EZ,TX,TY,TZ", value_parser = camera, allow_hyphen_values = true, conflicts_with = "camera")]
    pub view_from: Vec<CameraPlacement>,

    /// What positions are held against: exact, on the GPU, or reference, in double precision on the processor
    #[arg(long, value_name = "TRUTH", value_parser = truth, default_value = "exact")]
    pub truth: Truth,

    /// The shadow of the true picture [default: where one shadow is compared, that one; among several, the truest there is]
    #[arg(long, value_name = "S", value_parser = shadow)]
    pub truth_shadow: Option<Shadow>,

    /// How many frames to time of each row
    #[arg(long, value_name = "N", value_parser = frames, default_value = "15", allow_negative_numbers = true)]
    pub frames: u32,

    /// How many frames of 1/60 s to run before the instant that is compared, as capture would
    #[arg(long, value_name = "N", value_parser = whole_u32, default_value = "0", allow_negative_numbers = true)]
    pub warmup: u32,

    /// Sample counts: a row for each of them and each technique that has such a count; beside exact, a line says which count brings
    /// its RMS error under half a texel, and at what cost [default: none, the scene's]
    #[arg(long, value_name = "LIST", value_parser = samples, value_delimiter = ',', conflicts_with = "sweep_fields")]
    #[arg(allow_negative_numbers = true)]
    pub sweep_samples: Vec<u32>,

    /// Widths of the field, texels: the same content resampled to each, the height keeping its aspect [default: none, its own]
    #[arg(long, value_name = "LIST", value_parser = field_width, value_delimiter = ',', allow_negative_numbers = true)]
    pub sweep_fields: Vec<u32>,

    /// Also write here a picture of every row and of its error, the truth, the curves of a sweep, table.csv and table.json; those
    /// of an earlier run are removed [default: none, the table is only printed]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Also write the table here, as comma-separated values [default: none]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,

    /// Also write the table here, as JSON [default: none]
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    /// Hold the table against an earlier one, in JSON, and fail where it got worse [default: none]
    #[arg(long, value_name = "FILE")]
    pub check: Option<PathBuf>,
}

impl CompareOptions {
    /// The techniques to compare, each once.
    pub fn techniques(&self) -> Vec<Technique> {
        match (&self.techniques[..], self.common.technique) {
            ([], Some(technique)) => vec![technique],
            ([], None) => Technique::ALL.to_vec(),
            (listed, _) => each_once(listed),
        }
    }

    /// The shadows to compare each of them with, each once; none given means the scene's.
    pub fn shadows(&self, of_scene: Shadow) -> Vec<Shadow> {
        if self.shadows.is_empty() { vec![of_scene] } else { each_once(&self.shadows) }
    }

    /// The sample counts, ascending.
    pub fn sweep_samples(&self) -> Vec<u32> {
        ascending(&self.sweep_samples)
    }

    /// The widths of the field, ascending.
    pub fn sweep_fields(&self) -> Vec<u32> {
        ascending(&self.sweep_fields)
    }

    /// Refuses what contradicts itself in a way that clap cannot say.
    pub(super) fn checked(self) -> Result<Self, String> {
        let same = |a: &Option<PathBuf>, b: &Option<PathBuf>| a.is_some() && a == b;
        if same(&self.json, &self.check) || same(&self.csv, &self.check) {
            return Err("the table to check against would be written over: give `--check` another file".to_owned());
        }
        if same(&self.json, &self.csv) {
            return Err("`--json` and `--csv` name the same file: give them two".to_owned());
        }
        if !self.common.display.is_plain() {
            return Err("compare makes pictures of its own: leave out `--view` and `--split`".to_owned());
        }
        Ok(self)
    }
}

fn each_once<T: Copy + PartialEq>(listed: &[T]) -> Vec<T> {
    let mut once = Vec::new();
    for item in listed {
        if !once.contains(item) {
            once.push(*item);
        }
    }
    once
}

fn ascending(numbers: &[u32]) -> Vec<u32> {
    let mut numbers = numbers.to_vec();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// What positions are held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Truth {
    /// The technique `exact`, on the GPU.
    Exact,
    /// [`crate::reference`], in f64 on the processor.
    Reference,
}

impl Truth {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Exact, Self::Reference];

    /// Its name on the command line and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Reference => "reference",
        }
    }
}
