//! The directory that a command writes to. Its own files there, those of its [`Owner`], are removed first where an earlier run left
//! them; anything else is left alone. A run that fails takes its files with it; one that is interrupted leaves those that are whole.

use std::fs;
use std::path::{Path, PathBuf};

use super::atomic::WriteError;
use super::manifest;
use crate::cli::Export;
use crate::interruption;

/// A comparison's table, as comma-separated values.
pub const TABLE_CSV: &str = "table.csv";

/// A comparison's table. Written last, so that its presence says "complete".
pub const TABLE_JSON: &str = "table.json";

/// The command that writes: which files are its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// `frame_N.*`, `field_N.*`, `field_N_LAYER.*` of each that can be exported, and `manifest.json`.
    Capture,
    /// `row_N.*`, `row_N_error.*`, `row_N_flip.*`, `truth_N.*`, `curve_N.*`, `table.csv` and `table.json`.
    Compare,
}

impl Owner {
    /// Whether a file of this name is the command's own, or one of these half-written by a run that was killed.
    fn owns(self, name: &str) -> bool {
        let whole = |file: &str| name.strip_prefix(file).is_some_and(|rest| rest.is_empty() || rest.starts_with(".partial-"));
        let numbered = |prefix: &str| {
            let stem = name.strip_prefix(prefix).and_then(|rest| rest.split_once('.')).map_or("", |(stem, _)| stem);
            let number = match prefix {
                "row_" => stem.strip_suffix("_error").or(stem.strip_suffix("_flip")).unwrap_or(stem),
                "field_" => Export::ALL
                    .iter()
                    .map(|export| export.suffix())
                    .find_map(|suffix| stem.strip_suffix(suffix).filter(|_| !suffix.is_empty()))
                    .unwrap_or(stem),
                _ => stem,
            };
            !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
        };
        match self {
            Self::Capture => whole(manifest::FILE_NAME) || numbered("frame_") || numbered("field_"),
            Self::Compare => {
                whole(TABLE_CSV) || whole(TABLE_JSON) || numbered("row_") || numbered("truth_") || numbered("curve_")
            }
        }
    }
}

/// An output directory, made and cleared. Unless [`OutputDir::finish`] is called, dropping it removes what the run wrote and made.
#[derive(Debug)]
pub struct OutputDir {
    path: PathBuf,
    owner: Owner,
    /// The directories that were made for it, outermost first.
    made: Vec<PathBuf>,
    finished: bool,
}

impl OutputDir {
    /// Makes the directory, with those above it, and removes the own files of an earlier run. To be called when everything else has
    /// been checked.
    ///
    /// # Errors
    ///
    /// The path is a file, or the directory cannot be made, read or cleared.
    pub fn create(path: &Path, owner: Owner) -> Result<Self, WriteError> {
        let made =
            path.ancestors().take_while(|above| !above.as_os_str().is_empty() && !above.exists()).map(PathBuf::from).collect();
        let mut directory = Self { path: path.to_owned(), owner, made, finished: false };
        directory.made.reverse();
        if path.exists() && !path.is_dir() {
            return Err(WriteError::new(path, std::io::ErrorKind::AlreadyExists.into()));
        }
        fs::create_dir_all(path).map_err(|cause| WriteError::new(path, cause))?;
        directory.clear()?;
        Ok(directory)
    }

    /// The path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The run is complete: keep what was written.
    pub fn finish(mut self) {
        self.finished = true;
    }

    fn clear(&self) -> Result<(), WriteError> {
        let entries = fs::read_dir(&self.path).map_err(|cause| WriteError::new(&self.path, cause))?;
        for entry in entries {
            let entry = entry.map_err(|cause| WriteError::new(&self.path, cause))?;
            let is_directory = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if !is_directory && entry.file_name().to_str().is_some_and(|name| self.owner.owns(name)) {
                fs::remove_file(entry.path()).map_err(|cause| WriteError::new(entry.path(), cause))?;
            }
        }
        Ok(())
    }
}

