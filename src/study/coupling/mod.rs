//! Diffuse couplings: what each departs from white in a furnace, and what is seen of it under an environment.

mod candidates;
mod furnace;
mod lit;
mod parameters;
mod ranking;

use super::{Size, StudyError};
use crate::bake::{Progress, TOOL};
use crate::report::{CouplingStudy, File, Origin, coupling_study_page};
use candidates::candidates;
use parameters::Parameters;

/// Hash of the tool's version and the parameters.
pub(super) fn recipe(size: Size) -> Result<String, StudyError> {
    let mut hasher = blake3::Hasher::new();
    hasher.update(TOOL.as_bytes());
    hasher.update(&serde_json::to_vec(&Parameters::of(size, &candidates()?))?);
    Ok(hasher.finalize().to_hex().to_string())
}

/// Runs it.
pub(super) fn files(size: Size, progress: &dyn Progress) -> Result<Vec<File>, StudyError> {
    let candidates = candidates()?;
    let parameters = Parameters::of(size, &candidates);
    progress.stage("furnace");
    let furnace = furnace::strips(&parameters, &candidates)?;
    progress.stage("lit spheres");
    let lit = lit::strips(&parameters, &candidates)?;
    let rankings = ranking::rankings(&parameters, &candidates, &furnace, &lit);
    let origin = Origin {
        scene: String::new(),
        recipe: recipe(size)?,
        tool: env!("CARGO_PKG_VERSION").into(),
        command: command(size),
    };
    let study =
        CouplingStudy { origin, parameters: serde_json::to_value(&parameters)?, furnace, lit, rankings };
    Ok(coupling_study_page(&study)?)
}

fn command(size: Size) -> String {
    let reduced = if size == Size::Reduced { " --reduced" } else { "" };
    format!("lobefit report --study coupling{reduced}")
}
