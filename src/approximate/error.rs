//! Why there is no fit.

use std::fmt;

use super::target::TargetError;
use crate::data::WeightsError;
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
    /// What formulas cost on a vendor's GPUs.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// What a fit is made to.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The search did not end in a minimum.
    #[error("{hypothesis}, norm {norm}: no coefficients to rely on: {termination}")]
    NotConverged {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: &'static str,
        /// How the search ended.
        termination: Termination,
    },
    /// The search went off to infinity: the formula wants to be a simpler one.
    #[error("{hypothesis}, norm {norm}: {runaway}")]
    RunAway {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: &'static str,
        /// The coefficient.
        runaway: Runaway,
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
    /// A formula that is not finite in half precision, which the scene asks for; one that is mostly rounding
    /// in f32.
    #[error("{hypothesis}, norm {norm}: {reason}")]
    Refused {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: String,
        /// What is not finite, or how much of its error is rounding, and where.
        reason: String,
    },
    /// A formula of the catalogue without a fit to rely on, as it was found before.
    #[error("{reason}")]
    Unreliable {
        /// Why.
        reason: String,
    },
    /// A formula for whose target no samples were made: a defect of the program.
    #[error("{hypothesis}: no samples were made for its target")]
    Unprepared {
        /// File of the hypothesis.
        hypothesis: String,
    },
}

impl FitStageError {
    /// Whether a formula of the catalogue has no reliable fit in this domain.
    pub(super) fn is_unreliable(&self) -> bool {
        // One coefficient on its way to infinity, as far as f32 goes.
        if let FitStageError::Fit(FitError::Shade(ShadeError::NotFinite { column, .. })) = self {
            return column.contains("coefficient");
        }
        matches!(
            self,
            FitStageError::NotConverged { .. }
                | FitStageError::RunAway { .. }
                | FitStageError::Unkept { .. }
                | FitStageError::Fit(
                    FitError::Shade(ShadeError::Irregular { .. })
                        | FitError::Undefined { .. }
                        | FitError::PoleAtStart { .. }
                        | FitError::Constrained { .. }
                        | FitError::Unsatisfiable { .. }
                )
                | FitStageError::Refused { .. }
                | FitStageError::Unreliable { .. }
        )
    }

    /// Why a formula has no fit.
    pub(super) fn reason(self) -> String {
        match self {
            FitStageError::Refused { reason, .. } => reason,
            error => error.to_string(),
        }
    }
}

impl From<ShadeError> for FitStageError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}

/// A coefficient on its way to infinity.
#[derive(Clone, Debug, PartialEq)]
pub struct Runaway {
    /// Its name.
    pub coefficient: String,
    /// Its value.
    pub value: f64,
}

impl fmt::Display for Runaway {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Runaway { coefficient, value } = self;
        write!(
            f,
            "coefficient {coefficient} ran away to {value:e}: the formula is a simpler one in disguise, or its parameters are not \
             independent; reduce it or give better starting values"
        )
    }
}
