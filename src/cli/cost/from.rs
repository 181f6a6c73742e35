//! A bake that lies in a folder, and the records beside it.

use std::path::Path;

use super::super::CliError;
use super::RECORD_BYTES;
use crate::emit::manifest::Manifest;
use crate::report::{CostSearch, GpuRecord, OfflineRecord};
use crate::store::{self, Files, MANIFEST};
use crate::timing::isa::{self, IsaRecord};
use crate::timing::{offline, record, searches};

/// Largest file of a bake that is read, bytes.
const FILE_BYTES: u64 = 64 << 20;

/// The emitted code.
const CODE: &str = "fits/lobefit.wgsl";

/// Code and manifest of the bake in a folder, and the name of its scene.
///
/// # Errors
/// A folder without a manifest of this version.
pub fn bake_in(folder: &Path) -> Result<(Files, String), CliError> {
    let files = store::read_set(folder, [CODE, MANIFEST], FILE_BYTES)?;
    let bytes = files.get(MANIFEST).ok_or_else(|| {
        CliError::Usage(format!("{}: holds no {MANIFEST}; bake into it first", folder.display()))
    })?;
    let manifest = Manifest::read(bytes)
        .map_err(|e| CliError::Usage(format!("{}: {MANIFEST}: {e}", folder.display())))?;
    let scene = manifest.made_from["name"].as_str().unwrap_or_default().to_owned();
    Ok((files, scene))
}

/// Times that are recorded in a folder.
///
/// # Errors
/// A file that is no record.
pub fn times_in(folder: &Path) -> Result<Vec<GpuRecord>, CliError> {
    all_in(folder, record::FOLDER, record::read)
}

/// Counts that are recorded in a folder.
///
/// # Errors
/// A file that is no record.
pub fn counts_in(folder: &Path) -> Result<Vec<IsaRecord>, CliError> {
    all_in(folder, isa::FOLDER, IsaRecord::read)
}

/// Offline costs that are recorded in a folder.
///
/// # Errors
/// A file that is no record.
pub fn offline_in(folder: &Path) -> Result<Vec<OfflineRecord>, CliError> {
    all_in(folder, offline::FOLDER, offline::read)
}

/// Searches that are recorded in a folder.
///
/// # Errors
/// A file that is no record.
pub fn searches_in(folder: &Path) -> Result<Vec<CostSearch>, CliError> {
    all_in(folder, searches::FOLDER, searches::read)
}

fn all_in<T>(
    folder: &Path,
    under: &str,
    read: fn(&[u8]) -> Result<T, record::RecordError>,
) -> Result<Vec<T>, CliError> {
    let mut records = Vec::new();
    for entry in store::list(folder, under)?.iter().filter(|entry| entry.name.ends_with(".json")) {
        let path = folder.join(&entry.name);
        let shown = |source| CliError::Record { file: path.display().to_string(), source };
        records.push(read(&store::read(&path, RECORD_BYTES)?).map_err(shown)?);
    }
    Ok(records)
}
