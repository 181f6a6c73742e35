//! Diffuse couplings: what each departs from white in a furnace, and what is seen of it under an environment.

mod candidates;
mod furnace;
mod lit;
mod parameters;
mod ranking;

use super::{Size, StudyError};
use crate::bake::{Progress, TOOL};
use crate::effects::surface::{Lobe, SurfaceRows, Wanted};
use crate::report::{CouplingStudy, File, Origin, coupling_study_page};
use candidates::Candidate;
use parameters::Parameters;

/// Hash of the tool's version and the parameters.
pub(super) fn recipe(size: Size) -> Result<String, StudyError> {
    let mut hasher = blake3::Hasher::new();
    hasher.update(TOOL.as_bytes());
    hasher.update(&serde_json::to_vec(&Parameters::of(size)?)?);
    Ok(hasher.finalize().to_hex().to_string())
}

/// A specular lobe with the couplings under it.
struct Compared {
    lobe: Lobe,
    candidates: Vec<Candidate>,
}

/// Runs it.
pub(super) fn files(size: Size, progress: &dyn Progress) -> Result<Vec<File>, StudyError> {
    let parameters = Parameters::of(size)?;
    let mut compared = Vec::new();
    for under in &parameters.lobes {
        progress.stage(&format!("fits, {}", under.lobe.name()));
        let candidates = candidates::made(&under.planned, under.lobe)?;
        compared.push(Compared { lobe: under.lobe, candidates });
    }
    progress.stage("furnace");
    let furnace = furnace::strips(&parameters.furnace, &compared)?;
    progress.stage("lit spheres");
    let lit = lit::strips(&parameters.lit, &compared)?;
    progress.stage("reciprocity and random walks");
    let surfaces = SurfaceRows::measure(&wanted(size)?)?;
    let rankings = ranking::rankings(&compared, &furnace, &lit)?;
    let origin = Origin {
        scene: String::new(),
        recipe: recipe(size)?,
        tool: env!("CARGO_PKG_VERSION").into(),
        command: command(size),
    };
    let parameters = serde_json::to_value(&parameters)?;
    Ok(coupling_study_page(&CouplingStudy { origin, parameters, furnace, lit, rankings, surfaces })?)
}

/// What is measured of whole materials.
fn wanted(size: Size) -> Result<Wanted, StudyError> {
    Ok(match size {
        Size::Full => Wanted::full()?,
        Size::Reduced => Wanted::reduced()?,
    })
}

fn command(size: Size) -> String {
    let reduced = if size == Size::Reduced { " --reduced" } else { "" };
    format!("lobefit report --study coupling{reduced}")
}
