//! What the study covers.

use serde::Serialize;

use super::{chain, proxies, rooms, seed, slant};
use crate::study::Size;

/// Raised whenever the study's method changes without its parameters: results of another method
/// then have another recipe.
const METHOD: u32 = 5;

/// Everything that the recipe covers beside the tool's version and the formulas, a field for each
/// part.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    method: u32,
    pub seed: seed::Parameters,
    pub slant: slant::Parameters,
    pub rooms: rooms::Parameters,
    pub proxies: proxies::Parameters,
    pub chain: chain::Parameters,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        Parameters {
            method: METHOD,
            seed: seed::Parameters::of(size),
            slant: slant::Parameters::of(size),
            rooms: rooms::Parameters::of(size),
            proxies: proxies::Parameters::of(size),
            chain: chain::Parameters::of(size),
        }
    }
}
