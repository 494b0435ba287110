//! A file is written whole or not at all: beside its place first, then renamed into it.
//!
//! What is no file, as `/dev/stdout`, `/dev/null` or a named pipe, is never replaced by one: it is written to. A symbolic link stays
//! one, and what it points to is replaced.

use std::fs::File;
use std::io::{BufWriter, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

/// Why a file or directory could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {}", path.display(), explain(cause))]
pub struct WriteError {
    /// What was to be written.
    pub path: PathBuf,
    /// Why it was not.
    pub cause: std::io::Error,
}

impl WriteError {
    /// What could not be written, and why.
    pub fn new(path: impl Into<PathBuf>, cause: std::io::Error) -> Self {
        Self { path: path.into(), cause }
    }
}

/// The cause in words, and what to do about it.
fn explain(error: &std::io::Error) -> String {
    let advice = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "the disk is full: free some space or write elsewhere"
        }
        ErrorKind::PermissionDenied => "permission denied: choose a place that you may write to",
        ErrorKind::ReadOnlyFilesystem => "the file system is read-only: choose another place",
        ErrorKind::NotFound => "the directory does not exist: make it first or choose another place",
        ErrorKind::NotADirectory => "a part of the path is a file, not a directory: choose another place",
        ErrorKind::IsADirectory => "it is a directory: choose another name",
        ErrorKind::AlreadyExists => "a file is in its place: remove it or choose another place",
        _ => return error.to_string(),
    };
    advice.to_owned()
}

/// Writes `path` whole or not at all with `fill`.
///
/// # Errors
///
/// The file cannot be made, filled or renamed; then nothing is left of it, and what was in its place stays.
pub fn write(path: &Path, fill: impl FnOnce(&mut BufWriter<&mut File>) -> std::io::Result<()>) -> Result<(), WriteError> {
    write_inner(path, fill).map_err(|error| WriteError::new(path, error))
}

/// Finds out whether `path` could be written, before the work that it is for; leaves nothing.
///
/// # Errors
///
/// No file can be made there.
pub fn check(path: &Path) -> Result<(), WriteError> {
    // A pipe would take being opened and closed for all that is ever written to it.
    if is_special(path) { Ok(()) } else { beside(path).map(drop).map_err(|error| WriteError::new(path, error)) }
}

/// A file that is being written beside its place, over a longer time; it vanishes unless it is persisted.
#[derive(Debug)]
pub struct Partial {
    place: Place,
    path: PathBuf,
}

/// Where bytes go until they are whole.
#[derive(Debug)]
enum Place {
    /// Beside the file that they replace.
    Beside(tempfile::NamedTempFile),
    /// Into what is no file, at once.
    Into(File),
}

impl Place {
    fn of(path: &Path) -> std::io::Result<Self> {
        if is_special(path) { File::options().write(true).open(path).map(Self::Into) } else { beside(path).map(Self::Beside) }
    }

    fn file(&mut self) -> &mut File {
        match self {
            Self::Beside(file) => file.as_file_mut(),
            Self::Into(file) => file,
        }
    }

    fn persist(self, path: &Path) -> std::io::Result<()> {
        match self {
            Self::Beside(file) => file.persist(linked(path)).map(drop).map_err(|error| error.error),
            Self::Into(_) => Ok(()),
        }
    }
}

/// Whether something is there that is neither a file nor a directory.
fn is_special(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

/// What a symbolic link points to; any other path as it is.
fn linked(path: &Path) -> PathBuf {
    match std::fs::symlink_metadata(path) {
        Ok(metadata) if metadata.is_symlink() => path.canonicalize().unwrap_or_else(|_| path.to_owned()),
        _ => path.to_owned(),
    }
}

impl Partial {
    /// Begins one for this place.
    ///
    /// # Errors
    ///
    /// No file can be made there.
    pub fn beside(path: &Path) -> Result<Self, WriteError> {
        let place = Place::of(path).map_err(|error| WriteError::new(path, error))?;
        Ok(Self { place, path: path.to_owned() })
    }

    /// Puts it in its place.
    ///
    /// # Errors
    ///
    /// It cannot be renamed; then nothing is left of it, and what was in its place stays.
    pub fn persist(self) -> Result<(), WriteError> {
        self.place.persist(&self.path).map_err(|error| WriteError::new(self.path, error))
    }
}

impl std::io::Write for Partial {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.place.file().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.place.file().flush()
    }
}

