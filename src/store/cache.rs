//! Results that need not be made twice, each in a file named by the hash of what determines it.
//!
//! Entries are whole or not there: a file is renamed into place, and one whose own hash does not
//! hold is as good as none. So processes may share the folder, killing one of them harms none, and
//! nobody waits for the disk.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::SystemTime;

use super::write::place;
use super::{Operation, StoreError, TEMP_SUFFIX, read};

/// How the names of entries end.
const ENDING: &str = ".entry";

/// Bytes of the hash before the content.
const HASH: usize = 32;

/// Most bytes of all entries together: beyond them the ones that were read longest ago go.
const BYTES: u64 = 1 << 30;

/// Bytes that are put there between two looks at how many there are.
const STEP: u64 = 1 << 24;

/// The variable of the environment that names the folder.
pub const VARIABLE: &str = "LOBEFIT_CACHE";

/// A folder of results.
#[derive(Debug)]
pub struct Cache {
    folder: PathBuf,
    failed: OnceLock<StoreError>,
    /// Bytes that this process has put there.
    added: AtomicU64,
}

/// What a folder of results holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Held {
    /// Entries.
    pub entries: usize,
    /// Their bytes.
    pub bytes: u64,
}

impl Cache {
    /// The user's: the folder that [`VARIABLE`] names, else `lobefit` among the system's caches;
    /// none on a system without such a place.
    pub fn of_user() -> Option<Cache> {
        let named = std::env::var_os(VARIABLE).filter(|name| !name.is_empty()).map(PathBuf::from);
        named.or_else(|| Some(dirs::cache_dir()?.join("lobefit"))).map(Cache::at)
    }

    /// In a folder, which is made when something is put there.
    pub fn at(folder: PathBuf) -> Cache {
        Cache { folder, failed: OnceLock::new(), added: AtomicU64::new(0) }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The content of a key, if a whole entry is there.
    pub fn get(&self, key: &str) -> Option<Vec<u8>> {
        let path = self.path(key);
        let mut bytes = read(&path, BYTES).ok()?;
        let content = bytes.split_off(bytes.len().min(HASH));
        if blake3::hash(&content).as_bytes()[..] != bytes[..] {
            return None;
        }
        // The time tells which entries go first; without it this one goes earlier.
        let _ = File::options().write(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        Some(content)
    }

    /// Puts a content there. A cache that cannot be written spares no work and harms none: the first
    /// reason is [`Cache::failed`].
    pub fn put(&self, key: &str, content: &[u8]) {
        if let Err(error) = self.try_put(key, content) {
            let _ = self.failed.set(error);
        }
    }

    fn try_put(&self, key: &str, content: &[u8]) -> Result<(), StoreError> {
        let io = |operation| StoreError::writing(&self.folder, operation);
        fs::create_dir_all(&self.folder).map_err(io(Operation::CreateFolder))?;
        let bytes = [blake3::hash(content).as_bytes(), content].concat();
        place(&self.path(key), &bytes)?;
        // The folder is listed now and then.
        let more = bytes.len() as u64;
        let before = self.added.fetch_add(more, Ordering::Relaxed);
        if before == 0 || (before + more) / STEP > before / STEP {
            self.bound(BYTES)?;
        }
        Ok(())
    }

    /// Why nothing could be put there, where that was so.
    pub fn failed(&self) -> Option<&StoreError> {
        self.failed.get()
    }

    fn path(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}{ENDING}"))
    }

    /// Entries with their times and sizes; none where there is no folder.
    fn entries(&self) -> io::Result<Vec<(SystemTime, PathBuf, u64)>> {
        let mut entries = Vec::new();
        let list = match fs::read_dir(&self.folder) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(entries),
            list => list?,
        };
        for entry in list {
            let path = entry?.path();
            // Another process may have removed it meanwhile.
            let Ok(data) = fs::metadata(&path) else { continue };
            let name = path.to_string_lossy();
            // A process that was killed leaves the file that it was writing.
            if [ENDING, TEMP_SUFFIX].iter().any(|ending| name.ends_with(ending)) && data.is_file() {
                entries.push((data.modified()?, path, data.len()));
            }
        }
        entries.sort();
        Ok(entries)
    }

    /// Removes the entries that were read longest ago, until the others are within so many bytes.
    ///
    /// # Errors
    /// A folder that cannot be listed, an entry that cannot be removed.
    pub fn bound(&self, most: u64) -> Result<(), StoreError> {
        let entries = self.entries().map_err(StoreError::writing(&self.folder, Operation::List))?;
        let mut total: u64 = entries.iter().map(|(_, _, bytes)| bytes).sum();
        for (_, path, bytes) in entries {
            if total <= most {
                break;
            }
            removed(&path).map_err(StoreError::writing(&path, Operation::Remove))?;
            total -= bytes;
        }
        Ok(())
    }

    /// What it holds.
    ///
    /// # Errors
    /// A folder that cannot be listed.
    pub fn held(&self) -> Result<Held, StoreError> {
        let entries = self.entries().map_err(StoreError::reading(&self.folder, Operation::List))?;
        Ok(Held { entries: entries.len(), bytes: entries.iter().map(|(_, _, bytes)| bytes).sum() })
    }

    /// Removes every entry, and says what they were.
    ///
    /// # Errors
    /// An entry that cannot be removed.
    pub fn clear(&self) -> Result<Held, StoreError> {
        let held = self.held()?;
        self.bound(0)?;
        Ok(held)
    }
}

/// Removes a file that may be gone already.
fn removed(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(e),
        _ => Ok(()),
    }
}
