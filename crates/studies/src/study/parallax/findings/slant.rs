//! Lobes on slanted walls, and several fetches for each.

use serde::Serialize;

use lobefit_truth::optics::footprint::RuleTap;

/// One fetch and more on slanted walls.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlantFindings {
    /// Walls that the probe stands in front of, by the width of the lobe.
    pub lobes: Vec<SlantLobe>,
    /// The shared rules at slants to both, by the width of the lobe.
    pub spread: Vec<RuleSpread>,
    /// The rules' constants against a fit from them on.
    pub refits: Vec<RuleRefit>,
    /// What one fetch and the rules are expected to be off by.
    pub expectations: Vec<RuleExpectation>,
}

/// A lobe over slants.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlantLobe {
    /// Its width.
    pub alpha: f64,
    /// One for each slant.
    pub rows: Vec<SlantRow>,
}

/// What is left of the total variation on a wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlantRow {
    /// In degrees.
    pub slant: f64,
    /// With one fetch of the lobe's width.
    pub same: f64,
    /// With the best width of one.
    pub best: f64,
    /// That width over the lobe's.
    pub factor: f64,
    /// With fetches placed for this wall.
    pub placed: Vec<PlacedTaps>,
    /// With the rules of two and three.
    pub ruled: [f64; 2],
}

/// Fetches placed for a wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlacedTaps {
    /// The total variation.
    pub tv: f64,
    /// Whether the search came to rest.
    pub settled: bool,
    /// From near to far.
    pub taps: Vec<RuleTap>,
}

/// Total variation over walls at slants to both.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleSpread {
    /// Width of the lobe.
    pub alpha: f64,
    /// How many walls.
    pub walls: usize,
    /// Means of one fetch, the rules of two and three.
    pub mean: [f64; 3],
    /// Their 95 % quantiles.
    pub high: [f64; 3],
    /// Root mean square errors of the total variation that is expected of one fetch and of the
    /// rules.
    pub expected: [f64; 3],
    /// How many of the walls the rules of two and three serve worse than one fetch, by more than
    /// 0.001.
    pub worse: [usize; 2],
}

/// A rule's constants, and a fit from them on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleRefit {
    /// How many fetches.
    pub count: usize,
    /// The constants as emitted.
    pub constants: Vec<f64>,
    /// Where the fit ends.
    pub refitted: Vec<f64>,
    /// What is minimised, at both.
    pub sums: [f64; 2],
    /// Whether the fit came to rest, not its iterations ran out.
    pub settled: bool,
    /// Walls of the fit.
    pub walls: usize,
}

/// The constants of the expected total variation of a rule, and a fit from them on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleExpectation {
    /// How many fetches.
    pub count: usize,
    /// The constants as emitted.
    pub constants: [f64; 4],
    /// Where the fit ends.
    pub refitted: [f64; 4],
    /// Root mean square error over the walls of the fit, of both.
    pub off: [f64; 2],
    /// Walls of the fit.
    pub walls: usize,
}
