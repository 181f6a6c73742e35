//! Parts of files, and files that another one names.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::{Operation, StoreError, inside};

/// `length` bytes of a file from byte `at` on.
///
/// # Errors
/// A file that cannot be read, or ends before.
pub fn read_part(path: &Path, [at, length]: [u64; 2]) -> Result<Vec<u8>, StoreError> {
    let read = || {
        let mut file = File::open(path)?;
        file.seek(SeekFrom::Start(at))?;
        let mut bytes = Vec::new();
        file.take(length).read_to_end(&mut bytes)?;
        let is_whole = bytes.len() as u64 == length;
        is_whole
            .then_some(bytes)
            .ok_or_else(|| io::Error::other("the file ends before the part that is asked for"))
    };
    read().map_err(StoreError::reading(path, Operation::Read))
}

/// The file of a relative path inside a folder: a regular one, which no link leads out of the folder.
///
/// # Errors
/// One that is not there, that leads out of the folder, or that is no file.
pub fn beside(folder: &Path, name: &str) -> Result<PathBuf, StoreError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = inside(folder, name)?;
    let real = |path: &Path| fs::canonicalize(path).map_err(StoreError::reading(path, Operation::Look));
    let (folder, file) = (real(folder)?, real(&path)?);
    if !file.starts_with(&folder) || !file.is_file() {
        return Err(StoreError::Outside { name: name.escape_debug().to_string(), writing: false });
    }
    Ok(file)
}
