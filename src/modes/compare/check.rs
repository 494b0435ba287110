//! `--check`: a table against an earlier one. What got worse, by how much, against which tolerance, in one sentence.

use std::fs;
use std::path::{Path, PathBuf};

use super::table::{Key, Row, Table, VERSION};
use crate::io::height_image::explain;
use crate::scene::{Base, Scene};

/// No table is longer: what is must be another kind of file.
const BYTES_MAX: u64 = 64 << 20;

/// Why the table does not hold.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The earlier table cannot be read.
    #[error("cannot read the table {}: {}", path.display(), explain(cause))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// It is no table, or one that says nothing about this run.
    #[error("{} {problem}", path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// What is the matter, and what to do about it.
        problem: String,
    },
    /// Something got worse.
    #[error("{0}")]
    Worse(String),
}

/// An earlier table.
#[derive(Clone, Debug, PartialEq)]
pub struct Earlier {
    path: PathBuf,
    table: Table,
}

impl Earlier {
    /// Reads one.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or is no table of this version.
    pub fn read(path: &Path) -> Result<Self, CheckError> {
        let unreadable = |cause| CheckError::Unreadable { path: path.to_owned(), cause };
        let unfit = |problem: String| CheckError::Unfit { path: path.to_owned(), problem };
        let metadata = fs::metadata(path).map_err(unreadable)?;
        if metadata.is_dir() {
            return Err(unreadable(std::io::ErrorKind::IsADirectory.into()));
        }
        if metadata.len() > BYTES_MAX {
            return Err(unfit(format!("has {} bytes, and no table has more than {BYTES_MAX}: name another", metadata.len())));
        }
        let bytes = fs::read(path).map_err(unreadable)?;
        let no_table = "name one that `rilievo compare --json` wrote";
        let value: serde_json::Value = serde_json::from_slice(&bytes).map_err(|error| {
            unfit(match error.is_eof() {
                true => format!("ends too early, in line {}: {no_table}", error.line()),
                false => format!("is not JSON ({error}): {no_table}"),
            })
        })?;
        match value.get("version").map(serde_json::Value::as_u64) {
            Some(Some(version)) if version == u64::from(VERSION) => {}
            Some(Some(version)) => {
                let made = format!("is of version {version}, and this program compares with version {VERSION}");
                return Err(unfit(format!("{made}: make a new one with `rilievo compare --json`")));
            }
            _ => return Err(unfit(format!("is no table, for it says no version: {no_table}"))),
        }
        let table: Table = serde_json::from_value(value).map_err(|error| unfit(format!("is no table ({error}): {no_table}")))?;
        if table.rows.is_empty() {
            return Err(unfit(format!("has no rows: {no_table}")));
        }
        Ok(Self { path: path.to_owned(), table })
    }

    /// Whether a run that makes these rows can be held against it: the same scene, seen in the same way, and no row left out.
    ///
    /// # Errors
    ///
    /// It cannot; the error says what differs.
    pub fn fits(&self, run: &Table, keys: &[Key]) -> Result<(), CheckError> {
        let unfit = |problem: String| Err(CheckError::Unfit { path: self.path.clone(), problem });
        // Numbers that went through JSON are compared with numbers that did.
        let run = through_json(run);
        let earlier = &self.table;
        if earlier.scene.name != run.scene.name {
            return unfit(format!("is of the scene {}, and this is {}: compare the same", earlier.scene.name, run.scene.name));
        }
        let differs = |what: &str, earlier: String, now: String| {
            unfit(format!("is of {what} {earlier}, and this run of {now}: compare the same, or make a new table"))
        };
        let size = |[width, height]: [u32; 2]| format!("{width}×{height}");
        if earlier.image_size != run.image_size {
            return differs("pictures of", size(earlier.image_size), size(run.image_size));
        }
        if earlier.warmup != run.warmup {
            return differs("warm-up", earlier.warmup.to_string(), run.warmup.to_string());
        }
        if earlier.truth != run.truth {
            return differs("truth", earlier.truth.name().to_owned(), run.truth.name().to_owned());
        }
        if earlier.cameras != run.cameras {
            return unfit("is of other cameras than this run: compare from the same, or make a new table".to_owned());
        }
        if let Some(row) = earlier.rows.iter().find(|row| !keys.contains(&row.key())) {
            return unfit(format!(
                "has a row that this run does not make ({}): compare the same, or make a new table",
                row.key()
            ));
        }
        if let Some(key) = first_difference(&content(&earlier.scene), &content(&run.scene)) {
            return unfit(format!("is of another content of the scene, `{key}` differs: compare the same, or make a new table"));
        }
        Ok(())
    }

