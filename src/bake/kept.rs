//! Parts of an older bake in the output folder, kept where only some effects are baked again.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use super::build::{BUILD_FILE, is_signed};
use super::includes::{path, section};
use super::part::Part;
use crate::emit::header::Recipe;
use crate::emit::manifest::Entries;
use crate::plan::EffectName;
use crate::store::{self, Files, MANIFEST, StoreError};
use lobefit_shade::code::Language;

/// Largest file that is kept, bytes.
const FILE_BYTES: u64 = 1 << 30;

/// Why the rest of an older bake cannot be kept.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum KeptError {
    /// It was made from something else.
    #[error(
        "{folder}: the bake there has recipe {found}, this one {expected}: the scene, its hypotheses or the tool changed, \
         so its other effects may not follow any more; bake without --only"
    )]
    Recipe {
        /// The folder.
        folder: String,
        /// Recipe of the old manifest.
        found: String,
        /// Recipe of this bake.
        expected: String,
    },
    /// It was made by other code, or it is not known by which.
    #[error(
        "{folder}: {BUILD_FILE} does not say that this build of lobefit made the bake there, so its other effects may not follow any \
         more; bake without --only"
    )]
    Build {
        /// The folder.
        folder: String,
    },
    /// Its manifest lists a file that is not there.
    #[error("{folder}: the bake there lacks {file}, which its manifest lists; bake without --only")]
    Missing {
        /// The folder.
        folder: String,
        /// The file.
        file: String,
    },
    /// Its manifest cannot be understood.
    #[error("{folder}/manifest.json: {reason}; bake without --only")]
    Manifest {
        /// The folder.
        folder: String,
        /// What is wrong.
        reason: String,
    },
    /// A file could not be read.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// The parts of the effects not in `only` that the bake in a folder has; none where there is no bake.
pub fn kept(root: &Path, recipe: &Recipe, only: &[EffectName]) -> Result<Vec<Part>, KeptError> {
    if !store::is_folder(root)? {
        return Ok(Vec::new());
    }
    let old = store::read_set(root, [MANIFEST, BUILD_FILE], FILE_BYTES)?;
    let Some(bytes) = old.get(MANIFEST) else { return Ok(Vec::new()) };
    let folder = root.display().to_string();
    let wrong = |reason: String| KeptError::Manifest { folder: folder.clone(), reason };
    let manifest: Value = serde_json::from_slice(bytes).map_err(|e| wrong(e.to_string()))?;
    let found = manifest["recipe"].as_str().unwrap_or("that is not told").to_string();
    if found != recipe.hash {
        return Err(KeptError::Recipe { folder, found, expected: recipe.hash.clone() });
    }
    if !is_signed(&old) {
        return Err(KeptError::Build { folder });
    }
    let mut parts = Vec::new();
    for finding in manifest["effects"].as_array().into_iter().flatten() {
        let finding: crate::report::EffectFinding =
            serde_json::from_value(finding.clone()).map_err(|e| wrong(format!("effects: {e}")))?;
        let effect = EffectName::from_name(&finding.effect)
            .ok_or_else(|| wrong(format!("effects: `{}` is none of this version", finding.effect)))?;
        if only.contains(&effect) {
            continue;
        }
        let entries = entries(&manifest, effect);
        let files = files(root, &folder, &entries)?;
        let code = code(root, &folder, &manifest, effect)?;
        parts.push(Part { effect, finding, entries, code, files });
    }
    Ok(parts)
}

/// The entries of an effect in the lists of a manifest.
fn entries(manifest: &Value, effect: EffectName) -> Entries {
    let mut entries = Entries::default();
    for (name, list) in entries.lists() {
        let all = manifest[name].as_array().into_iter().flatten();
        list.extend(all.filter(|entry| entry["effect"] == effect.name()).cloned());
    }
    entries
}

/// The files that entries list.
fn files(root: &Path, folder: &str, entries: &Entries) -> Result<Files, KeptError> {
    let listed = entries.tables.iter().chain(&entries.reports).flat_map(listed);
    let names: Vec<String> = listed.collect();
    let found = store::read_set(root, names.iter().map(String::as_str), FILE_BYTES)?;
    match names.iter().find(|name| !found.contains_key(*name)) {
        Some(file) => Err(KeptError::Missing { folder: folder.into(), file: file.clone() }),
        None => Ok(found),
    }
}

/// Every file that an entry names: its own, or those of all its containers.
fn listed(entry: &Value) -> Vec<String> {
    let all = entry["files"].as_array().into_iter().flatten();
    let all: Vec<String> = all.filter_map(|file| file.as_str().map(String::from)).collect();
    if all.is_empty() { entry["file"].as_str().map(String::from).into_iter().collect() } else { all }
}

/// The effect's sections of the include files that the manifest lists.
fn code(
    root: &Path,
    folder: &str,
    manifest: &Value,
    effect: EffectName,
) -> Result<BTreeMap<Language, String>, KeptError> {
    let mut code = BTreeMap::new();
    for language in Language::ALL {
        let file = path(language);
        let listed = manifest["includes"].as_array().into_iter().flatten().any(|i| i["file"] == *file);
        if !listed {
            continue;
        }
        let found = store::read_set(root, [file.as_str()], FILE_BYTES)?;
        let missing = || KeptError::Missing { folder: folder.into(), file: file.clone() };
        let text = found.get(&file).ok_or_else(missing)?;
        if let Some(own) = section(&String::from_utf8_lossy(text), effect.name()) {
            code.insert(language, own.to_string());
        }
    }
    Ok(code)
}
