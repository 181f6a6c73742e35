//! A formula of the user's, fitted: what `lobefit fit` shows.

use serde::Serialize;

use super::Origin;
use crate::data::{Certificate, Use};
use crate::report::{Field, Ruler};

/// A formula fitted to a quantity, for one or more norms.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitPage {
    /// What made it; its scene is empty.
    pub origin: Origin,
    /// Name of the formula.
    pub name: String,
    /// What the formula should be: quantity, use, domain, constraints, as names and values.
    pub asked: Vec<(String, String)>,
    /// The hypothesis as the user wrote it.
    pub hypothesis: String,
    /// What the formula is used as.
    #[serde(rename = "use")]
    pub used_as: Use,
    /// One for each norm.
    pub fits: Vec<FitCard>,
}

/// One fit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitCard {
    /// Name of its function.
    pub name: String,
    /// What the search did and what is proven, as names and values.
    pub facts: Vec<(String, String)>,
    /// Operations by the project's model.
    pub ops: u32,
    /// Coefficients: name, starting value, fitted value.
    pub coefficients: Vec<(String, f32, f32)>,
    /// One for each arithmetic, the main one first.
    pub certificates: Vec<Certificate>,
    /// Stages of the search: method, end, largest residual, RMS.
    pub stages: Vec<[String; 4]>,
    /// Truth, fit and error over two inputs, the others fixed.
    pub slices: Vec<FitSlice>,
    /// The emitted code: language, text.
    pub code: Vec<(String, String)>,
}

/// Truth and fit where all inputs but two are fixed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitSlice {
    /// The inputs that are fixed: `f0 = 0.5`; empty where there is none.
    pub at: String,
    /// What truth and fit are: `N = 1/E`, `E`.
    pub value: String,
    /// The input along the curves.
    pub along: Ruler,
    /// Input that tells the curves apart; empty for one curve.
    pub family: String,
    /// The curves.
    pub curves: Vec<SliceCurve>,
    /// Signed error of the use over both inputs; none where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<Field>,
    /// The largest errors of the map: x, y, signed value; the first is marked with its value.
    pub worst: Vec<(f64, f64, f64)>,
}

/// Truth and fit along one input.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SliceCurve {
    /// Value of the input that tells the curves apart.
    pub of: f64,
    /// Truth.
    pub truth: Vec<f64>,
    /// Fit.
    pub fit: Vec<f64>,
    /// Signed error of the use.
    pub error: Vec<f64>,
}
