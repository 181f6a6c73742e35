//! What can go wrong when a truth is asked for.

/// Why no value is given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegrateError {
    /// An input lies outside the quantity's domain or is not a number.
    #[error("{quantity}: {input} = {value:?} {domain}")]
    Domain {
        /// Quantity asked for.
        quantity: &'static str,
        /// Input's name.
        input: &'static str,
        /// Its value.
        value: f64,
        /// How it misses the domain, as `is outside [0, 1]`.
        domain: &'static str,
    },
    /// The largest rule does not reach the tolerance.
    #[error("{quantity} at {place}: error bound {reached:e} after the largest rule, tolerance {tolerance:e}")]
    Tolerance {
        /// Quantity asked for.
        quantity: &'static str,
        /// Where.
        place: String,
        /// Error bound reached.
        reached: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// A value came out NaN or infinite: a defect of this program.
    #[error("{quantity} at {place}: the integral is not finite")]
    NotFinite {
        /// Quantity asked for.
        quantity: &'static str,
        /// Where.
        place: String,
    },
    /// A search that cannot go on.
    #[error("{quantity}: a search from {start:?}: {reason}")]
    Search {
        /// Quantity asked for.
        quantity: &'static str,
        /// The parameters that it began with.
        start: Vec<f64>,
        /// What stopped it.
        reason: String,
    },
    /// What is sought as a minimum has none where it is sought.
    #[error(
        "{quantity} at {place}: {what} has no best value: the error falls to the end of what is searched"
    )]
    NoMinimum {
        /// Quantity asked for.
        quantity: &'static str,
        /// Where.
        place: String,
        /// What is sought.
        what: &'static str,
    },
    /// A variant of a quantity that does not say what the quantity depends on.
    #[error("{quantity} depends on `{choice}`, which the variant leaves open")]
    Variant {
        /// Quantity asked for.
        quantity: &'static str,
        /// What is left open.
        choice: &'static str,
    },
    /// A quantity that is no albedo of a BRDF, or does not say of which.
    #[error("{quantity} gives no BRDF")]
    NoBrdf {
        /// Quantity asked for.
        quantity: &'static str,
    },
    /// Points that lack an input.
    #[error("{quantity}: the points have no column `{input}`")]
    NoInput {
        /// Quantity asked for.
        quantity: &'static str,
        /// The input.
        input: &'static str,
    },
    /// An output that a quantity does not have.
    #[error("{quantity} has no output `{output}`")]
    NoOutput {
        /// Quantity asked for.
        quantity: &'static str,
        /// The output.
        output: String,
    },
    /// Monte Carlo of a quantity that has none.
    #[error(
        "{quantity} is solved for, and no integral: it has no second opinion by Monte Carlo; leave out --method monte-carlo"
    )]
    NoSecondOpinion {
        /// Quantity asked for.
        quantity: &'static str,
    },
    /// A tolerance or sample count that makes no sense.
    #[error("{option} = {value}: {must}")]
    Option {
        /// Option's name.
        option: &'static str,
        /// Its value.
        value: String,
        /// What it must be.
        must: &'static str,
    },
}

/// An input: its name, its value, whether that is inside the domain, and how it misses it otherwise, as
/// `is outside [0, 1]`.
pub(crate) type Checked = (&'static str, f64, bool, &'static str);

impl IntegrateError {
    /// Refuses the first input that is outside its domain.
    #[inline]
    pub(crate) fn outside(
        quantity: &'static str,
        inputs: impl IntoIterator<Item = Checked>,
    ) -> Result<(), IntegrateError> {
        match inputs.into_iter().find(|(_, _, inside, _)| !inside) {
            None => Ok(()),
            Some((input, value, _, domain)) => Err(IntegrateError::Domain { quantity, input, value, domain }),
        }
    }
}
