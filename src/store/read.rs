//! Bounded reads.

use std::io::Read;
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

/// A stream, for instance standard input, of at most `limit` bytes; `name` stands for it in messages.
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

/// The regular files below `root/folder` as relative paths with `/`, sorted; none where the folder is not there. Links
/// are not followed. A name that is not UTF-8 is given with its odd bytes replaced.
pub fn list(root: &Path, folder: &str) -> Result<Vec<String>, StoreError> {
    let mut found = Vec::new();
    let mut pending = vec![(root.join(folder), folder.to_owned())];
    while let Some((path, name)) = pending.pop() {
        match look(&path)? {
            Some(Kind::File) => found.push(name),
            Some(Kind::Folder) => pending.extend(entries(&path, &name)?),
            Some(Kind::Other) | None => {}
        }
    }
    found.sort();
    Ok(found)
}

fn look(path: &Path) -> Result<Option<Kind>, StoreError> {
    LocalDisk.look(path).map_err(StoreError::reading(path, Operation::Look))
}

fn entries(path: &Path, name: &str) -> Result<Vec<(PathBuf, String)>, StoreError> {
    let names = LocalDisk.list(path).map_err(StoreError::reading(path, Operation::List))?;
    Ok(names.iter().map(|n| (path.join(n), format!("{name}/{}", n.to_string_lossy()))).collect())
}

/// The named files below a folder that are there, each of at most `limit` bytes.
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
