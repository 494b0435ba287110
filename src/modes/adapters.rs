//! Adapters: what there is to run on.

use std::fmt::Write as _;

use super::ModeError;
use crate::gpu::{Preference, adapter};

/// The adapters that the preference allows, best first, a line each: the first usable one is what the other modes take.
///
/// # Errors
///
/// None is usable.
pub fn list(preference: &Preference) -> Result<String, ModeError> {
    let found = pollster::block_on(adapter::enumerate(preference));
    let mut lines = String::new();
    let (mut incapable, mut others) = (Vec::new(), Vec::new());
    let mut usable = false;
    for (_, adapter) in &found {
        let description = adapter::describe(&adapter.get_info());
        if !preference.allows(&adapter.get_info()) {
            others.push(description);
            continue;
        }
        // Writing to a String cannot fail.
        let _ = match adapter::shortcoming(adapter) {
            None if usable => writeln!(lines, "  {description}"),
            None => {
                usable = true;
                writeln!(lines, "* {description}")
            }
            Some(lacks) => {
                incapable.push(format!("{description}: {lacks}"));
                writeln!(lines, "  {description}, not usable: {lacks}")
            }
        };
    }
    match usable {
        true => Ok(lines),
        false => Err(adapter::nothing(preference, &incapable, &others).into()),
    }
}