impl Drop for OutputDir {
    fn drop(&mut self) {
        if self.finished {
            return;
        }
        // The error that ended the run is on its way already: what cannot be removed now stays. Who interrupts a run need not lose
        // the files that are whole; that the last of them is missing says that there were to be more.
        if !interruption::is_asked() {
            let _ = self.clear();
        }
        for made in self.made.iter().rev() {
            // Fails, as it should, where something else lies in it.
            let _ = fs::remove_dir(made);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn only_the_own_files_go() {
        let directory = tempfile::tempdir().unwrap();
        let own = [
            "frame_00000.png",
            "frame_00001.exr",
            "frame_123456.png",
            "field_00000.exr",
            "field_00000.png",
            "field_00012_normal-gl.png",
            "field_00012_normal-dx.png",
            "field_1_relief.exr",
            "field_1_bed.exr",
            "field_1_shallow-water.exr",
            "field_1_wave.exr.partial-x1",
            "manifest.json",
            "frame_0.png.partial-x1",
        ];
        let others = [
            "frame_.png",
            "frame_a.png",
            "field_00000_mine.png",
            "field__relief.exr",
            "field_a_relief.exr",
            "frame_00000_relief.exr",
            "field_00000_relief_relief.exr",
            "frame_00000",
            "my_frame_00000.png",
            "manifest.json.bak",
            "notes.txt",
            "Frame_00000.png",
            "row_00000.png",
            "table.json",
        ];
        for name in own.iter().chain(&others) {
            fs::write(directory.path().join(name), "x").unwrap();
        }
        fs::create_dir(directory.path().join("frame_00002.d")).unwrap();
        OutputDir::create(directory.path(), Owner::Capture).unwrap().finish();
        let mut expected: Vec<&str> = others.into_iter().chain(["frame_00002.d"]).collect();
        expected.sort_unstable();
        assert_eq!(names(directory.path()), expected);
    }

    #[test]
    fn a_comparison_has_files_of_its_own() {
        let own = ["row_0.png", "row_00012_error.png", "row_00012_flip.png", "truth_00001.png", "curve_00000.png", "table.csv"];
        let more = ["table.json", "table.csv.partial-x1", "row_1_flip.png.partial-x1"];
        assert!(own.iter().chain(&more).all(|name| Owner::Compare.owns(name) && !Owner::Capture.owns(name)));
        let others = [
            "row_.png",
            "row_1_flop.png",
            "truth_1_error.png",
            "table.json.bak",
            "my_table.csv",
            "frame_00000.png",
            "manifest.json",
        ];
        assert!(!others.iter().any(|name| Owner::Compare.owns(name)));
    }

    #[test]
    fn a_failed_run_leaves_nothing_behind() {
        let directory = tempfile::tempdir().unwrap();
        let out = OutputDir::create(&directory.path().join("a/b"), Owner::Capture).unwrap();
        fs::write(out.file("frame_00000.png"), "x").unwrap();
        drop(out);
        assert_eq!(names(directory.path()), [""; 0]);

        fs::create_dir(directory.path().join("mine")).unwrap();
        fs::write(directory.path().join("mine/notes.txt"), "x").unwrap();
        let out = OutputDir::create(&directory.path().join("mine"), Owner::Capture).unwrap();
        fs::write(out.file("frame_00000.png"), "x").unwrap();
        drop(out);
        assert_eq!(names(&directory.path().join("mine")), ["notes.txt"]);
    }

    #[test]
    fn a_file_in_its_place_is_an_error() {
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("file");
        fs::write(&file, "x").unwrap();
        let error = OutputDir::create(&file, Owner::Capture).unwrap_err().to_string();
        assert!(error.contains("a file is in its place"), "{error}");
        let error = OutputDir::create(&file.join("below"), Owner::Capture).unwrap_err().to_string();
        assert!(error.contains("is a file, not a directory"), "{error}");
        assert_eq!(fs::read(&file).unwrap(), b"x");
    }
}
