//! The experiment that the idea comes from.

use serde::Serialize;

/// Lobes over a window of the wall, and the fetches that come nearest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeedFindings {
    /// On a wall at right angles.
    pub cells: Vec<SeedCell>,
    /// On one at a slant.
    pub slants: Vec<SeedSlant>,
}

/// A lobe from a distance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeedCell {
    /// Whether energy per area is compared, or the lobe's values.
    pub energy: bool,
    /// Its width.
    pub alpha: f64,
    /// Its distance; the fetch is from distance 1.
    pub distance: f64,
    /// The best fetch with an offset.
    pub shifted: SeedFit,
    /// The best without.
    pub plain: SeedFit,
    /// Whether its curves are drawn.
    pub drawn: bool,
    /// Over the wall from 0 to 1: the lobe, the fetch with an offset, the one without.
    #[serde(skip)]
    pub curves: [Vec<(f64, f64)>; 3],
}

/// The best fetch of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SeedFit {
    /// Its width.
    pub alpha: f64,
    /// What multiplies it.
    pub scale: f64,
    /// What is added, in units of the lobe's peak.
    pub offset: f64,
    /// Root mean square difference over that of the lobe.
    pub error: f64,
    /// Whether its width is the largest there is.
    pub saturated: bool,
}

/// The values of a lobe on a slanted wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeedSlant {
    /// In degrees.
    pub slant: f64,
    /// Its width.
    pub alpha: f64,
    /// Width of the best fetch.
    pub best: f64,
    /// What multiplies it.
    pub scale: f64,
    /// Root mean square difference over that of the lobe: of the best fetch, of one of the lobe's
    /// width.
    pub error: f64,
    /// The same of the lobe's width.
    pub same: f64,
    /// Where the lobe falls to half of its peak: across the tilt, towards the shading point, away
    /// from it.
    pub half: [f64; 3],
    /// Along the tilt and across it: the lobe, the best fetch, the one of the lobe's width.
    #[serde(skip)]
    pub curves: [[Vec<(f64, f64)>; 3]; 2],
}
