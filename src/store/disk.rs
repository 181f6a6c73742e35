//! The operations that the store needs of a file system.

use std::io;
use std::path::Path;

/// What is at a path, without following a symbolic link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A regular file.
    File,
    /// A folder.
    Folder,
    /// A symbolic link, a device, a pipe.
    Other,
}

/// A temporary file that becomes another file or disappears when dropped.
pub trait Temp {
    /// Writes some of the bytes and says how many.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize>;
    /// Brings what was written to the disk. Nothing is written after it, and no handle need stay
    /// open: a set may have more files than a process may hold.
    fn sync(&mut self) -> io::Result<()>;
    /// Takes the destination's place.
    fn rename(self, destination: &Path) -> io::Result<()>;
}

/// A file system. Every operation may fail.
pub trait Disk {
    /// Its temporary files.
    type Temp: Temp;
    /// Holds a folder's lock until dropped.
    type Lock;
    /// What is at the path; `None`: nothing.
    fn look(&self, path: &Path) -> io::Result<Option<Kind>>;
    /// The file's first `limit` bytes.
    fn read(&self, path: &Path, limit: u64) -> io::Result<Vec<u8>>;
    /// Names in a folder, sorted.
    fn list(&self, path: &Path) -> io::Result<Vec<std::ffi::OsString>>;
    /// Creates a folder whose parent is there.
    fn create_folder(&self, path: &Path) -> io::Result<()>;
    /// Creates a temporary file in a folder, its name between the prefix and [`TEMP_SUFFIX`].
    fn create_temp(&self, folder: &Path, prefix: &str) -> io::Result<Self::Temp>;
    /// Brings a folder's entries to the disk.
    fn sync_folder(&self, path: &Path) -> io::Result<()>;
    /// Removes a file or a link, never what it points to.
    fn remove(&self, path: &Path) -> io::Result<()>;
    /// Removes an empty folder.
    fn remove_folder(&self, path: &Path) -> io::Result<()>;
    /// Locks a folder; `None` where another process holds it.
    fn lock(&self, folder: &Path) -> io::Result<Option<Self::Lock>>;
}

/// How the names of temporary files end.
pub const TEMP_SUFFIX: &str = ".tmp";
