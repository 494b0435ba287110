//! Shaders from a folder, for whoever edits them while the program runs.

use std::path::{Path, PathBuf};

use crate::gpu::Library;
use crate::gpu::shader::EMBEDDED;

/// The folder, in the working directory.
pub const FOLDER: &str = "shaders";

/// A part cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read {}: {cause}; run from the repository's root to reload its shaders", path.display())]
pub struct ShaderFolderError {
    path: PathBuf,
    cause: std::io::Error,
}

/// Reads every part of the program from `folder`.
///
/// # Errors
///
/// A part is missing or unreadable.
pub fn read(folder: &Path) -> Result<Library, ShaderFolderError> {
    let mut library = Library::embedded();
    for (name, _) in EMBEDDED {
        let path = folder.join(format!("{name}.wgsl"));
        let source = std::fs::read_to_string(&path).map_err(|cause| ShaderFolderError { path, cause })?;
        library.replace(name, source);
    }
    Ok(library)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_repositorys_own_and_says_what_is_missing() {
        assert!(read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders"))).is_ok());
        let error = read(Path::new("nowhere")).expect_err("there is no such folder");
        assert!(error.to_string().starts_with("cannot read nowhere/common/field.wgsl: "), "{error}");
    }
}