    /// Whether the table is no worse.
    ///
    /// # Errors
    ///
    /// It is; the error names the figure that got worse by most, in times of what is tolerated.
    pub fn holds(&self, run: &Table) -> Result<(), CheckError> {
        let same_adapter = self.table.adapter == run.adapter;
        let mut worse: Vec<(f64, String)> = Vec::new();
        for earlier in &self.table.rows {
            let Some(now) = run.rows.iter().find(|row| row.key() == earlier.key()) else { continue };
            for measure in MEASURES.iter().filter(|measure| same_adapter || !measure.of_adapter) {
                let (Some(was), Some(is)) = ((measure.value)(earlier), (measure.value)(now)) else { continue };
                let excess = measure.excess(was, is);
                if excess > 1.0 {
                    let Measure { name, unit, .. } = measure;
                    let tolerance = measure.tolerance(was);
                    let path = self.path.display();
                    worse.push((
                        excess,
                        format!(
                            "{}: {name} is {is:.4}{unit} and was {was:.4} in {path}, which tolerates {tolerance:.4}",
                            now.key()
                        ),
                    ));
                }
            }
        }
        let others = worse.len().saturating_sub(1);
        let Some((_, worst)) = worse.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(()) };
        let others = match others {
            0 => String::new(),
            1 => ", and one other figure got worse too".to_owned(),
            _ => format!(", and {others} other figures got worse too"),
        };
        Err(CheckError::Worse(format!("{worst}{others}: find out why, or make a new table with --json")))
    }
}

/// What must be the same of two scenes: everything but what rows choose, what a camera that is named replaces, and words.
fn content(scene: &Scene) -> serde_json::Value {
    let mut scene = scene.clone();
    let plain = Scene::default();
    scene.camera = plain.camera;
    scene.trace.technique = plain.trace.technique;
    scene.trace.shadow = plain.trace.shadow;
    scene.description = String::new();
    if let Base::Image { path, .. } = &mut scene.base {
        // The same image may be reached by another way.
        *path = path.file_name().map(PathBuf::from).unwrap_or_default();
    }
    // A scene is plain data: it has a JSON.
    serde_json::to_value(scene).unwrap_or_default()
}

/// The name, with its tables, of the first value that is not the same.
fn first_difference(a: &serde_json::Value, b: &serde_json::Value) -> Option<String> {
    match (a, b) {
        (serde_json::Value::Object(a), serde_json::Value::Object(b)) => {
            let nothing = serde_json::Value::Null;
            a.keys().chain(b.keys()).find_map(|key| {
                let below = first_difference(a.get(key).unwrap_or(&nothing), b.get(key).unwrap_or(&nothing))?;
                Some(if below.is_empty() { key.clone() } else { format!("{key}.{below}") })
            })
        }
        _ => (a != b).then(String::new),
    }
}

/// A table as it is read back: JSON's parser may miss the last bit of a number.
fn through_json(table: &Table) -> Table {
    let back = serde_json::to_string(table).and_then(|text| serde_json::from_str(&text));
    back.unwrap_or_else(|_| table.clone())
}

/// A figure of a row and what is tolerated of it: a share of what it was, and an amount.
struct Measure {
    name: &'static str,
    unit: &'static str,
    value: fn(&Row) -> Option<f64>,
    share: f64,
    amount: f64,
    /// Whether more is better.
    more: bool,
    /// Whether another adapter may have quite another.
    of_adapter: bool,
}

impl Measure {
    /// The worst value that is tolerated.
    fn tolerance(&self, was: f64) -> f64 {
        let slack = self.share * was + self.amount;
        if self.more { was - slack } else { was + slack }
    }

    /// By how much it got worse, in times of what is tolerated.
    fn excess(&self, was: f64, is: f64) -> f64 {
        let worse = if self.more { was - is } else { is - was };
        worse / (self.share * was + self.amount)
    }
}

const fn measure(name: &'static str, unit: &'static str, value: fn(&Row) -> Option<f64>, share: f64, amount: f64) -> Measure {
    Measure { name, unit, value, share, amount, more: false, of_adapter: false }
}

