//! Lettering: text and a font to outlines, in units of the font's em.
//!
//! harfrust shapes a line (kerning, ligatures, marks, scripts that run from the right), skrifa draws its glyphs. Lines stand below
//! one another by the font's own line height, each centred by its ink.

use std::collections::{BTreeMap, HashMap};

use glam::DVec2;
use harfrust::{ShapeOptions, ShaperData, UnicodeBuffer};
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::Metrics;
use skrifa::outline::{DrawSettings, OutlineGlyphCollection, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider as _};

/// The font that comes with the program: Ubuntu Light, which its licence (UFL 1.0) allows to embed.
pub const EMBEDDED_FONT: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

/// A cubic Bézier segment: lines and quadratics are cubics too.
pub type Cubic = [DVec2; 4];

/// The outlines of a text: closed contours, filled where their winding number is not zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Lettering {
    /// Their segments, in em, x to the right and y down.
    pub segments: Vec<Cubic>,
    /// The least and the largest coordinates of the ink, from the segments' control points.
    pub bounds: [DVec2; 2],
}

/// Why a text has no outlines. The sentence's subject, the font, is the caller's.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LetteringError {
    /// The bytes are no font.
    #[error("{0}")]
    NoFont(String),
    /// The font has no glyph for some characters.
    #[error("has no glyph for {0}: choose another font, or other characters")]
    Lacks(String),
}

impl Lettering {
    /// Sets a text in a font.
    ///
    /// # Errors
    ///
    /// The bytes are no font, or it lacks glyphs that the text needs.
    pub fn new(text: &str, font: &[u8]) -> Result<Self, LetteringError> {
        let font = open(font)?;
        let metrics = Metrics::new(&font, Size::unscaled(), LocationRef::default());
        let per_em = 1.0 / f64::from(metrics.units_per_em.max(1));
        let line_height = f64::from(metrics.ascent - metrics.descent + metrics.leading);
        // Damaged tables may say anything; letters must not fall on top of one another for it.
        let line_height = if line_height.is_finite() && line_height * per_em > 0.5 { line_height * per_em } else { 1.2 };

        let shaper = ShaperData::new(&font);
        let shaper = shaper.shaper(&font).build();
        let mut glyphs = Glyphs { outlines: font.outline_glyphs(), drawn: HashMap::new() };
        let charmap = font.charmap();
        let mut lacking = Vec::new();
        let mut segments: Vec<Cubic> = Vec::new();
        for (number, line) in text.lines().enumerate() {
            let mut buffer = UnicodeBuffer::new();
            buffer.push_str(line);
            buffer.guess_segment_properties();
            let shaped = shaper.shape(buffer, ShapeOptions::new());
            let mut pen = DVec2::ZERO;
            let mut of_line: Vec<Cubic> = Vec::new();
            // Where each cluster of characters begins in the line; whether anything is drawn for it, and whether a glyph is missing.
            let mut clusters: BTreeMap<usize, (bool, bool)> = BTreeMap::new();
            for (glyph, position) in shaped.glyph_infos().iter().zip(shaped.glyph_positions()) {
                let outline = glyphs.outline(glyph.glyph_id)?;
                let cluster = clusters.entry(glyph.cluster as usize).or_insert((false, false));
                *cluster = (cluster.0 || !outline.is_empty(), cluster.1 || glyph.glyph_id == 0);
                let at = pen + DVec2::new(position.x_offset.into(), (-position.y_offset).into());
                of_line.extend(outline.iter().map(|cubic| cubic.map(|point| (point + at) * per_em)));
                pen += DVec2::new(position.x_advance.into(), (-position.y_advance).into());
            }
            let ends = clusters.keys().skip(1).copied().chain([line.len()]).collect::<Vec<_>>();
            for ((start, (drawn, missing)), end) in clusters.into_iter().zip(ends) {
                let seen = || line[start..end].chars().filter(|character| !is_blank(*character));
                if missing || (!drawn && seen().next().is_some()) {
                    let unmapped = seen().find(|character| charmap.map(*character).is_none());
                    let named = unmapped.or_else(|| seen().next()).unwrap_or('\u{fffd}');
                    if !lacking.contains(&named) {
                        lacking.push(named);
                    }
                }
            }
            if let Some([low, high]) = bounds(&of_line) {
                let shift = DVec2::new(-0.5 * (low.x + high.x), number as f64 * line_height);
                segments.extend(of_line.iter().map(|cubic| cubic.map(|point| point + shift)));
            }
        }
        if !lacking.is_empty() {
            return Err(LetteringError::Lacks(name_all(&lacking)));
        }
        match bounds(&segments) {
            Some([low, high]) if (high - low).is_finite() && (high - low).min_element() > 0.0 => {
                Ok(Self { segments, bounds: [low, high] })
            }
            _ => Err(LetteringError::NoFont("draws nothing for this text: choose another font".to_owned())),
        }
    }
}

