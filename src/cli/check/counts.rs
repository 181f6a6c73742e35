//! Records of machine instructions that lie beside a bake. Their own package, `lobefit-gpu`,
//! compiles again what is of other code.

use std::ffi::OsStr;
use std::path::Path;

use serde::Serialize;

use super::super::cost::RECORD_BYTES;
use super::super::{CliError, external};
use super::records::some;
use crate::bake::{Baked, Difference, Kind};
use crate::emit::include::Include;
use crate::report::words;
use crate::scene::escape::visible;
use crate::store::{self, Folder, MANIFEST};
use crate::timing::isa::{Comparison, FOLDER, IsaRecord};

/// A record of the scene that is there.
#[derive(Serialize)]
pub(super) struct Counts {
    /// Its file.
    pub file: String,
    /// Driver and version.
    pub compiler: String,
    /// Functions in it whose code is not that of the bake.
    pub stale: Vec<String>,
    /// Why those were not compiled and compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknown: Option<String>,
}

impl Counts {
    /// What is said where functions are of other code.
    pub fn note(&self) -> Option<String> {
        let names = some(&self.stale)?;
        let (file, count) =
            (visible(&self.file), words::count(self.stale.len(), "function is", "functions are"));
        let unknown =
            self.unknown.as_ref().map_or_else(String::new, |why| format!("; not compared: {}", visible(why)));
        Some(format!(
            "note: {file}: {count} of other code than the bake's ({names}){unknown}; compile again with lobefit cost --isa --record\n"
        ))
    }
}

/// Whether a file is in the place of a record.
pub(super) fn placed(name: &str) -> bool {
    let name = name.strip_prefix(FOLDER).and_then(|rest| rest.strip_prefix('/'));
    name.is_some_and(|name| !name.contains('/') && name.ends_with(".json"))
}

/// The records of a scene that are there, and what is wrong with them: no record, or a function
/// that has become dearer.
pub(super) fn counts(
    root: &Path,
    baked: &Baked,
    scene: &str,
) -> Result<(Vec<Counts>, Vec<Difference>), CliError> {
    let (mut all, mut differences) = (Vec::new(), Vec::new());
    for entry in store::list(root, FOLDER)?.iter().filter(|e| e.kind == store::Kind::File && placed(&e.name))
    {
        let mut wrong = |detail: &str| {
            differences.push(Difference::plain(&entry.name, Kind::Different, detail));
        };
        let found = store::read_set(root, [entry.name.as_str()], RECORD_BYTES)?;
        let Some(bytes) = found.get(&entry.name) else { continue };
        let record = match IsaRecord::read(bytes) {
            Ok(record) if record.scene == scene => record,
            Ok(_) => continue,
            Err(reason) => {
                wrong(&reason.to_string());
                continue;
            }
        };
        let include = Include::of(&baked.files).unwrap_or_else(|| Include::new(String::new()));
        let stale: Vec<String> = record.stale(&include).into_iter().map(String::from).collect();
        let mut unknown = None;
        if !stale.is_empty() {
            match compared(&root.join(&entry.name), baked) {
                Ok(found) if found.recorded != found.compiled => {
                    unknown = Some(format!("compiled by {} here", found.compiled));
                }
                Ok(found) => found.grown.iter().for_each(|grown| wrong(&grown.to_string())),
                Err(error @ (CliError::NotBuilt { .. } | CliError::NotRun { .. })) => {
                    unknown = Some(error.to_string());
                }
                Err(error) => return Err(error),
            }
        }
        let (file, compiler) = (entry.name.clone(), record.compiler());
        all.push(Counts { file, compiler, stale, unknown });
    }
    Ok((all, differences))
}

/// A record compared with what a bake's code compiles to now.
fn compared(record: &Path, baked: &Baked) -> Result<Comparison, CliError> {
    let temporary = store::temporary()?;
    let code = baked.files.iter().filter(|(name, _)| *name == MANIFEST || name.starts_with("fits/"));
    Folder::open(temporary.path())?
        .write(&code.map(|(name, bytes)| (name.clone(), bytes.clone())).collect())?;
    let words = ["--isa", "--json", "--from"].map(OsStr::new);
    let rest = [temporary.path().as_os_str(), OsStr::new("--against"), record.as_os_str()];
    let text = external::ask("lobefit-gpu", &[words, rest].concat())?;
    Ok(serde_json::from_slice(&text)?)
}
