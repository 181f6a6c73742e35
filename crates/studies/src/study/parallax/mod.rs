//! Lookups of the cubemap of a probe: what each is off by in rooms whose light is known. One module
//! for each part of the page, which states what it covers (its `Parameters`) and computes its
//! findings (`findings`).

mod chain;
mod creases;
mod measures;
mod parameters;
mod proxies;
mod rooms;
mod seed;
mod slant;

use serde_json::Value;

use super::{Size, Study, StudyError};
use crate::report::ParallaxStudy;
use lobefit::bake::Progress;
use parameters::Parameters;

/// Everything that it covers.
pub(super) fn parameters(size: Size) -> Result<Value, StudyError> {
    Ok(serde_json::to_value(Parameters::of(size))?)
}

/// Runs it.
pub(super) fn results(size: Size, progress: &dyn Progress) -> Result<ParallaxStudy, StudyError> {
    let parameters = Parameters::of(size);
    let seed = seed::findings(&parameters.seed, progress)?;
    let slant = slant::findings(&parameters.slant, progress)?;
    let rooms = rooms::findings(&parameters.rooms, progress)?;
    let proxies = proxies::findings(&parameters.proxies, progress)?;
    let chain = chain::findings(&parameters.chain, progress)?;
    let origin = Study::Parallax.origin(size)?;
    let reduced = size == Size::Reduced;
    let parameters = serde_json::to_value(&parameters)?;
    Ok(ParallaxStudy { origin, reduced, parameters, seed, slant, rooms, proxies, chain })
}
