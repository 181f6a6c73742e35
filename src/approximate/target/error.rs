//! What can be wrong with a target.

use lobefit_fit::FitError;
use lobefit_shade::{Place, ShadeError};
use lobefit_truth::integrate::IntegrateError;

/// A target that makes no sense, or whose truth cannot be had.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TargetError {
    /// The quantity has no such column.
    #[error("to {quantity}:{column}: no such column; the columns are {known}")]
    Column {
        /// Quantity.
        quantity: &'static str,
        /// Column asked for.
        column: String,
        /// Its columns.
        known: String,
    },
    /// The quantity cannot be used so.
    #[error("use {used_as}: {reason}")]
    Use {
        /// Use asked for.
        used_as: &'static str,
        /// Why not.
        reason: String,
    },
    /// A range that is none, or leaves the quantity's domain.
    #[error("domain {input}={low}..{high}{}: {reason}", if low == high { format!(" (or --fix {input}={low})") } else { String::new() })]
    Range {
        /// Input.
        input: String,
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// What is wrong with it.
        reason: String,
    },
    /// A range of an input that there is not.
    #[error("domain {input}: {quantity} has no such input; its inputs are {known}")]
    Input {
        /// Input.
        input: String,
        /// Quantity.
        quantity: &'static str,
        /// The inputs there are.
        known: String,
    },
    /// A word that is missing or not known.
    #[error("fix {input}: {reason}")]
    Word {
        /// Input.
        input: String,
        /// What is wrong, and the words there are.
        reason: String,
    },
    /// An edge at which the formula is to be exact and that makes no sense.
    #[error("{setting} {input}: {reason}")]
    Edge {
        /// `exact`, `rising`, `falling`.
        setting: &'static str,
        /// Input.
        input: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The formula has no argument.
    #[error("{place}: the function has no argument; name one or more of {known}")]
    NoInputs {
        /// The formula's function.
        place: Box<Place>,
        /// The inputs there are.
        known: String,
    },
    /// The formula asks for an input that the target does not have.
    #[error("{}:{}:{}: argument `{input}` is not one of {known}", place.file, place.line, place.column)]
    Argument {
        /// Where it is declared.
        place: Box<Place>,
        /// The argument.
        input: String,
        /// The inputs there are.
        known: String,
    },
    /// The domain or the formula.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A truth could not be integrated somewhere in the domain.
    #[error("{}", without_truth(.0))]
    Integrate(#[from] IntegrateError),
}

impl From<ShadeError> for TargetError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}

impl TargetError {
    /// Whether the message begins with the name of the setting to change: `domain`, `fix`, ...
    pub fn names_a_setting(&self) -> bool {
        matches!(
            self,
            TargetError::Column { .. }
                | TargetError::Use { .. }
                | TargetError::Range { .. }
                | TargetError::Input { .. }
                | TargetError::Word { .. }
                | TargetError::Edge { .. }
        ) || matches!(self, TargetError::Integrate(error) if is_of_domain(error))
    }
}

/// Whether other ranges are what helps.
fn is_of_domain(error: &IntegrateError) -> bool {
    matches!(error, IntegrateError::Domain { .. } | IntegrateError::NotFinite { .. })
}

fn without_truth(error: &IntegrateError) -> String {
    if is_of_domain(error) {
        format!("domain: {error}; give ranges that leave such inputs out")
    } else {
        error.to_string()
    }
}
