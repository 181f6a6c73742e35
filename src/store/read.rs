//! Bounded reads.

use std::ffi::OsStr;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::bundle::Files;
use super::disk::{Disk, Kind};
use super::{LocalDisk, Operation, StoreError, inside};

/// A file of at most `limit` bytes.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
    let bytes =
        LocalDisk.read(path, limit.saturating_add(1)).map_err(StoreError::reading(path, Operation::Read))?;
    bounded(bytes, path, limit)
}

/// The first bytes of a file, at most `limit` of them.
pub fn read_beginning(path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
    LocalDisk.read(path, limit).map_err(StoreError::reading(path, Operation::Read))
}

/// A stream, for instance standard input, of at most `limit` bytes; `name` stands for it in
/// messages.
pub fn read_stream(stream: impl Read, name: &str, limit: u64) -> Result<Vec<u8>, StoreError> {
    let path = Path::new(name);
    let mut bytes = Vec::new();
    stream
        .take(limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(StoreError::reading(path, Operation::Read))?;
    bounded(bytes, path, limit)
}

fn bounded(bytes: Vec<u8>, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
    if bytes.len() as u64 > limit {
        return Err(StoreError::TooLarge { path: path.to_owned(), limit });
    }
    Ok(bytes)
}

/// Something that lies in a folder and is none itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Relative path with `/`, to be read and not to be opened: bytes that are not UTF-8 are
    /// written `\xff`, and nothing is said about what else the name holds.
    pub name: String,
    /// [`Kind::File`], or [`Kind::Other`] for a link or device.
    pub kind: Kind,
}

/// Everything below `root/folder` but folders, sorted by name; nothing where the folder is not
/// there. Links are not followed: a link to a folder, and `folder` itself where it is a link, is
/// one entry.
pub fn list(root: &Path, folder: &str) -> Result<Vec<Entry>, StoreError> {
    let mut found = Vec::new();
    let mut pending = vec![(root.join(folder), folder.to_owned())];
    while let Some((path, name)) = pending.pop() {
        match look(&path)? {
            Some(Kind::Folder) => pending.extend(entries(&path, &name)?),
            Some(kind) => found.push(Entry { name, kind }),
            None => {}
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(found)
}

/// Whether a folder, or a link to one, is there.
pub fn is_folder(path: &Path) -> Result<bool, StoreError> {
    match LocalDisk.look(&path.join(".")) {
        Ok(kind) => Ok(kind == Some(Kind::Folder)),
        Err(e) if e.kind() == io::ErrorKind::NotADirectory => Ok(false),
        Err(e) => Err(StoreError::reading(path, Operation::Look)(e)),
    }
}

/// What is at a path; nothing where a file stands in the place of one of its folders.
fn look(path: &Path) -> Result<Option<Kind>, StoreError> {
    match LocalDisk.look(path) {
        Err(e) if e.kind() == io::ErrorKind::NotADirectory => Ok(None),
        other => other.map_err(StoreError::reading(path, Operation::Look)),
    }
}

fn entries(path: &Path, name: &str) -> Result<Vec<(PathBuf, String)>, StoreError> {
    let names = LocalDisk.list(path).map_err(StoreError::reading(path, Operation::List))?;
    Ok(names.iter().map(|n| (path.join(n), format!("{name}/{}", readable(n)))).collect())
}

/// A file's name as text, each byte that is not UTF-8 as `\xff`.
fn readable(name: &OsStr) -> String {
    let mut text = String::new();
    for chunk in name.as_encoded_bytes().utf8_chunks() {
        text += chunk.valid();
        text.extend(chunk.invalid().iter().map(|byte| format!("\\x{byte:02x}")));
    }
    text
}

/// The named regular files below a folder that are there, each of at most `limit` bytes.
pub fn read_set<'a>(
    root: &Path,
    names: impl IntoIterator<Item = &'a str>,
    limit: u64,
) -> Result<Files, StoreError> {
    let mut files = Files::new();
    for name in names {
        let path = inside(root, name)?;
        if look(&path)? == Some(Kind::File) {
            files.insert(name.to_owned(), read(&path, limit)?);
        }
    }
    Ok(files)
}
