//! Lookups of the cubemap of a probe: what each is off by in rooms whose light is known. One module
//! for each part of the page, which states what it covers (its `Parameters`) and computes its
//! findings (`findings`).

mod chain;
mod creases;
mod findings;
mod measures;
mod page;
pub mod room;
mod rooms;
mod slant;

use serde::Serialize;
use serde_json::Value;

use super::{Size, Study, StudyError};
use crate::study::parallax::findings::ParallaxStudy;
use lobefit::bake::Progress;
use lobefit::effects::parallax::catalogue_sources;
use lobefit::report::{Origin, Page, document};

/// The study.
pub struct ProbeLookups;

impl Study for ProbeLookups {
    fn name(&self) -> &'static str {
        "parallax"
    }

    fn code(&self) -> &'static str {
        env!("LOBEFIT_STUDY_PARALLAX")
    }

    fn about(&self) -> &'static str {
        "lookups of a probe's cubemap in rooms: minutes"
    }

    fn parameters(&self, size: Size) -> Result<Value, StudyError> {
        Ok(serde_json::to_value(Parameters::of(size))?)
    }

    fn formulas(&self) -> Vec<&'static str> {
        catalogue_sources()
    }

    fn made(
        &self,
        size: Size,
        origin: Origin,
        progress: &dyn Progress,
    ) -> Result<(Page, Vec<u8>), StudyError> {
        let found = results(size, origin, progress)?;
        Ok((page::page(&found)?, document("results.json", &found)?))
    }
}

/// Everything that the recipe covers beside the tool's version and the formulas, a field for each
/// part.
#[derive(Clone, Debug, Serialize)]
struct Parameters {
    slant: slant::Parameters,
    rooms: rooms::Parameters,
    chain: chain::Parameters,
}

impl Parameters {
    /// Those of a size.
    fn of(size: Size) -> Parameters {
        Parameters {
            slant: slant::Parameters::of(size),
            rooms: rooms::Parameters::of(size),
            chain: chain::Parameters::of(size),
        }
    }
}

/// Runs it.
fn results(size: Size, origin: Origin, progress: &dyn Progress) -> Result<ParallaxStudy, StudyError> {
    let parameters = Parameters::of(size);
    let slant = slant::findings(&parameters.slant, progress)?;
    let rooms = rooms::findings(&parameters.rooms, progress)?;
    let chain = chain::findings(&parameters.chain, progress)?;
    let reduced = size == Size::Reduced;
    let parameters = serde_json::to_value(&parameters)?;
    Ok(ParallaxStudy { origin, reduced, parameters, slant, rooms, chain })
}
