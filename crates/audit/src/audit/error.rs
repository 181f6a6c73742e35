//! Why nothing can be said of a table or function.

use lobefit::cli::{CliError, PackageError};
use lobefit_truth::integrate::IntegrateError;

/// Why an audit has no verdict.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AuditError {
    /// A table or function of which nothing can be measured as it is.
    #[error("{what}: {reason}")]
    Refused {
        /// File and array, or function.
        what: String,
        /// What is wrong with it, and what to do.
        reason: String,
    },
    /// An option that cannot be meant for this quantity or table.
    #[error("{option} = `{value}`: {reason}")]
    Option {
        /// Option.
        option: &'static str,
        /// What was given.
        value: String,
        /// What is wrong with it.
        reason: String,
    },
    /// What a file says of itself cannot be followed: the table is to be read as any other.
    #[error(
        "{what}: what it says of itself is not followed: {reason}; take the statement away, or say how the table is read by options"
    )]
    Statement {
        /// File and array.
        what: String,
        /// The line that is missing or odd.
        reason: String,
    },
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
}

impl AuditError {
    /// What is wrong, without what it is wrong with.
    pub(crate) fn reason(&self) -> String {
        match self {
            AuditError::Refused { reason, .. } => reason.clone(),
            other => other.to_string(),
        }
    }

    /// Of a table or function.
    pub(crate) fn refused(what: &str, reason: impl Into<String>) -> AuditError {
        AuditError::Refused { what: what.into(), reason: reason.into() }
    }
}

impl PackageError for AuditError {}

impl From<AuditError> for CliError {
    fn from(error: AuditError) -> CliError {
        CliError::Package(Box::new(error))
    }
}
