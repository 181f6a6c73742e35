//! The second phase of writing a set: what was prepared takes its place.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::bundle::{MANIFEST, Written};
use super::disk::{Disk, Kind, Temp};
use super::write::folder_of;
use super::{Operation, StoreError};

/// A file that waits beside its destination.
struct Waiting<T> {
    name: String,
    path: PathBuf,
    temp: T,
}

/// A set that is on the disk and not yet in its place. Dropping it removes its temporary files.
pub(super) struct Prepared<T> {
    files: Vec<Waiting<T>>,
    manifest: Option<Waiting<T>>,
    /// Files to remove: name and path.
    pub stale: Vec<(String, PathBuf)>,
    /// Folders to remove where they are empty then.
    pub left: Vec<PathBuf>,
    /// What is known of the outcome.
    pub done: Written,
}

impl<T> Default for Prepared<T> {
    fn default() -> Self {
        Prepared {
            files: Vec::new(),
            manifest: None,
            stale: Vec::new(),
            left: Vec::new(),
            done: Written::default(),
        }
    }
}

impl<T: Temp> Prepared<T> {
    /// Adds a file.
    pub fn add(&mut self, name: &str, path: PathBuf, temp: T) {
        let waiting = Waiting { name: name.to_owned(), path, temp };
        if name == MANIFEST {
            self.manifest = Some(waiting);
        } else {
            self.files.push(waiting);
        }
    }

    /// Renames the files, removes what is stale, renames the manifest. Where this is broken off,
    /// the old manifest is still there, and the next write finds what is left to do.
    pub fn commit(self, disk: &impl Disk, root: &Path) -> Result<Written, StoreError> {
        let mut done = self.done;
        let mut changed = BTreeSet::new();
        for file in self.files {
            changed.insert(folder_of(&file.path).to_owned());
            rename(file, &mut done)?;
        }
        for (name, path) in self.stale {
            disk.remove(&path).map_err(StoreError::writing(&path, Operation::Remove))?;
            changed.insert(folder_of(&path).to_owned());
            done.removed.push(name);
        }
        changed.iter().try_for_each(|folder| sync(disk, folder))?;
        let mut root_changed = self.manifest.is_some();
        for folder in &self.left {
            root_changed |= remove_empty(disk, folder)?;
        }
        if let Some(manifest) = self.manifest {
            rename(manifest, &mut done)?;
        }
        if root_changed { sync(disk, root).map(|()| done) } else { Ok(done) }
    }
}

fn rename<T: Temp>(file: Waiting<T>, done: &mut Written) -> Result<(), StoreError> {
    file.temp.rename(&file.path).map_err(StoreError::writing(&file.path, Operation::Rename))?;
    done.written.push(file.name);
    Ok(())
}

fn sync(disk: &impl Disk, folder: &Path) -> Result<(), StoreError> {
    disk.sync_folder(folder).map_err(StoreError::writing(folder, Operation::Sync))
}

/// Removes a folder that holds nothing; whether there was one.
fn remove_empty(disk: &impl Disk, folder: &Path) -> Result<bool, StoreError> {
    if disk.look(folder).map_err(StoreError::writing(folder, Operation::Look))? != Some(Kind::Folder) {
        return Ok(false);
    }
    let names = disk.list(folder).map_err(StoreError::writing(folder, Operation::List))?;
    if names.is_empty() {
        disk.remove_folder(folder).map_err(StoreError::writing(folder, Operation::Remove))?;
    }
    Ok(names.is_empty())
}
