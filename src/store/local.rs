//! The file system of the machine.

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::Path;

use super::disk::{Disk, Kind, TEMP_SUFFIX, Temp};

/// The file system of the machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct LocalDisk;

/// A temporary file of the machine; its handle is closed once it is synchronised.
#[derive(Debug)]
pub struct LocalTemp {
    file: Option<File>,
    pub(super) path: tempfile::TempPath,
}

impl Temp for LocalTemp {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let closed = || io::Error::other("the temporary file was synchronised already");
        self.file.as_mut().ok_or_else(closed)?.write(bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        self.file.take().map_or(Ok(()), |file| file.sync_all())
    }

    fn rename(self, destination: &Path) -> io::Result<()> {
        self.path.persist(destination).map_err(|e| e.error)
    }
}

impl Disk for LocalDisk {
    type Temp = LocalTemp;
    type Lock = File;

    fn look(&self, path: &Path) -> io::Result<Option<Kind>> {
        match fs::symlink_metadata(path) {
            Ok(data) if data.is_file() => Ok(Some(Kind::File)),
            Ok(data) if data.is_dir() => Ok(Some(Kind::Folder)),
            Ok(_) => Ok(Some(Kind::Other)),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(e),
        }
    }

    fn read(&self, path: &Path, limit: u64) -> io::Result<Vec<u8>> {
        // The length that the metadata tells is not asked: it can lie, and the file can grow.
        let mut bytes = Vec::new();
        File::open(path)?.take(limit).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    fn list(&self, path: &Path) -> io::Result<Vec<OsString>> {
        let mut names: Vec<OsString> =
            fs::read_dir(path)?.map(|entry| entry.map(|e| e.file_name())).collect::<io::Result<_>>()?;
        names.sort();
        Ok(names)
    }

    fn create_folder(&self, path: &Path) -> io::Result<()> {
        fs::create_dir(path)
    }

    fn create_temp(&self, folder: &Path, prefix: &str) -> io::Result<LocalTemp> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(prefix).suffix(TEMP_SUFFIX);
        readable_by_all(&mut builder);
        let (file, path) = builder.tempfile_in(folder).map_err(bare)?.into_parts();
        Ok(LocalTemp { file: Some(file), path })
    }

    fn sync_folder(&self, path: &Path) -> io::Result<()> {
        // Elsewhere a folder cannot be opened as a file, and renaming is durable without.
        if cfg!(unix) { File::open(path)?.sync_all() } else { Ok(()) }
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        fs::remove_dir(path)
    }

    fn lock(&self, folder: &Path) -> io::Result<Option<File>> {
        let handle = lockable(folder)?;
        match handle.try_lock() {
            Ok(()) => Ok(Some(handle)),
            Err(TryLockError::WouldBlock) => Ok(None),
            // A file system without locks: two bakes at once still cannot tear a file.
            Err(TryLockError::Error(e)) if e.kind() == io::ErrorKind::Unsupported => Ok(Some(handle)),
            Err(TryLockError::Error(e)) => Err(e),
        }
    }
}

/// What the system said, without the random path that tempfile adds to it.
fn bare(error: io::Error) -> io::Error {
    let text = error.to_string();
    match text.rsplit_once(" at path ") {
        Some((said, _)) => io::Error::new(error.kind(), said.to_owned()),
        None => error,
    }
}

/// tempfile creates files readable by their owner only, and renaming keeps that.
fn readable_by_all(builder: &mut tempfile::Builder) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o644));
    }
    #[cfg(not(unix))]
    let _ = builder;
}

/// What stands for the folder in locking: where possible the folder itself, so that no file is left
/// behind.
#[cfg(unix)]
fn lockable(folder: &Path) -> io::Result<File> {
    File::open(folder)
}

/// What stands for the folder in locking: a file that stays, since removing it would let two
/// processes lock two files.
#[cfg(not(unix))]
fn lockable(folder: &Path) -> io::Result<File> {
    File::options().create(true).truncate(false).write(true).open(folder.join(".lobefit.lock"))
}
