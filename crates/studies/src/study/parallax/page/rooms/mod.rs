//! Lookups in rooms.

mod compared;
mod costs;
mod lobes;
mod pictures;
mod random;
mod smoothness;
mod verdict;

pub(super) use verdict::conclusion;

use crate::study::parallax::findings::RoomsFindings;
use lobefit::report::{ReportError, Section, folded_after};

/// What came of it.
pub(super) fn answers(rooms: &RoomsFindings) -> Result<Vec<Section>, ReportError> {
    let references = rooms.random.iter().map(|room| room.references.len()).min().unwrap_or_default();
    Ok(vec![
        folded_after(1, verdict::section(rooms)?),
        folded_after(references, random::section(rooms)?),
        pictures::section(rooms)?,
        folded_after(3, smoothness::section(rooms)?),
    ])
}

/// What is compared, where, and at what price.
pub(super) fn basis(rooms: &RoomsFindings) -> Result<Vec<Section>, ReportError> {
    Ok(vec![compared::section(), lobes::section(rooms)?, costs::section(rooms)?])
}
