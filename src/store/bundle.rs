//! A set of files that belong together, with a manifest that is written last: what the manifest lists is complete.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::disk::{Disk, Kind, TEMP_SUFFIX};
use super::path::{inside, is_ours};
use super::write::{folder_of, replace};
use super::{LocalDisk, Operation, StoreError};

/// Contents by path relative to the output folder, with `/`.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The file that lists the others and is written last.
pub const MANIFEST: &str = "manifest.json";
/// The folders that a bake writes to.
pub const SUBFOLDERS: [&str; 3] = ["fits", "reports", "tables"];
/// How the temporary files of a set begin: a later writer, holding the lock, removes those that were left behind.
const BUNDLE_PREFIX: &str = ".lobefit-set-";
/// Largest old manifest that is read, bytes.
const MANIFEST_BYTES: u64 = 64 << 20;

/// What writing a set did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Files whose bytes are new.
    pub written: Vec<String>,
    /// Files that held these bytes already.
    pub unchanged: Vec<String>,
    /// Files of the old manifest that the new set does not have.
    pub removed: Vec<String>,
    /// Entries of the old manifest that were left alone because they name no file of a bake.
    pub ignored: Vec<String>,
}

/// An output folder, locked against other writers until dropped.
#[derive(Debug)]
pub struct Folder<D: Disk = LocalDisk> {
    disk: D,
    root: PathBuf,
    /// Held for its drop; `None` until the folder is there.
    lock: Option<D::Lock>,
}

impl Folder {
    /// Opens a folder for writing: locks it where it is there, and tries by a temporary file whether it (or the
    /// nearest folder above it) can be written. Leaves nothing behind, so that work can follow before writing.
    pub fn open(root: &Path) -> Result<Folder, StoreError> {
        Folder::open_on(LocalDisk, root)
    }
}

impl<D: Disk> Folder<D> {
    /// [`Folder::open`] on any disk.
    pub fn open_on(disk: D, root: &Path) -> Result<Folder<D>, StoreError> {
        let root = if root.as_os_str().is_empty() { Path::new(".") } else { root };
        let mut folder = Folder { disk, root: root.to_owned(), lock: None };
        if folder.exists(root)? {
            folder.acquire()?;
            folder.old_manifest()?;
        }
        folder.probe()?;
        Ok(folder)
    }

    /// Writes a set: removes what a broken-off write left, writes every file, removes those that only the old manifest
    /// lists, and writes the manifest last. A set without a manifest leaves the old one and what it lists.
    pub fn write(&mut self, files: &Files) -> Result<Written, StoreError> {
        for name in files.keys() {
            if inside(&self.root, name).is_err() || !is_ours(name) {
                return Err(StoreError::Outside { name: name.escape_debug().to_string(), writing: true });
            }
        }
        self.create_root()?;
        if self.lock.is_none() {
            self.acquire()?;
        }
        self.sweep()?;
        let mut done = Written::default();
        for (name, bytes) in files.iter().filter(|(name, _)| *name != MANIFEST) {
            self.put(name, bytes, &mut done)?;
        }
        if let Some(manifest) = files.get(MANIFEST) {
            self.remove_stale(files, &mut done)?;
            self.put(MANIFEST, manifest, &mut done)?;
        }
        Ok(done)
    }

    fn put(&self, name: &str, bytes: &[u8], done: &mut Written) -> Result<(), StoreError> {
        let path = inside(&self.root, name)?;
        self.create_below(&path)?;
        let list = if replace(&self.disk, &path, bytes, BUNDLE_PREFIX)? {
            &mut done.written
        } else {
            &mut done.unchanged
        };
        list.push(name.to_owned());
        Ok(())
    }

    /// Whether there is a folder; anything else in its place is an error. The root itself may be a link to one.
    fn exists(&self, path: &Path) -> Result<bool, StoreError> {
        let in_the_way = |what| Err(StoreError::InTheWay { path: path.to_owned(), what });
        match self.disk.look(path).map_err(StoreError::writing(path, Operation::Look))? {
            None => Ok(false),
            Some(Kind::Folder) => Ok(true),
            Some(Kind::Other) if self.root.starts_with(path) => {
                let through = path.join(".");
                match self.disk.look(&through).map_err(StoreError::writing(path, Operation::Look))? {
                    Some(Kind::Folder) => Ok(true),
                    _ => in_the_way("a link or device"),
                }
            }
            Some(Kind::Other) => in_the_way("a link or device"),
            Some(Kind::File) => in_the_way("a file"),
        }
    }

    /// Creates the root and the folders above it that are missing.
    fn create_root(&self) -> Result<(), StoreError> {
        let mut missing = Vec::new();
        let mut at = self.root.as_path();
        while !self.exists(at)? {
            missing.push(at);
            at = folder_of(at);
        }
        missing.into_iter().rev().try_for_each(|folder| self.create(folder))
    }

    /// Creates the folders between the root and a file that are missing; a link among them is an error, since it may
    /// lead out of the root.
    fn create_below(&self, file: &Path) -> Result<(), StoreError> {
        let folders: Vec<&Path> = file.ancestors().skip(1).take_while(|a| *a != self.root).collect();
        for folder in folders.into_iter().rev() {
            if !self.exists(folder)? {
                self.create(folder)?;
            }
        }
        Ok(())
    }

