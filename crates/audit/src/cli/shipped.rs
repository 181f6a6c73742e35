//! Files that projects ship, by their checksum: those whose audits `docs/audits.md` holds.

use lobefit::cli::CliError;
use serde::Deserialize;
use sha2::{Digest, Sha256};

const ARTEFACTS: &str = include_str!("../../../../docs/audits/zoo.json");
const CHECKSUMS: &str = include_str!("../../../../docs/audits/recomputed.json");

#[derive(Deserialize)]
struct Zoo {
    projects: Vec<Project>,
}

#[derive(Deserialize)]
struct Project {
    project: String,
    at: String,
    artefacts: Vec<Artefact>,
}

#[derive(Deserialize)]
struct Artefact {
    id: String,
    what: String,
    quantity: String,
}

#[derive(Deserialize)]
struct Checksums {
    artefacts: Vec<Checksum>,
}

#[derive(Deserialize)]
struct Checksum {
    id: String,
    sha256: String,
}

/// Which file it is, in a sentence: as the project ships it, or as it is cut out of the project's. None of
/// a file that was not audited as this quantity.
///
/// # Errors
/// A list that is no JSON, a defect of this program.
pub(super) fn shipped(bytes: &[u8], quantity: &str) -> Result<Option<String>, CliError> {
    let own = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    let sums: Checksums = serde_json::from_str(CHECKSUMS)?;
    let same: Vec<&str> =
        sums.artefacts.iter().filter(|sum| sum.sha256 == own).map(|sum| sum.id.as_str()).collect();
    if same.is_empty() {
        return Ok(None);
    }
    let zoo: Zoo = serde_json::from_str(ARTEFACTS)?;
    Ok(zoo.projects.iter().find_map(|project| {
        let is_it = |a: &&Artefact| a.quantity == quantity && same.contains(&a.id.as_str());
        let what: Vec<&str> = project.artefacts.iter().filter(is_it).map(|a| a.what.as_str()).collect();
        let (name, at) = (&project.project, &project.at);
        (!what.is_empty()).then(|| {
            format!("It is a file of {name} ({at}): {}; docs/audits.md has its audit.", what.join("; "))
        })
    }))
}
