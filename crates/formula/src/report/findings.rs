//! What the pages of a formula that was fitted and of a search show.

use lobefit::data::{Certificate, Use};
use lobefit::report::{Dot, Field, Origin, Ruler};

/// A formula fitted to a quantity, for one or more norms.
#[derive(Clone, Debug, PartialEq)]
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
    pub used_as: Use,
    /// One for each norm.
    pub fits: Vec<FitCard>,
}

/// One fit.
#[derive(Clone, Debug, PartialEq)]
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
#[derive(Clone, Debug, PartialEq)]
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
    pub error: Option<Field>,
    /// The largest errors of the map: x, y, signed value; the first is marked with its value.
    pub worst: Vec<(f64, f64, f64)>,
}

/// Truth and fit along one input.
#[derive(Clone, Debug, PartialEq)]
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

/// The frontier of a search beside what there was before.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchPage {
    /// What made it; its scene is empty.
    pub origin: Origin,
    /// What was searched for, as in the files' names.
    pub name: String,
    /// What the formulas are used as.
    pub used_as: Use,
    /// What their cost is counted in, and the frontier is by.
    pub unit: String,
    /// What was asked, as names and values.
    pub asked: Vec<(String, String)>,
    /// What was tried beforehand in narrow searches, and what came of it.
    pub tried: Vec<(String, String)>,
    /// Cost against error: the frontier, and published formulas.
    pub dots: Vec<Dot>,
    /// The frontier by rising cost.
    pub rows: Vec<SearchRow>,
    /// The catalogue: name, operations, largest error, RMS, whether it is somebody else's.
    pub others: Vec<(String, u32, f64, f64, bool)>,
}

/// One form.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchRow {
    /// Name of its function.
    pub name: String,
    /// Operations.
    pub ops: u32,
    /// No constants of this form do better on the samples; 0 where nothing is proven.
    pub bound: f64,
    /// Measured error.
    pub certificate: Certificate,
    /// The hypothesis.
    pub source: String,
}
