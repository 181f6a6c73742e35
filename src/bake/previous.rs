//! Parts of an older bake in the output folder, kept where only some effects are baked again.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::build::{BUILD_FILE, is_signed};
use super::includes::{path, section};
use crate::effects::{Part, named};
use crate::emit::header::Recipe;
use crate::emit::manifest::{Entries, Manifest};
use crate::plan::Plan;
use crate::report::explore::{self, EXPLORE, ExploredEffect};
use crate::report::{Answer, Answers, INDEX};
use crate::store::{self, Files, MANIFEST, StoreError};
use lobefit_shade::code::Language;

/// Largest file that is kept, bytes.
const FILE_BYTES: u64 = 1 << 30;

/// Why the rest of an older bake cannot be kept.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PreviousError {
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

/// The parts of the plan's effects not in `only` that the bake in a folder has; none where there is
/// no bake.
pub fn previous(
    root: &Path,
    recipe: &Recipe,
    plan: &Plan,
    only: &[String],
) -> Result<Vec<Part>, PreviousError> {
    if !store::is_folder(root)? {
        return Ok(Vec::new());
    }
    let old = store::read_set(root, [MANIFEST, BUILD_FILE], FILE_BYTES)?;
    let Some(bytes) = old.get(MANIFEST) else { return Ok(Vec::new()) };
    let folder = root.display().to_string();
    let wrong = |reason: String| PreviousError::Manifest { folder: folder.clone(), reason };
    // The recipe first: another version's manifest may have another form.
    let made: Made = serde_json::from_slice(bytes).map_err(|e| wrong(e.to_string()))?;
    if made.recipe != recipe.hash {
        return Err(PreviousError::Recipe { folder, found: made.recipe, expected: recipe.hash.clone() });
    }
    if !is_signed(&old) {
        return Err(PreviousError::Build { folder });
    }
    let manifest = Manifest::read(bytes).map_err(|e| wrong(e.to_string()))?;
    let explored = explored(root, &folder, &manifest)?;
    let answers = answers(root, &folder, &manifest)?;
    let mut parts = Vec::new();
    for finding in manifest.effects.iter().filter(|finding| !only.contains(&finding.effect)) {
        let unknown = || wrong(format!("effects: `{}` is none of this version", finding.effect));
        let by = named(&plan.catalogue, &finding.effect).ok_or_else(unknown)?;
        let entries = manifest.entries.of(by.name());
        let files = files(root, &folder, &entries)?;
        let code = code(root, &folder, &manifest, by.name())?;
        let explored = explored.iter().find(|of| of.effect == finding.effect);
        let explored = explored.map_or_else(Vec::new, |of| of.shown.clone());
        let answer = match &answers {
            Some(answers) => answers.iter().find(|answer| answer.effect == by.name()).cloned(),
            None => Some(Answer::default()),
        };
        let answer = answer.ok_or_else(|| wrong(format!("{INDEX} has no answer of `{}`", by.name())))?;
        parts.push(Part { by, finding: finding.clone(), entries, code, files, explored, answer });
    }
    Ok(parts)
}

/// The answers that the overview is made of; none of a bake without reports.
fn answers(root: &Path, folder: &str, manifest: &Manifest) -> Result<Option<Vec<Answer>>, PreviousError> {
    if !manifest.entries.reports.iter().any(|report| report.file == INDEX) {
        return Ok(None);
    }
    let found = store::read_set(root, [INDEX], FILE_BYTES)?;
    let missing = || PreviousError::Missing { folder: folder.into(), file: INDEX.into() };
    let read: Answers = serde_json::from_slice(found.get(INDEX).ok_or_else(missing)?)
        .map_err(|e| PreviousError::Manifest { folder: folder.into(), reason: format!("{INDEX}: {e}") })?;
    Ok(Some(read.answers))
}

/// What tells whether the rest of a manifest is of this version.
#[derive(Deserialize)]
struct Made {
    #[serde(default)]
    recipe: String,
}

/// The files that entries list.
fn files(root: &Path, folder: &str, entries: &Entries) -> Result<Files, PreviousError> {
    let tables = entries.tables.iter().flat_map(|table| &table.files);
    let names: Vec<&str> =
        tables.chain(entries.reports.iter().map(|r| &r.file)).map(String::as_str).collect();
    let found = store::read_set(root, names.iter().copied(), FILE_BYTES)?;
    match names.iter().find(|name| !found.contains_key(**name)) {
        Some(file) => Err(PreviousError::Missing { folder: folder.into(), file: file.to_string() }),
        None => Ok(found),
    }
}

/// What the live page draws, where the bake has one.
fn explored(root: &Path, folder: &str, manifest: &Manifest) -> Result<Vec<ExploredEffect>, PreviousError> {
    if !manifest.entries.reports.iter().any(|report| report.file == EXPLORE) {
        return Ok(Vec::new());
    }
    let found = store::read_set(root, [EXPLORE], FILE_BYTES)?;
    let page = found.get(EXPLORE).and_then(|bytes| explore::read(&String::from_utf8_lossy(bytes)));
    page.ok_or_else(|| PreviousError::Missing { folder: folder.into(), file: EXPLORE.into() })
}

/// The effect's sections of the include files that the manifest lists.
fn code(
    root: &Path,
    folder: &str,
    manifest: &Manifest,
    effect: &str,
) -> Result<BTreeMap<Language, String>, PreviousError> {
    let mut code = BTreeMap::new();
    for language in Language::ALL {
        let file = path(language);
        if !manifest.includes.iter().any(|include| include.file == file) {
            continue;
        }
        let found = store::read_set(root, [file.as_str()], FILE_BYTES)?;
        let missing = || PreviousError::Missing { folder: folder.into(), file: file.clone() };
        let text = found.get(&file).ok_or_else(missing)?;
        if let Some(own) = section(&String::from_utf8_lossy(text), effect) {
            code.insert(language, own.to_string());
        }
    }
    Ok(code)
}
