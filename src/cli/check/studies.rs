//! Studies that lie beside a bake. Their own package, `lobefit-studies`, knows whether they are of
//! this version; none are run again.

use std::ffi::OsStr;
use std::path::Path;

use serde::Deserialize;

use super::super::{CliError, external};
use crate::bake::{Difference, Kind};
use crate::store;

/// The folder of a bake in which studies are looked for.
const FOLDER: &str = "reports/studies";

/// The studies that are there.
#[derive(Default)]
pub(super) struct Studies {
    /// What is wrong with them.
    pub differences: Vec<Difference>,
    /// Why nothing is known of them.
    pub unknown: Option<String>,
}

/// What `lobefit report --check --json` prints.
#[derive(Deserialize)]
struct Verdict {
    differences: Vec<Stale>,
}

/// A file that is wrong, and a sentence.
#[derive(Deserialize)]
struct Stale {
    file: String,
    detail: String,
}

/// Whether a file is in the place of a study's.
pub(super) fn placed(name: &str) -> bool {
    let rest = name.strip_prefix(FOLDER).and_then(|rest| rest.strip_prefix('/'));
    rest.and_then(|rest| rest.split_once('/'))
        .is_some_and(|(_, file)| ["index.html", "results.json", "times.json"].contains(&file))
}

/// Asks for the studies in a folder, if there are any.
pub(super) fn studies(root: &Path) -> Result<Studies, CliError> {
    if !store::list(root, FOLDER)?.iter().any(|entry| placed(&entry.name)) {
        return Ok(Studies::default());
    }
    let words = [OsStr::new("--json"), OsStr::new("--check"), root.as_os_str()];
    let text = match external::ask("lobefit-studies", &words) {
        Ok(text) => text,
        Err(missing @ CliError::NotBuilt { .. }) => {
            return Ok(Studies { unknown: Some(missing.to_string()), ..Studies::default() });
        }
        Err(error) => return Err(error),
    };
    let Verdict { differences } = serde_json::from_slice(&text)?;
    let plain = |Stale { file, detail }: Stale| Difference::plain(&file, Kind::Different, &detail);
    Ok(Studies { differences: differences.into_iter().map(plain).collect(), unknown: None })
}
