//! The directory that a command writes to. Its own files there are `frame_N.*`, `field_N.*` and `manifest.json`: those of an earlier
//! run are removed first, anything else is left alone. A run that fails takes its files with it.

use std::fs;
use std::path::{Path, PathBuf};

use super::atomic::WriteError;
use super::manifest;

/// An output directory, made and cleared. Unless [`OutputDir::finish`] is called, dropping it removes what the run wrote and made.
#[derive(Debug)]
pub struct OutputDir {
    path: PathBuf,
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
    pub fn create(path: &Path) -> Result<Self, WriteError> {
        let made =
            path.ancestors().take_while(|above| !above.as_os_str().is_empty() && !above.exists()).map(PathBuf::from).collect();
        let mut directory = Self { path: path.to_owned(), made, finished: false };
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
            if !is_directory && entry.file_name().to_str().is_some_and(is_own) {
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
        // The error that ended the run is on its way already: what cannot be removed now stays.
        let _ = self.clear();
        for made in self.made.iter().rev() {
            // Fails, as it should, where something else lies in it.
            let _ = fs::remove_dir(made);
        }
    }
}

/// Whether a file of this name is a command's own: `frame_N.*`, `field_N.*`, `manifest.json`, or one of these half-written by a run
/// that was killed.
fn is_own(name: &str) -> bool {
    let numbered = |rest: &str| {
        rest.split_once('.').is_some_and(|(number, _)| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
    };
    name == manifest::FILE_NAME
        || name.strip_prefix(manifest::FILE_NAME).is_some_and(|rest| rest.starts_with(".partial-"))
        || name.strip_prefix("frame_").is_some_and(numbered)
        || name.strip_prefix("field_").is_some_and(numbered)
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
            "manifest.json",
            "frame_0.png.partial-x1",
        ];
        let others = [
            "frame_.png",
            "frame_a.png",
            "frame_00000",
            "my_frame_00000.png",
            "manifest.json.bak",
            "notes.txt",
            "Frame_00000.png",
        ];
        for name in own.iter().chain(&others) {
            fs::write(directory.path().join(name), "x").unwrap();
        }
        fs::create_dir(directory.path().join("frame_00002.d")).unwrap();
        OutputDir::create(directory.path()).unwrap().finish();
        let mut expected: Vec<&str> = others.into_iter().chain(["frame_00002.d"]).collect();
        expected.sort_unstable();
        assert_eq!(names(directory.path()), expected);
    }

    #[test]
    fn a_failed_run_leaves_nothing_behind() {
        let directory = tempfile::tempdir().unwrap();
        let out = OutputDir::create(&directory.path().join("a/b")).unwrap();
        fs::write(out.file("frame_00000.png"), "x").unwrap();
        drop(out);
        assert_eq!(names(directory.path()), [""; 0]);

        fs::create_dir(directory.path().join("mine")).unwrap();
        fs::write(directory.path().join("mine/notes.txt"), "x").unwrap();
        let out = OutputDir::create(&directory.path().join("mine")).unwrap();
        fs::write(out.file("frame_00000.png"), "x").unwrap();
        drop(out);
        assert_eq!(names(&directory.path().join("mine")), ["notes.txt"]);
    }

    #[test]
    fn a_file_in_its_place_is_an_error() {
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("file");
        fs::write(&file, "x").unwrap();
        let error = OutputDir::create(&file).unwrap_err().to_string();
        assert!(error.contains("a file is in its place"), "{error}");
        let error = OutputDir::create(&file.join("below")).unwrap_err().to_string();
        assert!(error.contains("is a file, not a directory"), "{error}");
        assert_eq!(fs::read(&file).unwrap(), b"x");
    }
}
