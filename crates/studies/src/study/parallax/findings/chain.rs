//! Lookups from a real chain of levels.

use serde::Serialize;

/// What was found about chains. Errors are relative: the root of the sum of squares over channels
/// and points at random, over that of the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChainFindings {
    /// Roughness of the entries of all lists of errors.
    pub roughness: Vec<f64>,
    /// The levels in words.
    pub levels: String,
    /// Texels along a side of a face of the first level.
    pub size: usize,
    /// What the references at points are off by, by room: relative, by roughness.
    pub noise: Vec<(String, Vec<f64>)>,
    /// Lookups end to end.
    pub gains: Vec<ChainGain>,
}

/// A lookup end to end, against lobes traced from the points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChainGain {
    /// The room.
    pub room: String,
    /// The lookup.
    pub method: String,
    /// Error with fetches integrated.
    pub exact: Vec<f64>,
    /// Error with fetches from the chain.
    pub chain: Vec<f64>,
    /// Geometric mean over roughness of Frostbite's error over this one's, fetches integrated.
    pub gain_exact: f64,
    /// The same from the chain, both.
    pub gain_chain: f64,
}
