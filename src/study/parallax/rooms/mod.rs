//! Lookups in rooms, against lobes traced from the shading point.

mod points;

use serde::Serialize;

use crate::bake::Progress;
use crate::effects::room::{Room, octagon, room_a, room_b};
use crate::report::RoomsFindings;
use crate::study::{Size, StudyError};

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    /// With their light.
    pub rooms: Vec<Room>,
    points: points::Parameters,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        Parameters { rooms: vec![room_a(), room_b(), octagon()], points: points::Parameters::of(size) }
    }
}

/// Runs it.
pub(super) fn findings(
    parameters: &Parameters,
    progress: &dyn Progress,
) -> Result<RoomsFindings, StudyError> {
    progress.stage("rooms");
    let geometry = parameters.rooms.iter().map(|room| points::geometry(room, &parameters.points)).collect();
    Ok(RoomsFindings { geometry })
}
