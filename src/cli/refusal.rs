//! Why there is no command to run.

use clap::error::{ContextKind, ContextValue, ErrorKind};

use super::MODES;
use crate::suggest;

/// Why there is no command to run.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Help or the version was asked for: print this on stdout, exit with 0.
    Told(String),
    /// The arguments make no sense: print this sentence on stderr, exit with 2.
    Refused(String),
}

/// clap explains in paragraphs; here is the same in one sentence.
pub(super) fn sentence(error: &clap::Error) -> String {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        Some(ContextValue::Strings(texts)) => Some(texts.join("`, `")),
        _ => None,
    };
    // clap says `--size <WxH>`; the flag alone reads better.
    let flag = |kind| text(kind).map(|argument| argument.split(" <").next().unwrap_or_default().to_owned());
    let argument = flag(ContextKind::InvalidArg).unwrap_or_default();
    // One sentence is one line, whatever someone writes into an argument.
    let value = text(ContextKind::InvalidValue).unwrap_or_default().replace(char::is_control, "\u{fffd}");
    match error.kind() {
        ErrorKind::UnknownArgument => match text(ContextKind::SuggestedArg) {
            Some(near) => format!("unknown argument `{argument}`: did you mean `{near}`, of those that `--help` lists?"),
            None => format!("unknown argument `{argument}`: `--help` lists those there are"),
        },
        ErrorKind::InvalidSubcommand => {
            let name = text(ContextKind::InvalidSubcommand).unwrap_or_default();
            suggest::unknown("mode", &name, &MODES)
        }
        ErrorKind::ValueValidation => {
            let cause = std::error::Error::source(error).map(ToString::to_string).unwrap_or_default();
            match (cause.contains("known are") || cause.starts_with("unknown "), value.is_empty()) {
                (true, _) => cause,
                (false, true) => format!("`{argument}` is empty: give it a value"),
                (false, false) => format!("`{argument}` cannot be `{value}`: {cause}"),
            }
        }
        ErrorKind::InvalidValue => format!("`{argument}` needs a value"),
        ErrorKind::MissingRequiredArgument => format!("`{argument}` is missing: `--help` says what it is for"),
        ErrorKind::ArgumentConflict => match flag(ContextKind::PriorArg) {
            Some(prior) if argument.is_empty() => {
                format!("`{prior}` stands before the mode: write the mode first, as in `rilievo capture --out DIR {prior}`")
            }
            Some(prior) if prior == argument => format!("`{argument}` is given twice: give it once"),
            Some(prior) => format!("`{argument}` and `{prior}` exclude each other: give one of them"),
            None => format!("`{argument}` contradicts another argument: `--help` says what it is for"),
        },
        // Every other kind is rare; its first line is a sentence already.
        _ => {
            let rendered = error.render().to_string();
            let line = rendered.lines().next().unwrap_or_default();
            line.strip_prefix("error: ").unwrap_or(line).to_owned()
        }
    }
}