    fn create(&self, folder: &Path) -> Result<(), StoreError> {
        self.disk.create_folder(folder).map_err(StoreError::writing(folder, Operation::CreateFolder))
    }

    fn acquire(&mut self) -> Result<(), StoreError> {
        let lock = self.disk.lock(&self.root).map_err(StoreError::writing(&self.root, Operation::Lock))?;
        self.lock = Some(lock.ok_or_else(|| StoreError::Busy { path: self.root.clone() })?);
        Ok(())
    }

    /// Creates and removes a temporary file in every folder that will be written to and is there, or in the nearest
    /// folder above the root.
    fn probe(&self) -> Result<(), StoreError> {
        let mut nearest = self.root.as_path();
        while !self.exists(nearest)? {
            nearest = folder_of(nearest);
        }
        let mut folders = vec![nearest.to_owned()];
        for name in SUBFOLDERS {
            let folder = self.root.join(name);
            if nearest == self.root && self.exists(&folder)? {
                folders.push(folder);
            }
        }
        for folder in folders {
            let temp = self.disk.create_temp(&folder, BUNDLE_PREFIX);
            drop(temp.map_err(StoreError::writing(&folder, Operation::CreateTemp))?);
        }
        Ok(())
    }

    /// Removes the temporary files of a write that was broken off; the lock says that it is over.
    fn sweep(&self) -> Result<(), StoreError> {
        for folder in std::iter::once(self.root.clone()).chain(SUBFOLDERS.map(|name| self.root.join(name))) {
            if !self.exists(&folder)? {
                continue;
            }
            let names = self.disk.list(&folder).map_err(StoreError::writing(&folder, Operation::List))?;
            let temps = names.iter().filter_map(|n| n.to_str());
            for name in temps.filter(|n| n.starts_with(BUNDLE_PREFIX) && n.ends_with(TEMP_SUFFIX)) {
                let path = folder.join(name);
                if self.disk.look(&path).map_err(StoreError::writing(&path, Operation::Look))?
                    != Some(Kind::File)
                {
                    continue;
                }
                self.disk.remove(&path).map_err(StoreError::writing(&path, Operation::Remove))?;
            }
        }
        Ok(())
    }

    /// The files that the old manifest lists, as they are written there; none where there is no manifest.
    fn old_manifest(&self) -> Result<BTreeSet<String>, StoreError> {
        let path = self.root.join(MANIFEST);
        match self.disk.look(&path).map_err(StoreError::writing(&path, Operation::Look))? {
            Some(Kind::File) => {}
            Some(Kind::Folder) => return Err(StoreError::InTheWay { path, what: "a folder" }),
            Some(Kind::Other) | None => return Ok(BTreeSet::new()),
        }
        let bytes =
            self.disk.read(&path, MANIFEST_BYTES + 1).map_err(StoreError::writing(&path, Operation::Read))?;
        listed(&bytes).map_err(|reason| StoreError::ForeignManifest { path, reason })
    }

    /// Removes the regular files and links that the old manifest lists and the new set does not have. The old manifest
    /// is not trusted: what does not lie in a folder of a bake, or is reached through a link, is left alone.
    fn remove_stale(&self, files: &Files, done: &mut Written) -> Result<(), StoreError> {
        for name in self.old_manifest()?.into_iter().filter(|name| !files.contains_key(name)) {
            let path = match inside(&self.root, &name) {
                Ok(path) if is_ours(&name) && self.real_folder(folder_of(&path))? => path,
                _ => {
                    done.ignored.push(name);
                    continue;
                }
            };
            match self.disk.look(&path).map_err(StoreError::writing(&path, Operation::Look))? {
                None => {}
                Some(Kind::Folder) => done.ignored.push(name),
                Some(Kind::File | Kind::Other) => {
                    self.disk.remove(&path).map_err(StoreError::writing(&path, Operation::Remove))?;
                    done.removed.push(name);
                }
            }
        }
        Ok(())
    }

    /// Whether a path below the root is a folder reached through folders only.
    fn real_folder(&self, path: &Path) -> Result<bool, StoreError> {
        for ancestor in path.ancestors().take_while(|a| *a != self.root) {
            let kind = self.disk.look(ancestor).map_err(StoreError::writing(ancestor, Operation::Look))?;
            if kind != Some(Kind::Folder) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// The files that a manifest lists: every string under a key `file`.
fn listed(bytes: &[u8]) -> Result<BTreeSet<String>, String> {
    let manifest: Value = serde_json::from_slice(bytes).map_err(|e| e.to_string())?;
    let known = |key: &&str| manifest.get(key).is_some_and(Value::is_array);
    if !["tables", "fits", "includes"].iter().any(known) {
        return Err("it lists no tables, fits or includes".into());
    }
    let mut files = BTreeSet::new();
    let mut pending = vec![&manifest];
    while let Some(value) = pending.pop() {
        match value {
            Value::Array(items) => pending.extend(items),
            Value::Object(fields) => {
                pending.extend(fields.values());
                if let Some(Value::String(file)) = fields.get("file") {
                    files.insert(file.clone());
                }
            }
            _ => {}
        }
    }
    Ok(files)
}