fn write_inner(path: &Path, fill: impl FnOnce(&mut BufWriter<&mut File>) -> std::io::Result<()>) -> std::io::Result<()> {
    let mut place = Place::of(path)?;
    let mut writer = BufWriter::with_capacity(1 << 16, place.file());
    fill(&mut writer)?;
    writer.flush()?;
    drop(writer);
    place.persist(path)
}

/// An empty file beside the place of another, which vanishes when it is dropped.
fn beside(path: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    if path.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    let path = linked(path);
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Named after its place: should the machine fail meanwhile, the next run knows the remains as its own and removes them.
    let mut prefix = path.file_name().unwrap_or_default().to_os_string();
    prefix.push(".partial-");
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix);
    // A temporary file is its owner's alone by default; this one becomes a common file under the user's umask.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(directory).map_err(|error| match error.get_ref() {
        // The temporary name means nothing to anyone: keep the kind alone.
        Some(_) => error.kind().into(),
        None => error,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failure_leaves_nothing_and_keeps_what_was_there() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.txt");
        write(&path, |file| file.write_all(b"first")).unwrap();
        let error = write(&path, |file| {
            file.write_all(&[b'x'; 1 << 20])?;
            Err(ErrorKind::StorageFull.into())
        })
        .unwrap_err()
        .to_string();
        assert!(error.contains("a.txt") && error.contains("disk is full"), "{error}");
        assert_eq!(std::fs::read(&path).unwrap(), b"first");
        assert_eq!(names(directory.path()), ["a.txt"]);
        write(&path, |file| file.write_all(b"second")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"second");
    }

    #[test]
    fn errors_name_the_file_and_what_to_do() {
        let directory = tempfile::tempdir().unwrap();
        let missing = directory.path().join("no/such/a.txt");
        let error = write(&missing, |_| Ok(())).unwrap_err().to_string();
        assert!(error.contains("a.txt") && error.contains("does not exist"), "{error}");
        assert!(!error.contains("partial"), "{error}");

        let file = directory.path().join("file");
        std::fs::write(&file, "").unwrap();
        let error = write(&file.join("a.txt"), |_| Ok(())).unwrap_err().to_string();
        assert!(error.contains("not a directory"), "{error}");

        let error = write(directory.path(), |_| Ok(())).unwrap_err().to_string();
        assert!(error.contains("it is a directory"), "{error}");
        assert_eq!(names(directory.path()), ["file"]);
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_file_is_written_to_and_a_link_stays_one() {
        let directory = tempfile::tempdir().unwrap();
        let at = |name| directory.path().join(name);
        let pipe = at("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        check(&pipe).unwrap();
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || std::fs::read(pipe).unwrap()
        });
        write(&pipe, |file| file.write_all(b"through")).unwrap();
        assert_eq!(reader.join().unwrap(), b"through");
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || std::fs::read(pipe).unwrap()
        });
        let mut partial = Partial::beside(&pipe).unwrap();
        partial.write_all(b"line").unwrap();
        partial.persist().unwrap();
        assert_eq!(reader.join().unwrap(), b"line");
        assert!(is_special(&pipe), "a file took the pipe's place");

        std::fs::create_dir(at("elsewhere")).unwrap();
        std::fs::write(at("elsewhere/target"), "before").unwrap();
        std::os::unix::fs::symlink("elsewhere/target", at("link")).unwrap();
        write(&at("link"), |file| file.write_all(b"after")).unwrap();
        assert!(std::fs::symlink_metadata(at("link")).unwrap().is_symlink());
        assert_eq!(std::fs::read(at("elsewhere/target")).unwrap(), b"after");
        assert_eq!(names(directory.path()), ["elsewhere", "link", "pipe"]);
        assert_eq!(names(&at("elsewhere")), ["target"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_file_is_as_readable_as_any_other() {
        use std::os::unix::fs::PermissionsExt as _;
        let directory = tempfile::tempdir().unwrap();
        write(&directory.path().join("ours"), |_| Ok(())).unwrap();
        std::fs::write(directory.path().join("common"), "").unwrap();
        let mode = |name| std::fs::metadata(directory.path().join(name)).unwrap().permissions().mode();
        assert_eq!(mode("ours"), mode("common"));
    }
}
