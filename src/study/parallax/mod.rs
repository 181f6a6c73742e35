//! Lookups of the cubemap of a probe: what each is off by in rooms whose light is known. One module for each part of the page, which states
//! what it covers (its `Parameters`) and computes its findings (`findings`).

mod chain;
mod measures;
mod parameters;
mod proxies;
mod rooms;
mod seed;
mod slant;

use super::{Size, StudyError};
use crate::bake::{Progress, TOOL};
use crate::effects::parallax::catalogue_sources;
use crate::report::{File, Origin, ParallaxStudy, parallax_study_page};
use parameters::Parameters;

/// Hash of the tool's version, the parameters and the formulas of the catalogue.
pub(super) fn recipe(size: Size) -> Result<String, StudyError> {
    let mut hasher = blake3::Hasher::new();
    hasher.update(TOOL.as_bytes());
    hasher.update(&serde_json::to_vec(&Parameters::of(size))?);
    for source in catalogue_sources() {
        hasher.update(source.as_bytes());
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Runs it.
pub(super) fn files(size: Size, progress: &dyn Progress) -> Result<Vec<File>, StudyError> {
    let parameters = Parameters::of(size);
    let seed = seed::findings(&parameters.seed, progress)?;
    let slant = slant::findings(&parameters.slant, progress)?;
    let rooms = rooms::findings(&parameters.rooms, progress)?;
    let proxies = proxies::findings(&parameters.proxies, progress)?;
    let chain = chain::findings(&parameters.chain, progress)?;
    let origin = Origin {
        scene: String::new(),
        recipe: recipe(size)?,
        tool: env!("CARGO_PKG_VERSION").into(),
        command: command(size),
    };
    let parameters = serde_json::to_value(&parameters)?;
    Ok(parallax_study_page(&ParallaxStudy { origin, parameters, seed, slant, rooms, proxies, chain })?)
}

fn command(size: Size) -> String {
    let reduced = if size == Size::Reduced { " --reduced" } else { "" };
    format!("lobefit report --study parallax{reduced}")
}
