//! The table: what was compared and what came of it, for people, spreadsheets and scripts.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use super::equal_error;
use crate::cli::Truth;
use crate::io::manifest::Adapter;
use crate::modes::statistics::{Steps, counted};
use crate::scene::Scene;
use crate::surface::{Shadow, Technique};

/// The version of the table's format that this program reads and writes.
pub const VERSION: u32 = 1;

/// A comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The format's version, [`VERSION`].
    pub version: u32,
    /// The version of the program that wrote it.
    pub program: String,
    /// What drew and timed it.
    pub adapter: Adapter,
    /// The scene, complete; its technique, shadow and camera are the rows' matter.
    pub scene: Scene,
    /// Width and height of the pictures, pixels.
    pub image_size: [u32; 2],
    /// Frames that ran before the instant that is compared.
    pub warmup: u32,
    /// Frames that were timed of each row.
    pub frames: u32,
    /// What positions are held against.
    pub truth: Truth,
    /// Where it is seen from.
    pub cameras: Vec<Viewpoint>,
    /// What came of it.
    pub rows: Vec<Row>,
}

/// A camera that stands still.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Viewpoint {
    /// The eye, metres.
    pub eye: [f64; 3],
    /// The point in the middle of the picture, metres.
    pub target: [f64; 3],
    /// Vertical field of view, degrees.
    pub vertical_fov_degrees: f64,
}

/// Errors in one unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Errors {
    /// Root of the mean square.
    pub rms: f64,
    /// 99th percentile.
    pub p99: f64,
    /// The largest.
    pub max: f64,
}

/// One technique with one shadow, from one camera, over one field.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The number of its camera, from 1.
    pub camera: usize,
    /// Width and height of the field, texels.
    pub field_size: [u32; 2],
    /// How the surface was found.
    pub technique: Technique,
    /// Samples of every view ray, where counts were swept.
    pub samples: Option<u32>,
    /// The shadow upon it.
    pub shadow: Shadow,
    /// The shadow of the true picture.
    pub truth_shadow: Shadow,
    /// Pixels where this picture and the true one show the surface: those that errors are counted over.
    pub pixels: usize,
    /// Distances between the points that a pixel shows here and in truth, in sides of a texel.
    pub position_error_texels: Errors,
    /// The same, metres.
    pub position_error_metres: Errors,
    /// Share of the pixels that hit another cell than the true one, or show the surface in one picture only.
    pub wrong_cell_share: f64,
    /// Root of the mean square difference of the light's visibility.
    pub visibility_rms: f64,
    /// ꟻLIP of the picture, 0 to 1.
    pub flip: f64,
    /// Peak signal-to-noise ratio of the picture, decibels; none where it is the true one to the last bit.
    pub psnr_db: Option<f64>,
    /// Height samples and nodes that view rays took.
    pub steps_per_pixel: Steps,
    /// Rays that visited as many nodes as they may and gave up.
    pub capped: usize,
    /// Median GPU time of the surface pass, milliseconds; none where the adapter has no timestamps.
    pub surface_ms: Option<f64>,
    /// Median GPU time of all passes that show the field as it stands.
    pub frame_ms: Option<f64>,
    /// GPU memory of all textures and buffers that the frame holds.
    pub memory_bytes: u64,
    /// Its files beside the table: the picture, its position error, its ꟻLIP, and the true picture.
    pub files: Vec<String>,
}

impl Row {
    /// What tells it from other rows.
    pub fn key(&self) -> Key {
        Key {
            camera: self.camera,
            field_size: self.field_size,
            technique: self.technique,
            samples: self.samples,
            shadow: self.shadow,
            truth_shadow: self.truth_shadow,
        }
    }
}

/// What tells one row from another.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "they are those of the row")]
pub struct Key {
    pub camera: usize,
    pub field_size: [u32; 2],
    pub technique: Technique,
    pub samples: Option<u32>,
    pub shadow: Shadow,
    pub truth_shadow: Shadow,
}

impl std::fmt::Display for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [width, height] = self.field_size;
        write!(f, "{}", self.technique.name())?;
        if let Some(samples) = self.samples {
            write!(f, " of {samples} samples")?;
        }
        write!(f, ", shadow {}, field {width}×{height}, camera {}", self.shadow.name(), self.camera)
    }
}

