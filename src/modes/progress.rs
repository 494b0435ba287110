//! How far a headless run has come: a bar on a terminal, nothing where nobody watches.

use std::io::IsTerminal as _;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of so many frames on stderr.
pub fn bar(frames: u64, what: &str, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(frames);
    // The template is a constant without a fault; if a later version disagrees, its own default will do.
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} frames, {eta} left") {
        bar.set_style(style);
    }
    bar.with_message(what.to_owned())
}
