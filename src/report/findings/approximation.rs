//! Approximations and fits as the page shows them.

use serde::Serialize;

use crate::data::{Approximation, Certificate, Cost, Form, Smith, Source, Use};
use crate::report::{Field, Ruler};

/// One approximation: ours or somebody else's, table or formula. The same figures for all of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ApproximationFinding {
    /// Name; unique among the findings.
    pub name: String,
    /// Quantity that it approximates.
    pub quantity: String,
    /// Column of the quantity.
    pub column: String,
    /// What it is used as; decides what its error means.
    #[serde(rename = "use")]
    pub used_as: Use,
    /// Shadowing form, of a quantity that has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smith: Option<Smith>,
    /// `fitted`, `baked` for a table of ours, or the publication.
    pub source: String,
    /// Somebody else's.
    pub published: bool,
    /// A table, not a formula.
    pub table: bool,
    /// Norm that its constants minimise: `max`, `rms`, `published`; empty for a table.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub norm: String,
    /// Coefficients by name; none for a table.
    pub coefficients: Vec<(String, f32)>,
    /// Its measured error.
    pub certificate: Certificate,
    /// What it takes at run time.
    pub cost: Cost,
}

impl From<&Approximation> for ApproximationFinding {
    fn from(a: &Approximation) -> Self {
        let (table, norm, coefficients) = match &a.form {
            Form::Table(_) => (true, String::new(), Vec::new()),
            Form::Formula(f) => (false, f.norm.clone(), f.coefficients.clone()),
        };
        ApproximationFinding {
            name: a.name.clone(),
            quantity: a.quantity.clone(),
            column: a.column.clone(),
            used_as: a.used_as,
            smith: a.smith,
            source: if table && a.source == Source::Fitted { "baked" } else { a.source.text() }.into(),
            published: matches!(a.source, Source::Published(_)),
            table,
            norm,
            coefficients,
            certificate: a.certificate.clone(),
            cost: a.cost,
        }
    }
}

/// A fit beside its truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitFinding {
    /// Name of the approximation; cost, certificate and source stand there.
    pub name: String,
    /// What earns it pictures, as it reads after a number of fits; those that share the words are
    /// counted together.
    pub shown_as: String,
    /// The formula as a person reads it, constants filled in; may have several lines.
    pub formula: String,
    /// What the curves show: `N = 1/E`, ...
    pub value: String,
    /// Truth and fit over mu, one per roughness, roughness rising.
    pub curves: Vec<FitCurve>,
    /// Signed error of the use over roughness and mu; for a normalisation E N - 1.
    pub error: Field,
}

/// Truth and fit at one roughness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitCurve {
    /// Roughness.
    pub roughness: f64,
    /// Cosines, increasing.
    #[serde(serialize_with = "lobefit_figures::drawn")]
    pub mu: Vec<f64>,
    /// Truth at each mu.
    #[serde(serialize_with = "lobefit_figures::drawn")]
    pub truth: Vec<f64>,
    /// Fit at each mu.
    #[serde(serialize_with = "lobefit_figures::drawn")]
    pub fit: Vec<f64>,
}

/// Fits of a quantity of roughness alone, beside its truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AverageFinding {
    /// What it is: `E_avg`.
    pub name: String,
    /// Where it was sampled.
    pub roughness: Ruler,
    /// Truth at each roughness.
    #[serde(serialize_with = "lobefit_figures::drawn")]
    pub truth: Vec<f64>,
    /// The fits.
    pub fits: Vec<AverageFit>,
}

/// One fit of a quantity of roughness alone.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AverageFit {
    /// Name of the approximation; cost, certificate and source stand there.
    pub name: String,
    /// Values at each roughness.
    #[serde(serialize_with = "lobefit_figures::drawn")]
    pub values: Vec<f64>,
}
