//! Lookups in rooms.

use serde::Serialize;

/// What was found in the rooms.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomsFindings {
    /// How points at random lie in each.
    pub geometry: Vec<RoomGeometry>,
    /// What the lobe of a surface is taken for, fitted.
    pub lobes: Vec<FittedLobe>,
    /// What methods are off by at those points.
    pub random: Vec<RandomRoom>,
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

/// Errors at points at random in a room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RandomRoom {
    /// The room.
    pub room: String,
    /// Roughness of each column, the root of alpha.
    pub roughness: Vec<f64>,
    /// By reference.
    pub references: Vec<RandomReference>,
}

/// Errors against one reference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RandomReference {
    /// What the truth is.
    pub name: String,
    /// Its own relative L2 noise, from its two halves, by roughness.
    pub noise: Vec<f64>,
    /// By method.
    pub rows: Vec<RandomRow>,
}

/// Errors of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RandomRow {
    /// The method.
    pub name: String,
    /// Relative L2 of linear radiance, by roughness.
    pub l2: Vec<f64>,
    /// Mean absolute error of x/(1 + x), by roughness.
    pub mae: Vec<f64>,
    /// Frostbite's relative L2 over this one's, the geometric mean over the roughnesses.
    pub gain_l2: f64,
    /// The same of `mae`.
    pub gain_mae: f64,
}

/// Constants of a lobe that stand for GGX's with a number of fetches. Errors are geometric means over the roughnesses of the relative L2 in the
/// practice room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FittedLobe {
    /// Fetches.
    pub fetches: usize,
    /// Constants of the share of the normal in the axis.
    pub lean: [f64; 3],
    /// Constants of the ratio of the footprint.
    pub narrow: [f64; 3],
    /// Constants of the ratio of the widths.
    pub squash: [f64; 2],
    /// Error with them.
    pub error: f64,
    /// Error with the constants that the methods have.
    pub shipped: f64,
    /// Error of the round lobe about the mirror ray.
    pub mirror: f64,
    /// Error of the round lobe about the published dominant direction.
    pub dominant: f64,
}