/// Adapters round differently and so move a hit by some 1e-4 texels; where a ray grazes, by any distance, and it takes a few
/// nodes more or less. A hundredth of each figure covers what so few pixels do, but for the largest error, which may be one pixel's:
/// that is held on the same adapter only.
const MEASURES: [Measure; 14] = [
    measure("the RMS position error", " texels", |row| Some(row.position_error_texels.rms), 0.01, 1e-3),
    measure("the 99th percentile of the position error", " texels", |row| Some(row.position_error_texels.p99), 0.01, 1e-3),
    Measure {
        of_adapter: true,
        ..measure("the largest position error", " texels", |row| Some(row.position_error_texels.max), 0.01, 1e-2)
    },
    measure("the share of wrong cells", " %", |row| Some(100.0 * row.wrong_cell_share), 0.01, 0.02),
    measure("the RMS error of the light's visibility", "", |row| Some(row.visibility_rms), 0.01, 1e-3),
    measure("ꟻLIP", "", |row| Some(row.flip), 0.01, 1e-3),
    // The same to the last bit is no better than 70 dB, a level of one in a few pixels: rounding.
    Measure { more: true, ..measure("the PSNR", " dB", |row| Some(row.psnr_db.unwrap_or(70.0).min(70.0)), 0.0, 0.2) },
    measure("the mean of the steps a pixel", "", |row| Some(row.steps_per_pixel.mean), 0.01, 0.01),
    measure("the 99th percentile of the steps a pixel", "", |row| Some(row.steps_per_pixel.p99), 0.02, 1.0),
    measure("the most steps of a pixel", "", |row| Some(row.steps_per_pixel.max), 0.05, 2.0),
    measure("the number of rays that gave up", "", |row| Some(row.capped as f64), 0.0, 0.5),
    measure("GPU memory", " MB", |row| Some(row.memory_bytes as f64 / 1e6), 0.01, 0.1),
    // Machines are busy at times: only what takes three times as long is surely slower.
    Measure { of_adapter: true, ..measure("the time of the surface pass", " ms", |row| row.surface_ms, 2.0, 1.0) },
    Measure { of_adapter: true, ..measure("the time of the frame", " ms", |row| row.frame_ms, 2.0, 1.0) },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Truth;
    use crate::modes::compare::table::tests::{row, table};
    use crate::surface::Technique;

    fn keys(table: &Table) -> Vec<Key> {
        table.rows.iter().map(Row::key).collect()
    }

    fn written(table: &Table) -> (tempfile::TempDir, PathBuf) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("t.json");
        fs::write(&path, serde_json::to_string_pretty(table).unwrap()).unwrap();
        (directory, path)
    }

    fn check(earlier: &Table, run: &Table) -> Result<(), String> {
        let (_directory, path) = written(earlier);
        let earlier = Earlier::read(&path).map_err(|error| error.to_string())?;
        earlier.fits(run, &keys(run)).and_then(|()| earlier.holds(run)).map_err(|error| {
            let sentence = error.to_string();
            assert!(!sentence.contains('\n') && sentence.contains("t.json"), "{sentence}");
            sentence
        })
    }

    #[test]
    fn a_table_holds_against_itself() {
        assert_eq!(check(&table(), &table()), Ok(()));
    }

    #[test]
    fn what_got_worse_is_named() {
        type Change = fn(&mut Row);
        let changes: [(Change, &str); 13] = [
            (
                |row| row.position_error_texels.rms *= 1.02,
                "pom, shadow hard, field 64×32, camera 1: the RMS position error is 0.51",
            ),
            (|row| row.position_error_texels.p99 *= 1.02, "the 99th percentile of the position error"),
            (|row| row.position_error_texels.max *= 1.02, "the largest position error"),
            (|row| row.wrong_cell_share *= 1.02, "wrong cells"),
            (|row| row.visibility_rms += 0.002, "visibility"),
            (|row| row.flip += 0.003, "ꟻLIP"),
            (|row| row.psnr_db = Some(29.8), "PSNR is 29.8000 dB and was 30.1000"),
            (|row| row.steps_per_pixel.mean *= 1.02, "the mean of the steps"),
            (|row| row.steps_per_pixel.p99 += 2.0, "the 99th percentile of the steps"),
            (|row| row.steps_per_pixel.max *= 1.2, "the most steps"),
            (|row| row.capped = 1, "gave up"),
            (|row| row.memory_bytes *= 2, "GPU memory"),
            (|row| row.surface_ms = Some(26.0), "the time of the surface pass"),
        ];
        for (change, part) in changes {
            let mut run = table();
            change(&mut run.rows[0]);
            let sentence = check(&table(), &run).expect_err(part);
            assert!(sentence.contains(part), "{sentence}");
            // The other way round it got better.
            assert_eq!(check(&run, &table()), Ok(()), "{part}");
        }
    }

    #[test]
    fn the_worst_is_told_and_the_others_counted() {
        let mut run = table();
        run.rows[0].position_error_texels.rms *= 1.02;
        run.rows[1].wrong_cell_share = 0.5;
        run.rows[1].flip = 0.5;
        let sentence = check(&table(), &run).unwrap_err();
        assert!(sentence.contains("exact, shadow hard") && sentence.contains("and 2 other figures"), "{sentence}");
    }

    #[test]
    fn times_are_held_on_the_same_adapter_only() {
        let mut run = table();
        run.rows[0].frame_ms = Some(1e3);
        assert!(check(&table(), &run).unwrap_err().contains("the time of the frame"));
        run.adapter.driver = "another".to_owned();
        assert_eq!(check(&table(), &run), Ok(()));
        run.rows[0].frame_ms = None;
        assert_eq!(check(&table(), &run), Ok(()));
    }

    #[test]
    fn the_same_picture_may_round_but_not_change() {
        let mut earlier = table();
        earlier.rows[1].psnr_db = None;
        let mut run = earlier.clone();
        run.rows[1].psnr_db = Some(80.0);
        assert_eq!(check(&earlier, &run), Ok(()));
        run.rows[1].psnr_db = Some(60.0);
        assert!(check(&earlier, &run).is_err());
    }

    #[test]
    fn a_table_of_something_else_is_no_measure() {
        type Change = fn(&mut Table);
        let changes: [(Change, &str); 8] = [
            (|table| table.scene.name = "ripples".to_owned(), "is of the scene relief, and this is ripples"),
            (|table| table.image_size = [32, 25], "is of pictures of 32×24, and this run of 32×25"),
            (|table| table.warmup = 7, "warm-up 0"),
            (|table| table.truth = Truth::Reference, "truth exact"),
            (|table| table.cameras[0].eye[1] += 1e-9, "other cameras"),
            (|table| table.scene.plane.depth_metres = 0.2, "`plane.depth_metres` differs"),
            (|table| table.scene.base = Base::Bricks {}, "`base.height` differs"),
            (|table| table.rows.truncate(1), "exact, shadow hard, field 64×32, camera 1"),
        ];
        for (change, part) in changes {
            let mut run = table();
            change(&mut run);
            let sentence = check(&table(), &run).expect_err(part);
            assert!(sentence.contains(part), "{sentence}");
        }
        // What is more than before cannot be held against anything.
        let mut run = table();
        run.rows.push(row(Technique::Normal, 9.0));
        run.scene.trace.technique = Technique::Pom;
        assert_eq!(check(&table(), &run), Ok(()));
    }

    #[test]
    fn a_file_that_is_no_table_says_why() {
        let (_directory, path) = written(&table());
        let whole = fs::read_to_string(&path).unwrap();
        let text = |text: &str| {
            fs::write(&path, text).unwrap();
            let sentence = Earlier::read(&path).expect_err(text).to_string();
            assert!(sentence.contains("t.json") && !sentence.contains('\n'), "{sentence}");
            sentence
        };
        assert!(text("").contains("ends too early"));
        for cut in [1, whole.len() / 3, whole.len() - 3] {
            let sentence = text(&whole[..cut]);
            assert!(sentence.contains("ends too early"), "{sentence}");
        }
        assert!(text("table\n").contains("is not JSON"));
        assert!(text("[1, 2]").contains("says no version"));
        assert!(text("{\"version\": \"1\"}").contains("says no version"));
        assert!(text(&whole.replacen("\"version\": 1,", "\"version\": 2,", 1)).contains("is of version 2"));
        assert!(text("{\"version\": 1}").contains("missing field"));
        assert!(text(&whole.replacen("\"pixels\": 1000", "\"pixels\": -1", 1)).contains("is no table"));
        assert!(text(&whole.replacen("\"frames\": 3", "\"frame\": 3", 1)).contains("`frame`"));
        let none = Table { rows: Vec::new(), ..table() };
        assert!(text(&serde_json::to_string(&none).unwrap()).contains("has no rows"));
        let directory = path.parent().unwrap();
        assert!(Earlier::read(directory).unwrap_err().to_string().contains("directory"));
        assert!(Earlier::read(&directory.join("missing.json")).unwrap_err().to_string().contains("no such file"));
    }
}
