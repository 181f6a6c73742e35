//! Fits of this effect: hypotheses to coefficients, proven regular and measured in f32 as emitted.

mod blend;
mod certified;
mod one;
mod run;
mod saturate;

pub use run::fit_all;

use crate::approximate::{Dropped, Fit, FitSet, FitStageError, Region};
use crate::data::{Norm, Smith};

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSpec {
    /// Shadowing form.
    pub smith: Smith,
    /// Where the fits must hold.
    pub region: Region,
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// Errors to minimise.
    pub norms: Vec<Norm>,
    /// Also fit the average albedo.
    pub average: bool,
    /// Also fit f0 A + B.
    pub blend: bool,
    /// The user's hypotheses: file name and WGSL source.
    pub hypotheses: Vec<(String, String)>,
}
