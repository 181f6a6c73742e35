//! What a search minimises, and how it searches.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::FitError;

/// Largest power of a p-norm. Beyond it |r|^p of a residual 1 % below the largest is nothing in
/// f64: that is the maximum.
const LARGEST_POWER: f64 = 1000.0;

/// The error that coefficients minimise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Norm {
    /// The largest error.
    Max,
    /// The root of the mean square error.
    Rms,
}

impl Norm {
    /// The word used in scenes, names of fits and the manifest.
    pub fn name(self) -> &'static str {
        match self {
            Norm::Max => "max",
            Norm::Rms => "rms",
        }
    }
}

/// What coefficients minimise over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The largest residual.
    Max,
    /// The root of the mean square residual.
    Rms,
    /// (mean |residual|^p)^(1/p), 2 <= p <= 1000: between the two.
    Power(f64),
}

impl From<Norm> for Goal {
    fn from(norm: Norm) -> Goal {
        match norm {
            Norm::Max => Goal::Max,
            Norm::Rms => Goal::Rms,
        }
    }
}

impl fmt::Display for Goal {
    /// `max`, `rms`, `power 8`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Goal::Max => f.write_str("max"),
            Goal::Rms => f.write_str("rms"),
            Goal::Power(p) => write!(f, "power {p}"),
        }
    }
}

impl Goal {
    /// Refuses a power out of range.
    pub(super) fn check(self) -> Result<(), FitError> {
        match self {
            Goal::Power(power) if !(2.0..=LARGEST_POWER).contains(&power) => {
                Err(FitError::Power { power, largest: LARGEST_POWER })
            }
            _ => Ok(()),
        }
    }
}

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What to minimise.
    pub goal: Goal,
    /// Number of starting points, the declared one included. Where there are several, the declared
    /// one with signs of exponents and of other parameters inside curved functions turned comes on
    /// top.
    pub starts: usize,
    /// Half width of the box of starting points: this part of each start's magnitude, or of 1 if
    /// that is larger.
    pub spread: f64,
    /// Iterations of each search.
    pub iterations: u64,
    /// Saddles that are left one after the other; the end of the next one's search is called
    /// [`super::Termination::Saddle`].
    pub saddles: usize,
}

impl Options {
    /// 8 starts within half the magnitude of the declared one, 200 iterations, 6 saddles.
    pub fn new(goal: impl Into<Goal>) -> Options {
        Options { goal: goal.into(), starts: 8, spread: 0.5, iterations: 200, saddles: 6 }
    }
}
