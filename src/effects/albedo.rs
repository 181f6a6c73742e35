//! E, and Schlick's bias B, of the isotropic lobe at many points.

use serde::{Deserialize, Serialize};

use crate::approximate::Memo;
use crate::data::Smith;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{GGX_REFLECTION, Reflection, TRUTH_ERROR};

/// E, and B where it was asked for, at every point, within [`TRUTH_ERROR`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Albedo {
    /// Directional albedo.
    pub e: Vec<f64>,
    /// Schlick's bias; empty where it was not asked for.
    pub b: Vec<f64>,
}

impl Albedo {
    /// E of GGX, and with `split` B, which takes longer.
    ///
    /// # Errors
    /// Points without alpha or mu, or outside the domain of the quantity.
    pub fn new(smith: Smith, points: &Points, split: bool, memo: &Memo) -> Result<Albedo, IntegrateError> {
        Albedo::of((GGX_REFLECTION, smith), points, split, memo)
    }

    /// The same of a lobe.
    ///
    /// # Errors
    /// As [`Albedo::new`].
    pub fn of(
        (lobe, smith): (&dyn Reflection, Smith),
        points: &Points,
        split: bool,
        memo: &Memo,
    ) -> Result<Albedo, IntegrateError> {
        let outputs = &["E", "B"][..1 + usize::from(split)];
        let mut truth = lobe.truth(&smith.into(), points, outputs, TRUTH_ERROR)?;
        memo.add(truth.evaluations as usize);
        let b = if split { truth.columns.swap_remove(1) } else { Vec::new() };
        Ok(Albedo { e: truth.columns.swap_remove(0), b })
    }
}
