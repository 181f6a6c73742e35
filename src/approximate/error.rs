//! Why there is no fit.

use super::target::TargetError;
use lobefit_fit::{FitError, Termination};
use lobefit_shade::ShadeError;
use lobefit_truth::integrate::IntegrateError;

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

impl From<ShadeError> for FitStageError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}
