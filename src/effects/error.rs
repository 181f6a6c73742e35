//! Why an effect could not be baked.

use std::error::Error;

use super::table::{BuildError, LookupError};
use crate::approximate::FitStageError;
use crate::data::TableError;
use crate::emit::container::ContainerError;
use crate::emit::exr::ExrError;
use crate::report::ReportError;
use lobefit_shade::code;
use lobefit_truth::integrate::IntegrateError;

/// Why a bake made nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// A field of the scene asks for what there is not.
    #[error("{field}: {message}")]
    Scene {
        /// The field, as a path from the top of the scene.
        field: String,
        /// What is wrong with it, and what to change.
        message: String,
    },
    /// A hypothesis or a fit.
    #[error(transparent)]
    Fit(#[from] FitStageError),
    /// A table's shape or values.
    #[error(transparent)]
    Table(#[from] TableError),
    /// An image could not be encoded or decoded.
    #[error(transparent)]
    Exr(#[from] ExrError),
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// A function could not be printed.
    #[error(transparent)]
    Code(#[from] code::CodeError),
    /// The report refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A document could not be put into JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A hypothesis has the name of another function.
    #[error(
        "{file}: function `{function}` has, or leads to, the name of another emitted function; rename it"
    )]
    Name {
        /// The hypothesis' file.
        file: String,
        /// The name.
        function: String,
    },
    /// Several fetches from a chain of a kernel for which no rule says where they go.
    #[error(
        "lookups of {kernel} chains: no rule of {fetches} fetches is fitted for that lobe; give `taps` 1"
    )]
    NoRule {
        /// The kernel's word.
        kernel: String,
        /// Fetches asked for.
        fetches: usize,
    },
    /// A hypothesis whose function cannot be called so in an emitted language.
    #[error("{file}: {reason}")]
    Word {
        /// The hypothesis' file.
        file: String,
        /// What the printer says.
        reason: String,
    },
    /// What an effect says of its own.
    #[error(transparent)]
    Effect(Box<dyn Error + Send + Sync>),
    /// A table that cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A table cannot be looked up.
    #[error(transparent)]
    Lookup(#[from] LookupError),
    /// A table cannot be put into a file.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// A defect of this program.
    #[error("internal error: {0}")]
    Internal(String),
}
