//! Lookups in rooms.

use serde::Serialize;

/// What was found in the rooms.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomsFindings {
    /// How points at random lie in each.
    pub geometry: Vec<RoomGeometry>,
}

/// How points at random in a room and its probe lie to the walls.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomGeometry {
    /// The room.
    pub room: String,
    /// Its walls.
    pub walls: usize,
    /// Bright panels on them.
    pub panels: usize,
    /// Points.
    pub points: usize,
    /// Distance of the point from where its ray meets a wall over that of the probe, the quantiles 5, 50 and 95 %.
    pub rho: [f64; 3],
    /// Longer over shorter axis of the lobe in the cubemap, the same quantiles.
    pub stretch: [f64; 3],
}
