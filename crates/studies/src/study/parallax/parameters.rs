//! What the study covers.

use serde::Serialize;

use super::{chain, rooms, slant};
use crate::study::Size;

/// Everything that the recipe covers beside the tool's version and the formulas, a field for each
/// part.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    pub slant: slant::Parameters,
    pub rooms: rooms::Parameters,
    pub chain: chain::Parameters,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        Parameters {
            slant: slant::Parameters::of(size),
            rooms: rooms::Parameters::of(size),
            chain: chain::Parameters::of(size),
        }
    }
}
