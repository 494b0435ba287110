//! Arguments to [`Command`]: pure, no file is opened and nothing is printed here.
//!
//! What can be refused by reading the arguments alone is refused here, in one sentence ([`Refusal`]), with exit code 2. Names of
//! scenes are content, not arguments: `io::scene_file` refuses those.

mod common;
mod compare;
mod display;
mod export;
mod modes;
mod refusal;
#[cfg(test)]
mod tests;
mod values;

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

pub use common::{CommonOptions, MachineOptions};
pub use compare::{CompareOptions, Truth};
pub use display::DisplayOptions;
pub use export::Export;
pub use modes::{AdaptersOptions, CaptureOptions, Channel, LiveOptions, ResumeOptions, StressOptions};
pub use refusal::Refusal;

/// What the user asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// A window.
    Live(LiveOptions),
    /// Pictures and channels, to files.
    Capture(CaptureOptions),
    /// Numbers.
    Stress(StressOptions),
    /// Techniques and shadows against the truth.
    Compare(CompareOptions),
    /// The list of GPU adapters.
    Adapters(AdaptersOptions),
    /// The list of scenes.
    Scenes,
}

impl Command {
    /// How much it shall tell of itself on stderr.
    pub fn verbosity(&self) -> Verbosity {
        match self {
            Self::Live(options) => options.common.machine.verbosity(),
            Self::Capture(options) => options.common.machine.verbosity(),
            Self::Stress(options) => options.common.machine.verbosity(),
            Self::Compare(options) => options.common.machine.verbosity(),
            Self::Adapters(options) => options.machine.verbosity(),
            Self::Scenes => Verbosity::Normal,
        }
    }
}

/// How much the program tells of itself on stderr.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verbosity {
    /// Errors only.
    Quiet,
    /// Notes and warnings.
    Normal,
    /// Its own details, and other crates' warnings.
    Verbose,
}

/// A GPU laboratory for height fields that move.
///
/// Simulates, stamps, derives, traces and shows a height field, every frame. Without a mode it opens a window.
#[derive(Parser, Debug)]
#[command(name = "rilievo", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    mode: Option<Mode>,
    #[command(flatten)]
    live: LiveOptions,
}

#[derive(Subcommand, Debug)]
enum Mode {
    /// Show a scene in a window (the default)
    Live(LiveOptions),
    /// Write pictures and channels to files, without a window
    Capture(CaptureOptions),
    /// Measure frames, without a window
    Stress(StressOptions),
    /// Hold techniques and shadows against the truth: errors, steps, times, memory
    Compare(CompareOptions),
    /// List the GPU adapters
    Adapters(AdaptersOptions),
    /// List the scenes
    Scenes,
}

/// The names of the modes.
const MODES: [&str; 6] = ["live", "capture", "stress", "compare", "adapters", "scenes"];

/// Reads the arguments, the program's own name first.
pub fn parse(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<Command, Refusal> {
    let arguments = Arguments::try_parse_from(arguments).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => Refusal::Told(error.render().to_string()),
        _ => Refusal::Refused(refusal::sentence(&error)),
    })?;
    Ok(match arguments.mode {
        None => Command::Live(arguments.live),
        Some(Mode::Live(options)) => Command::Live(options),
        Some(Mode::Capture(options)) => Command::Capture(options),
        Some(Mode::Stress(options)) => Command::Stress(options),
        Some(Mode::Compare(options)) => options.checked().map(Command::Compare).map_err(Refusal::Refused)?,
        Some(Mode::Adapters(options)) => Command::Adapters(options),
        Some(Mode::Scenes) => Command::Scenes,
    })
}