/// The font in these bytes, or the first of a collection.
fn open(bytes: &[u8]) -> Result<FontRef<'_>, LetteringError> {
    let no_font = |problem: &str| LetteringError::NoFont(problem.to_owned());
    match bytes {
        [] => return Err(no_font("is empty: it must be a TTF or OTF font")),
        [b'w', b'O', b'F', b'F' | b'2', ..] => return Err(no_font("is a WOFF font for browsers: convert it to TTF or OTF")),
        [0x80, 1, ..] | [b'%', b'!', ..] => return Err(no_font("is a Type 1 font: convert it to TTF or OTF")),
        _ => {}
    }
    let font = FontRef::from_index(bytes, 0).map_err(|_| no_font("is not a TTF or OTF font, or is damaged: choose another"))?;
    if !font.charmap().has_map() || font.outline_glyphs().format().is_none() {
        return Err(no_font("has no outlines of characters, or is damaged: choose another font"));
    }
    Ok(font)
}

/// Outlines of glyphs in font units, each drawn once.
struct Glyphs<'a> {
    outlines: OutlineGlyphCollection<'a>,
    drawn: HashMap<u32, Vec<Cubic>>,
}

impl Glyphs<'_> {
    fn outline(&mut self, id: u32) -> Result<&[Cubic], LetteringError> {
        if !self.drawn.contains_key(&id) {
            let mut pen = Pen::default();
            if let Some(glyph) = self.outlines.get(GlyphId::new(id)) {
                let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
                glyph
                    .draw(settings, &mut pen)
                    .map_err(|error| LetteringError::NoFont(format!("is damaged ({error}): choose another font")))?;
                pen.close();
            }
            self.drawn.insert(id, pen.segments);
        }
        Ok(&self.drawn[&id])
    }
}

/// Collects cubics, y down.
#[derive(Default)]
struct Pen {
    segments: Vec<Cubic>,
    start: DVec2,
    at: DVec2,
}

fn point(x: f32, y: f32) -> DVec2 {
    DVec2::new(x.into(), (-y).into())
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.close();
        self.start = point(x, y);
        self.at = self.start;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let end = point(x, y);
        self.segments.push([self.at, self.at.lerp(end, 1.0 / 3.0), self.at.lerp(end, 2.0 / 3.0), end]);
        self.at = end;
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        let (control, end) = (point(cx, cy), point(x, y));
        self.segments.push([self.at, self.at.lerp(control, 2.0 / 3.0), end.lerp(control, 2.0 / 3.0), end]);
        self.at = end;
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let end = point(x, y);
        self.segments.push([self.at, point(cx0, cy0), point(cx1, cy1), end]);
        self.at = end;
    }

    fn close(&mut self) {
        // An open contour would leak its inside along a whole row.
        if self.at != self.start {
            let (from, end) = (self.at, self.start);
            self.segments.push([from, from.lerp(end, 1.0 / 3.0), from.lerp(end, 2.0 / 3.0), end]);
            self.at = end;
        }
    }
}

fn bounds(segments: &[Cubic]) -> Option<[DVec2; 2]> {
    let mut points = segments.iter().flatten();
    let first = *points.next()?;
    Some(points.fold([first, first], |[low, high], point| [low.min(*point), high.max(*point)]))
}

