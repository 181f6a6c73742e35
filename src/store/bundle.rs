//! A set of files that belong together, with a manifest that is written last: what the manifest
//! lists is complete.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

use super::commit::Prepared;
use super::disk::{Disk, Kind, TEMP_SUFFIX};
use super::listed::listed;
use super::write::{folder_of, stage};
use super::{LocalDisk, Operation, StoreError};

/// Contents by path relative to the output folder, with `/`.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The file that lists the others and is written last.
pub const MANIFEST: &str = "manifest.json";
/// The folders that a bake writes to.
pub const SUBFOLDERS: [&str; 3] = ["fits", "reports", "tables"];
/// How the temporary files of a set begin: a later writer, holding the lock, removes those that
/// were left behind.
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

/// Where the files of a set lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// In the folders of a bake, with a manifest at the root.
    Bake,
    /// In the root itself, without a manifest: nothing but the files of the set is touched.
    Flat,
}

/// An output folder, locked against other writers until dropped.
#[derive(Debug)]
pub struct Folder<D: Disk = LocalDisk> {
    disk: D,
    root: PathBuf,
    layout: Layout,
    /// Held for its drop; `None` until the folder is there.
    lock: Option<D::Lock>,
}

impl Folder {
    /// Opens a folder for writing: locks it where it is there, and tries by a temporary file
    /// whether it (or the nearest folder above it) can be written. Leaves nothing behind, so that
    /// work can follow before writing.
    pub fn open(root: &Path) -> Result<Folder, StoreError> {
        Folder::open_on(LocalDisk, root, Layout::Bake)
    }

    /// [`Folder::open`] for a set whose files lie in the folder itself.
    pub fn open_flat(root: &Path) -> Result<Folder, StoreError> {
        Folder::open_on(LocalDisk, root, Layout::Flat)
    }
}

impl<D: Disk> Folder<D> {
    /// [`Folder::open`] on any disk.
    pub fn open_on(disk: D, root: &Path, layout: Layout) -> Result<Folder<D>, StoreError> {
        let root = if root.as_os_str().is_empty() { Path::new(".") } else { root };
        let mut folder = Folder { disk, root: root.to_owned(), layout, lock: None };
        if folder.exists(root)? {
            folder.acquire()?;
            if layout == Layout::Bake {
                folder.old_manifest()?;
            }
        }
        folder.probe()?;
        Ok(folder)
    }

    /// Writes a set. First every file whose bytes are new is written and synchronised beside its
    /// destination; an error up to here changes nothing. Then the files are renamed one after the
    /// other, those that only the old manifest lists are removed, and so are the folders that this
    /// leaves empty; the new manifest comes last, so that the old one lists what is left to remove
    /// until nothing is. A set without a manifest leaves the old one and what it lists.
    pub fn write(&mut self, files: &Files) -> Result<Written, StoreError> {
        for name in files.keys() {
            if inside(&self.root, name).is_err() || !self.layout.holds(name) {
                return Err(StoreError::Outside { name: name.escape_debug().to_string(), writing: true });
            }
        }
        let mut created = Vec::new();
        let prepared = self.prepare(files, &mut created);
        let written = prepared.and_then(|prepared| prepared.commit(&self.disk, &self.root));
        if written.is_err() {
            self.withdraw(&created);
        }
        written
    }

    /// Everything that can be done before a destination changes. Folders are noted as they are
    /// created.
    fn prepare(
        &mut self,
        files: &Files,
        created: &mut Vec<PathBuf>,
    ) -> Result<Prepared<D::Temp>, StoreError> {
        self.create_root(created)?;
        // A folder that was removed in mid-run took its lock with it, whoever made it again.
        self.lock = None;
        let locked = self.acquire();
        if matches!(locked, Err(StoreError::Busy { .. })) {
            // What was made belongs to the other process now.
            created.clear();
        }
        locked?;
        self.sweep(files)?;
        let mut prepared = Prepared::default();
        for (name, bytes) in files {
            let path = inside(&self.root, name)?;
            self.create_below(&path, created)?;
            match stage(&self.disk, &path, bytes, BUNDLE_PREFIX)? {
                Some(temp) => prepared.add(name, path, temp),
                None => prepared.done.unchanged.push(name.clone()),
            }
        }
        if files.contains_key(MANIFEST) {
            self.find_stale(files, &mut prepared)?;
        }
        Ok(prepared)
    }

    /// Removes the folders that were created for a set that was not written, where they are empty.
    /// A file that cannot be removed stays: the first error is reported.
    fn withdraw(&mut self, created: &[PathBuf]) {
        if created.contains(&self.root) {
            self.lock = None;
        }
        for folder in created.iter().rev() {
            let _ = self.disk.remove_folder(folder);
        }
    }

    /// Whether there is a folder; anything else in its place is an error. The root itself may be a
    /// link to one.
    fn exists(&self, path: &Path) -> Result<bool, StoreError> {
        let in_the_way = |what| Err(StoreError::InTheWay { path: path.to_owned(), what });
        match self.look(path)? {
            None => Ok(false),
            Some(Kind::Folder) => Ok(true),
            Some(Kind::Other) if self.root.starts_with(path) => match self.look(&path.join("."))? {
                Some(Kind::Folder) => Ok(true),
                _ => in_the_way("a link or device"),
            },
            Some(Kind::Other) => in_the_way("a link or device"),
            Some(Kind::File) => in_the_way("a file"),
        }
    }

    /// What is at a path; nothing where a file stands in the place of one of its folders.
    fn look(&self, path: &Path) -> Result<Option<Kind>, StoreError> {
        match self.disk.look(path) {
            Err(e) if e.kind() == io::ErrorKind::NotADirectory => Ok(None),
            other => other.map_err(StoreError::writing(path, Operation::Look)),
        }
    }

