//! One file, replaced in one step.

use std::io;
use std::path::Path;

use super::disk::{Disk, Kind, Temp};
use super::{LocalDisk, Operation, StoreError};

/// How the temporary file of a single file begins.
const PREFIX: &str = ".lobefit-file-";

/// Writes a file in one step: the path holds its old bytes or the new ones, whatever happens. Says
/// whether anything had to be written.
pub fn write(path: &Path, bytes: &[u8]) -> Result<bool, StoreError> {
    free(path)?;
    replace(&LocalDisk, path, bytes, PREFIX)
}

/// Whether [`write()`] may take the place of what is there. A file would be in the place of a device, or of a
/// link to one, for every other program; of another link it is.
///
/// # Errors
/// A device is in the way.
pub fn free(path: &Path) -> Result<(), StoreError> {
    let is_device = std::fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir());
    if is_device { Err(StoreError::InTheWay { path: path.to_owned(), what: "a device" }) } else { Ok(()) }
}

/// The same without waiting for the disk: a failure of the power may leave a file of fewer bytes.
pub(super) fn place(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    let folder = folder_of(path);
    let temp = LocalDisk.create_temp(folder, PREFIX).and_then(|mut temp| {
        write_all(&mut temp, bytes)?;
        Ok(temp)
    });
    let temp = temp.map_err(StoreError::writing(folder, Operation::Write))?;
    temp.rename(path).map_err(StoreError::writing(path, Operation::Rename))
}

/// A new folder for what another program is to read, removed with the value.
pub fn temporary() -> Result<tempfile::TempDir, StoreError> {
    tempfile::tempdir().map_err(StoreError::writing(&std::env::temp_dir(), Operation::CreateFolder))
}

/// [`write`] on any disk. The destination's folder must be there.
fn replace<D: Disk>(disk: &D, path: &Path, bytes: &[u8], prefix: &str) -> Result<bool, StoreError> {
    let Some(temp) = stage(disk, path, bytes, prefix)? else { return Ok(false) };
    temp.rename(path).map_err(StoreError::writing(path, Operation::Rename))?;
    let folder = folder_of(path);
    disk.sync_folder(folder).map_err(StoreError::writing(folder, Operation::Sync))?;
    Ok(true)
}

/// The bytes in a temporary file beside their destination, on the disk and ready to be renamed;
/// none where the destination holds them already.
pub(super) fn stage<D: Disk>(
    disk: &D,
    path: &Path,
    bytes: &[u8],
    prefix: &str,
) -> Result<Option<D::Temp>, StoreError> {
    if holds(disk, path, bytes)? {
        return Ok(None);
    }
    let folder = folder_of(path);
    let mut temp =
        disk.create_temp(folder, prefix).map_err(StoreError::writing(folder, Operation::CreateTemp))?;
    write_all(&mut temp, bytes).map_err(StoreError::writing(path, Operation::Write))?;
    temp.sync().map_err(StoreError::writing(path, Operation::Sync))?;
    Ok(Some(temp))
}

/// Whether a regular file at the path holds exactly these bytes; a folder in its place is an error.
fn holds<D: Disk>(disk: &D, path: &Path, bytes: &[u8]) -> Result<bool, StoreError> {
    match disk.look(path).map_err(StoreError::writing(path, Operation::Look))? {
        Some(Kind::Folder) => Err(StoreError::InTheWay { path: path.to_owned(), what: "a folder" }),
        Some(Kind::File) => {
            let old = disk.read(path, bytes.len() as u64 + 1);
            Ok(old.map_err(StoreError::writing(path, Operation::Read))? == bytes)
        }
        // A link is replaced by a file, so that nothing is written where it leads.
        Some(Kind::Other) | None => Ok(false),
    }
}

/// Writes everything, in as many pieces as the disk takes, going on after interruptions.
fn write_all(temp: &mut impl Temp, mut bytes: &[u8]) -> io::Result<()> {
    while !bytes.is_empty() {
        match temp.write(bytes) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(n) => bytes = bytes.get(n..).unwrap_or_default(),
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(e) => return Err(e),
        }
    }
    Ok(())
}

/// The folder of a path; the current one for a bare name.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
