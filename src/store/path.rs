//! Relative paths that stay inside a folder.

use std::path::{Path, PathBuf};

use super::StoreError;
use super::bundle::{MANIFEST, SUBFOLDERS};

/// The path of `name` below `root`, where `name` is a plain relative path with `/`: no empty part, no `.`, no `..`, no
/// backslash, no drive, no control character.
pub fn inside(root: &Path, name: &str) -> Result<PathBuf, StoreError> {
    let hostile = |c: char| c.is_control() || matches!(c, '\\' | ':');
    if name.contains(hostile) || name.split('/').any(|part| matches!(part, "" | "." | "..")) {
        return Err(StoreError::Outside { name: name.escape_debug().to_string(), writing: false });
    }
    Ok(root.join(name.split('/').collect::<PathBuf>()))
}

/// Whether the name is one that a bake may write or remove: the manifest, or a file in one of its folders.
pub(super) fn is_ours(name: &str) -> bool {
    name == MANIFEST || name.split_once('/').is_some_and(|(folder, _)| SUBFOLDERS.contains(&folder))
}