    /// Creates the root and the folders above it that are missing.
    fn create_root(&self, created: &mut Vec<PathBuf>) -> Result<(), StoreError> {
        let mut missing = Vec::new();
        let mut at = self.root.as_path();
        while !self.exists(at)? {
            missing.push(at);
            at = folder_of(at);
        }
        missing.into_iter().rev().try_for_each(|folder| self.create(folder, created))
    }

    /// Creates the folders between the root and a file that are missing; a link among them is an
    /// error, since it may lead out of the root.
    fn create_below(&self, file: &Path, created: &mut Vec<PathBuf>) -> Result<(), StoreError> {
        let folders: Vec<&Path> = file.ancestors().skip(1).take_while(|a| *a != self.root).collect();
        for folder in folders.into_iter().rev() {
            if !self.exists(folder)? {
                self.create(folder, created)?;
            }
        }
        Ok(())
    }

    fn create(&self, folder: &Path, created: &mut Vec<PathBuf>) -> Result<(), StoreError> {
        match self.disk.create_folder(folder) {
            // Another process may have made it meanwhile.
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists && self.exists(folder)? => return Ok(()),
            done => done.map_err(StoreError::writing(folder, Operation::CreateFolder))?,
        }
        created.push(folder.to_owned());
        Ok(())
    }

    fn acquire(&mut self) -> Result<(), StoreError> {
        let lock = self.disk.lock(&self.root).map_err(StoreError::writing(&self.root, Operation::Lock))?;
        self.lock = Some(lock.ok_or_else(|| StoreError::Busy { path: self.root.clone() })?);
        Ok(())
    }

    /// Creates and removes a temporary file in every folder that will be written to and is there,
    /// or in the nearest folder above the root.
    fn probe(&self) -> Result<(), StoreError> {
        let mut nearest = self.root.as_path();
        while !self.exists(nearest)? {
            nearest = folder_of(nearest);
        }
        let mut folders = vec![nearest.to_owned()];
        for name in self.layout.folders() {
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

    /// Removes the temporary files of a write that was broken off, in the folders of the layout and
    /// of this set; the lock says that it is over.
    fn sweep(&self, files: &Files) -> Result<(), StoreError> {
        let mut folders: BTreeSet<PathBuf> =
            self.layout.folders().iter().map(|f| self.root.join(f)).collect();
        for name in files.keys() {
            folders.insert(folder_of(&inside(&self.root, name)?).to_owned());
        }
        folders.insert(self.root.clone());
        for folder in folders {
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

    /// The files that the old manifest lists, as they are written there; none where there is no
    /// manifest.
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

    /// Finds the regular files and links that the old manifest lists and the new set does not have,
    /// and the folders that only they are in. The old manifest is not trusted: what does not lie in
    /// a folder of a bake, or is reached through a link, is left alone.
    fn find_stale(&self, files: &Files, prepared: &mut Prepared<D::Temp>) -> Result<(), StoreError> {
        let mut left = BTreeSet::new();
        for name in self.old_manifest()?.into_iter().filter(|name| !files.contains_key(name)) {
            let path = match inside(&self.root, &name) {
                Ok(path) if is_ours(&name) && self.real_folder(folder_of(&path))? => path,
                _ => {
                    prepared.done.ignored.push(name);
                    continue;
                }
            };
            left.extend(SUBFOLDERS.into_iter().filter(|folder| within(&name, folder)));
            match self.look(&path)? {
                None => {}
                Some(Kind::Folder) => prepared.done.ignored.push(name),
                Some(Kind::File | Kind::Other) => prepared.stale.push((name, path)),
            }
        }
        left.retain(|folder| !files.keys().any(|name| within(name, folder)));
        prepared.left = left.into_iter().map(|folder| self.root.join(folder)).collect();
        Ok(())
    }

    /// Whether a path below the root is reached through folders only, so far as it is there.
    fn real_folder(&self, path: &Path) -> Result<bool, StoreError> {
        for ancestor in path.ancestors().take_while(|a| *a != self.root) {
            if !matches!(self.look(ancestor)?, Some(Kind::Folder) | None) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl Layout {
    /// Whether a set of this layout may have a file of this name.
    fn holds(self, name: &str) -> bool {
        match self {
            Layout::Bake => is_ours(name),
            Layout::Flat => !name.contains('/') && name != MANIFEST && !name.starts_with(BUNDLE_PREFIX),
        }
    }

    /// The folders below the root.
    fn folders(self) -> &'static [&'static str] {
        match self {
            Layout::Bake => &SUBFOLDERS,
            Layout::Flat => &[],
        }
    }
}

/// The path of `name` below `root`, where `name` is a plain relative path with `/`: no empty part,
/// no `.`, no `..`, no backslash, no drive, no control character.
pub fn inside(root: &Path, name: &str) -> Result<PathBuf, StoreError> {
    let hostile = |c: char| c.is_control() || matches!(c, '\\' | ':');
    if name.contains(hostile) || name.split('/').any(|part| matches!(part, "" | "." | "..")) {
        return Err(StoreError::Outside { name: name.escape_debug().to_string(), writing: false });
    }
    Ok(root.join(name.split('/').collect::<PathBuf>()))
}

/// Whether the name is one that a bake may write or remove: the manifest, or a file in one of its
/// folders.
fn is_ours(name: &str) -> bool {
    name == MANIFEST || name.split_once('/').is_some_and(|(folder, _)| SUBFOLDERS.contains(&folder))
}

/// Whether a name lies in a folder.
fn within(name: &str, folder: &str) -> bool {
    name.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'))
}
