//! What each mode takes besides.

use std::path::PathBuf;

use clap::Args;

use super::values::{channel, dt, export, export_help, frames, stamp_radius, stamps, whole_u32};
use super::{CommonOptions, Export, MachineOptions};

/// Where a run begins, if not at the start of its scene.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct ResumeOptions {
    /// Do what a journal says that --record wrote: its scene, its time, its strokes; flags may change how that is seen, not the
    /// field [default: none]
    #[arg(long, value_name = "FILE", help_heading = "Scene")]
    #[arg(conflicts_with_all = ["scene", "seed", "field", "height", "height_range", "text", "font", "albedo", "depth", "mesh"])]
    #[arg(conflicts_with_all = ["sequence", "sequence_colour", "sequence_rate", "sequence_playback", "sequence_interpolate"])]
    pub replay: Option<PathBuf>,

    /// Go on from what --save-state wrote, of the same scene, seed and size [default: none, the scene's start]
    #[arg(long, value_name = "FILE", conflicts_with = "replay", help_heading = "Scene")]
    pub load_state: Option<PathBuf>,
}

/// `rilievo live`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct LiveOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    /// Where it begins.
    #[command(flatten)]
    pub resume: ResumeOptions,

    /// Record everything that is done to the field in a journal, whole when the window closes [default: none]
    #[arg(long, value_name = "FILE", conflicts_with_all = ["replay", "load_state"])]
    pub record: Option<PathBuf>,

    /// Save all that the field remembers when the window closes, for --load-state [default: none]
    #[arg(long, value_name = "FILE")]
    pub save_state: Option<PathBuf>,

    /// Run this many frames at a fixed step of 1/60 s, then exit [default: none, until the window is closed]
    #[arg(long, value_name = "N", value_parser = frames, requires = "out", allow_negative_numbers = true)]
    pub frames: Option<u32>,

    /// Write the last of those frames here, as capture would [default: none, nothing is written]
    #[arg(long, value_name = "DIR", requires = "frames")]
    pub out: Option<PathBuf>,
}

/// `rilievo capture`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CaptureOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    /// Where it begins.
    #[command(flatten)]
    pub resume: ResumeOptions,

    /// Save all that the field remembers after the last frame, for --load-state [default: none]
    #[arg(long, value_name = "FILE")]
    pub save_state: Option<PathBuf>,

    /// The directory to write to; frames, fields and the manifest of an earlier run are removed from it
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,

    /// How many frames to write
    #[arg(long, value_name = "N", value_parser = frames, default_value = "1", allow_negative_numbers = true)]
    pub frames: u32,

    /// Time from frame to frame, seconds; a journal has its own [default: 1/60]
    #[arg(long, value_name = "SECONDS", value_parser = dt, default_value = "0.016666666666666666", hide_default_value = true)]
    #[arg(allow_negative_numbers = true, conflicts_with = "replay")]
    pub dt: f64,

    /// How many frames to run before the first that is written
    #[arg(long, value_name = "N", value_parser = whole_u32, default_value = "0", allow_negative_numbers = true)]
    pub warmup: u32,

    /// Which channels to write, of color, position, normal, uv, height, visibility, steps and lod; color always is
    #[arg(long, value_name = "LIST", value_parser = channel, value_delimiter = ',', default_value = "color")]
    channels: Vec<Channel>,

    #[arg(long, value_name = "LIST", value_parser = export, value_delimiter = ',', help = export_help())]
    export: Vec<Export>,
}

impl CaptureOptions {
    /// What to export, each once, in the order of [`Export::ALL`].
    pub fn exports(&self) -> Vec<Export> {
        Export::ALL.into_iter().filter(|export| self.export.contains(export)).collect()
    }

    /// Whether this channel was asked for. Colour always is.
    pub fn wants(&self, channel: Channel) -> bool {
        channel == Channel::Color || self.channels.contains(&channel)
    }

    /// The channels to write, each once, in the order of [`Channel::ALL`].
    pub fn channels(&self) -> Vec<Channel> {
        Channel::ALL.iter().copied().filter(|&channel| self.wants(channel)).collect()
    }
}

/// What can be captured of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The picture.
    Color,
    /// World position, metres.
    Position,
    /// World normal, as shaded.
    Normal,
    /// Texture coordinates, not wrapped.
    Uv,
    /// Height at the point that is seen, and the height field itself.
    Height,
    /// How much of the light arrives.
    Visibility,
    /// Height samples and nodes visited.
    Steps,
    /// Level of detail.
    Lod,
}

impl Channel {
    /// All of them, in the order of the documentation.
    pub const ALL: [Self; 8] =
        [Self::Color, Self::Position, Self::Normal, Self::Uv, Self::Height, Self::Visibility, Self::Steps, Self::Lod];

    /// Its name on the command line and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Position => "position",
            Self::Normal => "normal",
            Self::Uv => "uv",
            Self::Height => "height",
            Self::Visibility => "visibility",
            Self::Steps => "steps",
            Self::Lod => "lod",
        }
    }
}

/// `rilievo stress`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct StressOptions {
    /// What every mode takes.
    #[command(flatten)]
    pub common: CommonOptions,

    /// Where it begins.
    #[command(flatten)]
    pub resume: ResumeOptions,

    /// How many frames to measure
    #[arg(long, value_name = "N", value_parser = frames, default_value = "60", allow_negative_numbers = true)]
    pub frames: u32,

    /// How many seeded discs to stamp each frame
    #[arg(long, value_name = "K", value_parser = stamps, default_value = "0", allow_negative_numbers = true)]
    pub stamps: u32,

    /// Their radius, texels
    #[arg(long, value_name = "TEXELS", value_parser = stamp_radius, default_value = "8", allow_negative_numbers = true)]
    pub stamp_radius: f32,

    /// Also write the numbers here [default: none, they are only printed]
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

/// `rilievo adapters`.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct AdaptersOptions {
    /// Which of them, and how much to tell.
    #[command(flatten)]
    pub machine: MachineOptions,
}
