//! Why nothing can be said of a table or function.

use lobefit::cli::{CliError, PackageError};
use lobefit_truth::integrate::IntegrateError;

/// Why an audit has no verdict.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AuditError {
    /// A function whose value is no number.
    #[error("{function}: its {component} is {value}, not a finite number, at {at}; mend the function")]
    Undefined {
        /// The function.
        function: String,
        /// Which scalar of its result.
        component: String,
        /// The value.
        value: f64,
        /// Its arguments.
        at: String,
    },
    /// A value that is no number.
    #[error("{what}: channel `{channel}`, texel {texel:?}: {value} is not a finite number; mend the file")]
    NotFinite {
        /// File and array.
        what: String,
        /// Channel.
        channel: String,
        /// Index along every axis.
        texel: Vec<usize>,
        /// The value.
        value: f64,
    },
    /// Sizes and values disagree.
    #[error(
        "{what}: channel `{channel}` has {found} values, size {size:?} calls for {expected}; give --size and --channels"
    )]
    Shape {
        /// File and array.
        what: String,
        /// Channel.
        channel: String,
        /// Size of the table.
        size: Vec<usize>,
        /// Values found.
        found: usize,
        /// Values called for.
        expected: usize,
    },
    /// The quantity has another number of inputs than the table has axes.
    #[error("{what}: a table of {size:?} texels, but {quantity} has {inputs} inputs ({names}); {advice}")]
    Axes {
        /// File and array.
        what: String,
        /// Size of the table without axes of one texel.
        size: Vec<usize>,
        /// Quantity asked for.
        quantity: &'static str,
        /// Its inputs.
        inputs: usize,
        /// Their names.
        names: String,
        /// What to do.
        advice: &'static str,
    },
    /// Too few texels to tell conventions apart.
    #[error(
        "{what}: {size:?} texels are too few to tell how the table is meant; 4 along every axis are called for"
    )]
    TooSmall {
        /// File and array.
        what: String,
        /// Size of the table.
        size: Vec<usize>,
    },
    /// More texels than an audit takes.
    #[error("{what}: {texels} texels; an audit takes at most {most}")]
    TooLarge {
        /// File and array.
        what: String,
        /// Texels.
        texels: usize,
        /// Most texels.
        most: usize,
    },
    /// Every channel holds one value throughout.
    #[error("{what}: every channel is constant ({value}); there is nothing to measure")]
    Constant {
        /// File and array.
        what: String,
        /// The value of the first.
        value: f64,
    },
    /// A function of which the arguments do not tell the inputs.
    #[error(
        "{function}: the arguments {names} are left for {inputs} inputs; give --set NAME=VALUE to those that are none"
    )]
    Arguments {
        /// Function.
        function: String,
        /// Arguments that have no value.
        names: String,
        /// Inputs of the quantity.
        inputs: usize,
    },
    /// A function could not be evaluated.
    #[error("{function}: {reason}")]
    Evaluate {
        /// Function.
        function: String,
        /// Why.
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
    /// No texel lies where the truth can be had.
    #[error("{what}: no texel lies in the domain of {quantity} under `{reading}`")]
    OutOfDomain {
        /// File and array.
        what: String,
        /// Quantity.
        quantity: String,
        /// The convention.
        reading: String,
    },
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
}

impl PackageError for AuditError {}

impl From<AuditError> for CliError {
    fn from(error: AuditError) -> CliError {
        CliError::Package(Box::new(error))
    }
}