/// Whether nothing is drawn for a character by right: spaces, and what Unicode says to ignore (joiners, marks of direction, selectors
/// of variants).
fn is_blank(character: char) -> bool {
    character.is_whitespace()
        || matches!(
            character,
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{e0000}'..='\u{e0fff}'
        )
}

/// The first few characters, each with its code.
fn name_all(characters: &[char]) -> String {
    const NAMED: usize = 5;
    let mut names: Vec<String> =
        characters.iter().take(NAMED).map(|character| format!("`{character}` (U+{:04X})", u32::from(*character))).collect();
    if characters.len() > NAMED {
        names.push(format!("{} more", characters.len() - NAMED));
    }
    crate::suggest::enumerate(&names.iter().map(String::as_str).collect::<Vec<_>>(), "and")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width(text: &str) -> f64 {
        let [low, high] = Lettering::new(text, EMBEDDED_FONT).expect("the font is sound").bounds;
        high.x - low.x
    }

    #[test]
    fn letters_are_kerned() {
        // Each pair stands closer than the sum of its letters' advances would have it, which "HH" has.
        let pair = |text: &str| width(text) - 0.5 * (width(&text[..1].repeat(2)) + width(&text[1..].repeat(2)));
        assert!(pair("HH").abs() < 1e-9);
        for text in ["AV", "To", "Ty"] {
            assert!(pair(text) < -0.03, "{text}: {}", pair(text));
        }
    }

    #[test]
    fn lines_stand_below_one_another_each_in_the_middle() {
        let one = Lettering::new("wide", EMBEDDED_FONT).expect("the font is sound");
        let two = Lettering::new("wide\nil", EMBEDDED_FONT).expect("the font is sound");
        assert_eq!(two.segments[..one.segments.len()], one.segments[..]);
        let [low, high] = bounds(&two.segments[one.segments.len()..]).expect("two letters");
        assert!((low.x + high.x).abs() < 1e-9 && (one.bounds[0].x + one.bounds[1].x).abs() < 1e-9);
        assert!(low.y > one.bounds[1].y, "the second line begins at {}, the first ends at {}", low.y, one.bounds[1].y);
        // A line of nothing takes its room.
        let gap = Lettering::new("wide\n\nil", EMBEDDED_FONT).expect("the font is sound");
        assert!(gap.bounds[1].y > two.bounds[1].y + 0.9);
    }

    #[test]
    fn what_a_font_lacks_is_named() {
        for (text, part) in [
            ("a漢b漢", "has no glyph for `漢` (U+6F22): "),
            ("x\u{1F600}\u{5B57}", "`\u{1F600}` (U+1F600) and `字` (U+5B57)"),
            ("漢字漢一二三四五", "(U+4E09) and 2 more"),
        ] {
            let sentence = Lettering::new(text, EMBEDDED_FONT).map(|_| ()).expect_err(text).to_string();
            assert!(sentence.contains(part), "{text}: {sentence}");
        }
        // What is blank by right is not missed; composed and decomposed letters are one.
        let joined = Lettering::new("a\u{200d}b\u{ad}", EMBEDDED_FONT).expect("the font is sound");
        assert_eq!(joined.bounds, Lettering::new("ab", EMBEDDED_FONT).expect("the font is sound").bounds);
        assert_eq!(Lettering::new("e\u{301}", EMBEDDED_FONT), Lettering::new("é", EMBEDDED_FONT));
    }

    #[test]
    fn what_is_no_font_says_so() {
        let truncated = &EMBEDDED_FONT[..EMBEDDED_FONT.len() / 3];
        for bytes in [&b""[..], b"wOF2....", b"%!PS-AdobeFont", b"no font at all", &EMBEDDED_FONT[..100], truncated] {
            let sentence = Lettering::new("Rilievo", bytes).map(|_| ()).expect_err("it is unfit").to_string();
            assert!(sentence.contains("font") && !sentence.contains('\n'), "{sentence}");
        }
    }
}
