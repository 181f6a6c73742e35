//! What the study of lookups of a probe's cubemap found out, a file for each part of its page.

mod chain;
mod rooms;
mod slant;

use serde::Serialize;
use serde_json::Value;

pub use chain::*;
use lobefit::report::Origin;
pub use rooms::*;
pub use slant::*;

/// Lookups of the cubemap of a probe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParallaxStudy {
    /// What made it.
    pub origin: Origin,
    /// Whether it is of the reduced size, for tests.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub reduced: bool,
    /// What was asked: everything that the recipe hash covers beside the formulas.
    pub parameters: Value,
    /// Several fetches on slanted walls.
    pub slant: SlantFindings,
    /// Lookups in rooms, against lobes traced from the shading point.
    pub rooms: RoomsFindings,
    /// Lookups from a real chain of levels.
    pub chain: ChainFindings,
}
