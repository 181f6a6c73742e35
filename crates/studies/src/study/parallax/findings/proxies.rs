//! Proxies with soft edges.

use serde::Serialize;

/// What was found of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProxiesFindings {
    /// Roots of alpha.
    pub roughness: Vec<f64>,
    /// Points of the practice room that laws were fitted at, and of each other room that they are
    /// judged at.
    pub points: [usize; 2],
    /// Each with its law.
    pub families: Vec<ProxyFamily>,
    /// Errors in rooms that laws were not fitted in.
    pub gains: Vec<ProxyGain>,
    /// Jumps at edges.
    pub crossings: Vec<ProxyCrossing>,
}

/// A way to soften the edges of a proxy, with one parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProxyFamily {
    /// Its name.
    pub name: String,
    /// What the parameter is.
    pub parameter: String,
    /// The fitted law over alpha.
    pub law: String,
    /// Values of the parameter that were tried.
    pub values: Vec<f64>,
    /// Error over that of the planes: a row for each roughness, a column for each value.
    pub landscape: Vec<Vec<f64>>,
    /// The best parameter, over roughness.
    pub best: Vec<f64>,
    /// That of the law.
    pub by_law: Vec<f64>,
}

/// Relative L2 errors of a room at a roughness, of all points and of those whose lobe reaches over
/// an edge.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProxyGain {
    /// The room.
    pub room: String,
    /// Root of alpha.
    pub roughness: f64,
    /// Points, and those that reach over an edge.
    pub points: [usize; 2],
    /// Of the planes themselves.
    pub planes: [f64; 2],
    /// Of proxies by their laws.
    pub proxies: Vec<(String, [f64; 2])>,
}

/// What a lookup does as its ray passes over an edge of room A: means over the edges.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProxyCrossing {
    /// The proxy.
    pub proxy: String,
    /// Width of the lobe.
    pub alpha: f64,
    /// Edges passed.
    pub edges: u32,
    /// Jump of the derivative of the looked-up direction by the ray's angle.
    pub direction: f64,
    /// Jump of the logarithm of the ratio of areas.
    pub ratio: f64,
    /// Jump of the derivative of that logarithm by the ray's angle, per radian.
    pub slope: f64,
    /// Change of that logarithm over a fifth of the lobe's width about the edge.
    pub lobe: f64,
}
