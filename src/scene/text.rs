//! A sign: text in relief.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// The most characters that a text may have: beyond it letters are smaller than the texels of any field.
const CHARACTERS_MAX: usize = 1000;

/// Text in relief, as large as fits, in the middle of the field. Lengths are shares of the letters' own size (the font's em), so that
/// another text is the same sign with other words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Text {
    /// What it says; `\n` begins another line.
    pub text: String,
    /// A TTF or OTF file; absent: the font that comes with the program, Ubuntu Light.
    pub font: Option<PathBuf>,
    /// Whether the letters stand out or are cut in.
    pub relief: TextRelief,
    /// Share of the field's width or height, whichever it reaches first, that the text takes.
    pub size: f32,
    /// How far strokes grow to either side, in em; negative makes them thinner.
    pub weight: f32,
    /// Width of the slope from a letter's outline inward, in em. One wider than half a stroke makes a ridge, or a groove.
    pub bevel: f32,
    /// Width of a line round the sign, as a share of the field's shorter side; 0: none.
    pub frame: f32,
    /// How rough the ground is between raised letters, or the face round those cut in, as a share of the depth.
    pub grain: f32,
}

/// Whether letters stand out or are cut in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TextRelief {
    /// They stand out of a ground at height 0.
    Raised,
    /// They are cut into a face at height 1.
    Engraved,
}

impl Default for Text {
    fn default() -> Self {
        Self {
            text: "Rilievo".to_owned(),
            font: None,
            relief: TextRelief::Raised,
            size: 0.86,
            weight: 0.02,
            bevel: 0.03,
            frame: 0.0,
            grain: 0.0,
        }
    }
}

/// Checks that there is something to write, in characters that can be written; else says what to do.
///
/// # Errors
///
/// It is empty or too long, or has a control character other than a line's end.
pub fn check_text(text: &str) -> Result<(), String> {
    if text.chars().all(char::is_whitespace) {
        return Err("it has no letters, write at least one".to_owned());
    }
    let lines = text.lines().flat_map(str::chars);
    if let Some(control) = lines.clone().find(|character| character.is_control()) {
        let code = u32::from(control);
        return Err(format!("it has the control character U+{code:04X}, leave that out (\\n begins another line)"));
    }
    let count = lines.count();
    if count > CHARACTERS_MAX {
        return Err(format!("it has {count} characters, write at most {CHARACTERS_MAX}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::check_text;

    #[test]
    fn a_text_has_letters_and_no_control_characters() {
        for text in ["a", "two\nlines", "windows\r\nlines", " é 漢 \n\n.", &"x".repeat(1000)] {
            assert_eq!(check_text(text), Ok(()), "{text:?}");
        }
        for (text, part) in [
            ("", "no letters"),
            (" \n\u{a0}", "no letters"),
            ("a\tb", "U+0009"),
            ("a\rb", "U+000D"),
            ("a\u{7f}", "U+007F"),
            ("\u{9b}31m", "U+009B"),
            (&"x".repeat(1001), "1001 characters"),
        ] {
            let sentence = check_text(text).expect_err(text);
            assert!(sentence.contains(part) && !sentence.contains(char::is_control), "{text:?}: {sentence}");
        }
    }
}
