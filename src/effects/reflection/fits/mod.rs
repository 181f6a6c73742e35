//! Fits of this effect: hypotheses to coefficients, proven regular and measured in f32 as emitted.

mod blend;
mod certified;
mod one;
mod run;
mod saturate;

pub(in crate::effects) use certified::formula;
pub(in crate::effects) use one::{Searched, searched, searched_within};
pub use run::fit_all;
pub(in crate::effects) use run::kept;

use super::{PointSet, Region};
use crate::data::{Approximation, Form, Norm, Smith};
use crate::effects::Safe;
use crate::effects::target::TargetError;
use lobefit_fit::{FitError, Termination};
use lobefit_shade::{Hypothesis, ShadeError};
use lobefit_truth::integrate::IntegrateError;

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

/// A formula with coefficients, measured.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The formula as an approximation.
    pub approximation: Approximation,
    /// The hypothesis that it is an instance of.
    pub hypothesis: Hypothesis,
    /// How the search ended; none for published constants.
    pub termination: Option<Termination>,
    /// Whether it is emitted, or only reported for comparison.
    pub emitted: bool,
    /// The function that a saturating form calls.
    pub wraps: Option<String>,
    /// Where it is proven to have no pole and no negative value, if that was asked for.
    pub safe: Option<Safe>,
}

/// A hypothesis without a fit: one of the catalogue whose search did not converge in this region or into which a pole moves, or
/// one of the user's that costs more than the scene allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// Hypothesis.
    pub hypothesis: String,
    /// Norm that was minimised.
    pub norm: &'static str,
    /// Why, in words.
    pub reason: String,
}

/// Everything that a fit job gives.
#[derive(Clone, Debug)]
pub struct FitSet {
    /// Fits and published formulas.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue without a fit.
    pub dropped: Vec<Dropped>,
}

/// Why there is no fit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitStageError {
    /// The hypothesis, its domain or its data.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// What a fit is made to.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The search did not end in a minimum.
    #[error("{hypothesis}, norm {norm}: the search ended as {termination:?}: no coefficients to rely on")]
    NotConverged {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: &'static str,
        /// How the search ended.
        termination: Termination,
    },
    /// The search went off to infinity: the formula wants to be a simpler one.
    #[error(
        "{hypothesis}, norm {norm}: coefficient {coefficient} ran away to {value:e}: the formula is a simpler one in \
         disguise, or its parameters are not independent; reduce it or give better starting values"
    )]
    RunAway {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: &'static str,
        /// The coefficient.
        coefficient: String,
        /// Its value.
        value: f64,
    },
    /// Coefficients that do not keep what they must, with or without being bound to it.
    #[error(
        "{hypothesis}, norm {norm}: no coefficients without poles and negative values were found: {reason}"
    )]
    Unkept {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: &'static str,
        /// What was found instead.
        reason: String,
    },
    /// The hypothesis has no argument.
    #[error("{hypothesis}: the function has no argument; name one or more of {known}")]
    NoInputs {
        /// File of the hypothesis.
        hypothesis: String,
        /// The inputs there are.
        known: &'static str,
    },
    /// The hypothesis asks for an input that this effect does not have.
    #[error("{hypothesis}: argument `{input}` is not one of {known}")]
    Input {
        /// File of the hypothesis.
        hypothesis: String,
        /// The argument.
        input: String,
        /// The inputs there are.
        known: &'static str,
    },
}

impl Fit {
    /// The norm that its coefficients minimise: `max`, `rms` or `published`.
    pub fn norm(&self) -> &str {
        match &self.approximation.form {
            Form::Formula(formula) => &formula.norm,
            Form::Table(_) => "",
        }
    }

    /// Its coefficients, in order.
    pub fn coefficients(&self) -> Vec<f32> {
        match &self.approximation.form {
            Form::Formula(formula) => formula.coefficients.iter().map(|(_, value)| *value).collect(),
            Form::Table(_) => Vec::new(),
        }
    }

    /// Its values in f32 at the points of a set; f0 = 1.
    pub fn values(&self, points: &PointSet) -> Result<Vec<f32>, ShadeError> {
        self.values_for(points, 1.0)
    }

    /// Its values in f32 at the points of a set, for one f0.
    pub fn values_for(&self, points: &PointSet, f0: f32) -> Result<Vec<f32>, ShadeError> {
        let column = |name: &String| match name.as_str() {
            "f0" => vec![f0; points.len()],
            name => points.column(name),
        };
        let inputs: Vec<Vec<f32>> = self.hypothesis.inputs().iter().map(column).collect();
        self.hypothesis.tape().evaluate(&inputs, &self.coefficients())
    }
}

impl From<ShadeError> for FitStageError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}