/// A column of the comma-separated table.
type Column = (&'static str, fn(&Row) -> String);

const COLUMNS: [Column; 26] = [
    ("camera", |row| row.camera.to_string()),
    ("field_width", |row| row.field_size[0].to_string()),
    ("field_height", |row| row.field_size[1].to_string()),
    ("technique", |row| row.technique.name().to_owned()),
    ("samples", |row| row.samples.map_or_else(String::new, |count| count.to_string())),
    ("shadow", |row| row.shadow.name().to_owned()),
    ("truth_shadow", |row| row.truth_shadow.name().to_owned()),
    ("pixels", |row| row.pixels.to_string()),
    ("position_rms_texels", |row| row.position_error_texels.rms.to_string()),
    ("position_p99_texels", |row| row.position_error_texels.p99.to_string()),
    ("position_max_texels", |row| row.position_error_texels.max.to_string()),
    ("position_rms_metres", |row| row.position_error_metres.rms.to_string()),
    ("position_p99_metres", |row| row.position_error_metres.p99.to_string()),
    ("position_max_metres", |row| row.position_error_metres.max.to_string()),
    ("wrong_cell_share", |row| row.wrong_cell_share.to_string()),
    ("visibility_rms", |row| row.visibility_rms.to_string()),
    ("flip", |row| row.flip.to_string()),
    ("psnr_db", |row| row.psnr_db.map_or_else(|| "inf".to_owned(), |decibels| decibels.to_string())),
    ("steps_mean", |row| row.steps_per_pixel.mean.to_string()),
    ("steps_p99", |row| row.steps_per_pixel.p99.to_string()),
    ("steps_max", |row| row.steps_per_pixel.max.to_string()),
    ("capped", |row| row.capped.to_string()),
    ("surface_ms", |row| row.surface_ms.map_or_else(String::new, |time| time.to_string())),
    ("frame_ms", |row| row.frame_ms.map_or_else(String::new, |time| time.to_string())),
    ("memory_bytes", |row| row.memory_bytes.to_string()),
    ("picture", |row| row.files.first().cloned().unwrap_or_default()),
];

impl Table {
    /// As comma-separated values, a line for each row below one of names. No value has a comma.
    pub fn csv(&self) -> String {
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let head = line(COLUMNS.iter().map(|(name, _)| (*name).to_owned()).collect());
        let rows = self.rows.iter().map(|row| line(COLUMNS.iter().map(|(_, cell)| cell(row)).collect()));
        head + &rows.collect::<String>()
    }

    /// For people: a table for every camera and field, below a line that says which.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let [width, height] = self.image_size;
        let times = match self.frames {
            // A median of one is itself.
            1 => "of 1 frame".to_owned(),
            frames => format!("medians of {frames} frames"),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{} ({}, {})", self.adapter.name, self.adapter.backend, self.adapter.driver);
        let _ = writeln!(
            text,
            "{}: picture {width}×{height}; positions against {}; times are {times}",
            self.scene.name,
            self.truth.name(),
        );
        let mut rows = &self.rows[..];
        while let Some(first) = rows.first() {
            let like_first = |row: &Row| (row.camera, row.field_size) == (first.camera, first.field_size);
            let (group, rest) = rows.split_at(rows.iter().take_while(|row| like_first(row)).count());
            let [field_width, field_height] = first.field_size;
            let _ = write!(text, "\nfield {field_width}×{field_height}, camera {}", first.camera);
            if let Some(Viewpoint { eye, target, vertical_fov_degrees }) = self.cameras.get(first.camera - 1) {
                let point = |[x, y, z]: [f64; 3]| format!("{}, {}, {}", short(x), short(y), short(z));
                let _ = write!(text, " at {} toward {}, {}°", point(*eye), point(*target), short(*vertical_fov_degrees));
            }
            text.push('\n');
            text.push_str(&aligned(group));
            text.push_str(&equal_error::sentences(group));
            rows = rest;
        }
        text
    }
}

/// Up to three decimals, without trailing zeros.
fn short(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The rows of one camera and field, each column as wide as its widest cell.
fn aligned(rows: &[Row]) -> String {
    let times = |time: Option<f64>| time.map_or_else(|| "–".to_owned(), |time| format!("{time:.2}"));
    // The first line of the head over the second.
    let head = [
        ("", "technique"),
        ("", "samples"),
        ("", "shadow"),
        ("RMS", "texels"),
        ("99 %", "texels"),
        ("max", "texels"),
        ("RMS", "mm"),
        ("wrong", "cells"),
        ("shadow", "RMS"),
        ("", "ꟻLIP"),
        ("PSNR", "dB"),
        ("steps", "mean"),
        ("", "99 %"),
        ("", "max"),
        ("surface", "ms"),
        ("frame", "ms"),
        ("GPU", "MB"),
    ];
    let mut lines = vec![head.map(|(above, _)| above.to_owned()), head.map(|(_, below)| below.to_owned())];
    lines.extend(rows.iter().map(|row| {
        let (error, steps) = (row.position_error_texels, row.steps_per_pixel);
        [
            row.technique.name().to_owned(),
            row.samples.map_or_else(String::new, |count| count.to_string()),
            row.shadow.name().to_owned(),
            format!("{:.4}", error.rms),
            format!("{:.4}", error.p99),
            format!("{:.3}", error.max),
            format!("{:.4}", 1e3 * row.position_error_metres.rms),
            format!("{:.3} %", 100.0 * row.wrong_cell_share),
            format!("{:.4}", row.visibility_rms),
            format!("{:.4}", row.flip),
            row.psnr_db.map_or_else(|| "same".to_owned(), |decibels| format!("{decibels:.1}")),
            format!("{:.1}", steps.mean),
            format!("{:.0}", steps.p99),
            format!("{:.0}", steps.max),
            times(row.surface_ms),
            times(row.frame_ms),
            format!("{:.1}", row.memory_bytes as f64 / 1e6),
        ]
    }));
    let widest = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..lines[0].len()).map(widest).collect();
    let sampled = rows.iter().any(|row| row.samples.is_some());
    let mut text = String::new();
    for line in &lines {
        let cells = line.iter().zip(&widths).enumerate().filter_map(|(column, (cell, width))| match column {
            // Names stand to the left, numbers to the right.
            0 | 2 => Some(format!("{cell:<width$}")),
            1 if !sampled => None,
            _ => Some(format!("{cell:>width$}")),
        });
        text.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        text.push('\n');
    }
    let capped: usize = rows.iter().map(|row| row.capped).sum();
    if capped > 0 {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{} gave up at the cap of steps: each counts as a wrong cell", counted(capped as u64, "ray"));
    }
    text
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A row with an error of so many texels, on a field whose texels measure a hundredth of a metre.
    pub fn row(technique: Technique, rms: f64) -> Row {
        Row {
            camera: 1,
            field_size: [64, 32],
            technique,
            samples: None,
            shadow: Shadow::Hard,
            truth_shadow: Shadow::Hard,
            pixels: 1000,
            position_error_texels: Errors { rms, p99: 4.0 * rms, max: 9.0 * rms },
            position_error_metres: Errors { rms: 0.01 * rms, p99: 0.04 * rms, max: 0.09 * rms },
            wrong_cell_share: 0.1 * rms,
            visibility_rms: 0.01,
            flip: 0.1,
            psnr_db: Some(30.1),
            steps_per_pixel: Steps { mean: 10.3, p99: 20.0, max: 50.0, capped: 0 },
            capped: 0,
            surface_ms: Some(8.0),
            frame_ms: Some(9.0),
            memory_bytes: 1 << 20,
            files: Vec::new(),
        }
    }

    /// A table of two rows.
    pub fn table() -> Table {
        Table {
            version: VERSION,
            program: "0.0.0".to_owned(),
            adapter: Adapter { name: "a".to_owned(), backend: "vulkan".to_owned(), driver: "d".to_owned() },
            scene: Scene { name: "relief".to_owned(), ..Scene::default() },
            image_size: [32, 24],
            warmup: 0,
            frames: 3,
            truth: Truth::Exact,
            cameras: vec![Viewpoint { eye: [0.1, 1.0 / 3.0, 0.7], target: [0.0; 3], vertical_fov_degrees: 45.0 }],
            rows: vec![row(Technique::Pom, 0.5), row(Technique::Exact, 0.0)],
        }
    }

    #[test]
    fn a_line_of_the_csv_has_a_value_for_every_name() {
        let mut table = table();
        table.rows[1].psnr_db = None;
        table.rows[1].surface_ms = None;
        let csv = table.csv();
        let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(lines.len(), 3);
        let value = |line: usize, name: &str| lines[line][lines[0].iter().position(|column| *column == name).unwrap()];
        assert!(lines.iter().all(|line| line.len() == COLUMNS.len()));
        assert_eq!(
            [value(1, "technique"), value(1, "position_rms_texels"), value(1, "position_rms_metres")],
            ["pom", "0.5", "0.005"]
        );
        assert_eq!([value(1, "samples"), value(2, "psnr_db"), value(2, "surface_ms")], ["", "inf", ""]);
    }

    #[test]
    fn columns_of_the_text_stand_under_their_names() {
        let mut table = table();
        table.rows[0].samples = Some(16);
        table.rows.push(Row { camera: 2, psnr_db: None, frame_ms: None, capped: 7, ..row(Technique::Normal, 12.5) });
        let text = table.text();
        assert_eq!(text.matches("field 64×32, camera").count(), 2, "{text}");
        assert!(text.contains("camera 1 at 0.1, 0.333, 0.7 toward 0, 0, 0, 45°"), "{text}");
        let lines: Vec<&str> = text.lines().collect();
        let head = lines.iter().position(|line| line.starts_with("technique")).unwrap();
        let ends = |line: &str, word: &str| line.find(word).map(|start| line[..start + word.len()].chars().count());
        assert_eq!(ends(lines[head], "samples"), ends(lines[head + 1], "16"), "{text}");
        assert!(text.contains("times are medians of 3 frames"), "{text}");
        table.frames = 1;
        assert!(table.text().contains("times are of 1 frame\n"), "{}", table.text());
        assert!(text.contains("7 rays gave up") && text.contains("same") && text.contains('–'), "{text}");
        assert!(text.lines().all(|line| line == line.trim_end()));
    }
}
