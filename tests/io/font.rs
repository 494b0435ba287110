//! Fonts from files.

use std::fs;
use std::path::Path;

use proptest::prelude::{ProptestConfig, any, proptest};
use rilievo::field::base::Lettering;
use rilievo::field::base::lettering::EMBEDDED_FONT;
use rilievo::io::font::lettering;

#[test]
fn a_file_serves_as_well_as_the_program_s_own() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let path = directory.path().join("font.ttf");
    fs::write(&path, EMBEDDED_FONT).expect("the directory can be written");
    let from_file = lettering("Avé\nWa", Some(&path)).expect("it is sound");
    assert_eq!(from_file, lettering("Avé\nWa", None).expect("it is sound"));
    fs::write(&path, epaint_default_fonts::HACK_REGULAR).expect("the directory can be written");
    assert_ne!(from_file, lettering("Avé\nWa", Some(&path)).expect("it is sound"));
}

#[test]
fn what_is_unfit_is_refused_in_one_sentence() {
    let directory = tempfile::tempdir().expect("there is a temporary directory");
    let path = directory.path().join("font.ttf");
    let refusal = |path: &Path, text: &str| {
        let sentence = lettering(text, Some(path)).map(|_| ()).expect_err("it is unfit").to_string();
        assert!(!sentence.contains('\n'), "{sentence}");
        sentence
    };
    assert!(refusal(&path, "a").contains("font.ttf: there is no such file"));
    assert!(refusal(directory.path(), "a").contains("directory"));
    for (bytes, part) in [
        (&b""[..], "font.ttf is empty: it must be a TTF or OTF font"),
        (b"no font, but text", "font.ttf is not a TTF or OTF font"),
        (b"wOFF....", "WOFF"),
    ] {
        fs::write(&path, bytes).expect("the directory can be written");
        assert!(refusal(&path, "a").contains(part), "{}", refusal(&path, "a"));
    }
    fs::write(&path, EMBEDDED_FONT).expect("the directory can be written");
    assert!(refusal(&path, "1 漢").contains("font.ttf has no glyph for `漢` (U+6F22)"));
    let own = lettering("漢", None).map(|_| ()).expect_err("it lacks it").to_string();
    assert!(own.starts_with("the program's own font has no glyph for `漢`"), "{own}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]
    /// Whatever is written over a font's tables, it is a sentence or finite outlines.
    #[test]
    fn damage_never_panics(place in any::<usize>(), bytes in proptest::collection::vec(any::<u8>(), 1..64), near in any::<bool>()) {
        let mut font = EMBEDDED_FONT.to_vec();
        // Half of the damage goes to the directory of tables and what follows it.
        let place = place % if near { 2000 } else { font.len() - 64 };
        font[place..place + bytes.len()].copy_from_slice(&bytes);
        match Lettering::new("Ag\nÉf", &font) {
            Ok(lettering) => assert!(lettering.segments.iter().flatten().all(|point| point.is_finite())),
            Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
        }
    }
}
