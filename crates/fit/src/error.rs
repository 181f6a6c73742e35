//! Everything that can be wrong with a fit.

use lobefit_shade::{Place, ShadeError, value_words};

/// What can be wrong with a hypothesis, its domain, its data or its coefficients.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The formula itself, its domain, or the shape of the data.
    #[error(transparent)]
    Shade(#[from] ShadeError),
    /// A formula is not a number, or infinite, at a sample, and every start of its parameters fails
    /// so.
    #[error(
        "{place} is {} at {at}, in function {function} with the parameters at their declared starts; no start does better: declare \
         others (`override NAME: f32 = VALUE;`), or narrow the domain", value_words(*value)
    )]
    Undefined {
        /// The first sub-expression that leaves the reals.
        place: Box<Place>,
        /// Function's name.
        function: String,
        /// Its value: not a number, or infinite.
        value: f64,
        /// The inputs there: `alpha = 0, mu = 0.5`.
        at: String,
    },
    /// A formula is not a number, or infinite, at a sample, in a part that no parameter changes.
    #[error(
        "{place} is {} at {at}, in function {function}, whatever its parameters are; narrow the domain to where it is defined, or \
         change this part", value_words(*value)
    )]
    UndefinedAlways {
        /// The first sub-expression that leaves the reals.
        place: Box<Place>,
        /// Function's name.
        function: String,
        /// Its value: not a number, or infinite.
        value: f64,
        /// The inputs there: `alpha = 0, mu = 0.5`.
        at: String,
    },
    /// A divisor has both signs over the samples at every start of the parameters: they have to
    /// begin on one side of a pole.
    #[error(
        "{place}: with the parameters at their declared starts this divisor of {function} changes sign over the domain, at or before \
         {at}: the formula has a pole there, and at every other start tried as well; declare starts with which it keeps its sign \
         (`override NAME: f32 = VALUE;`), or narrow the domain"
    )]
    PoleAtStart {
        /// The divisor.
        place: Box<Place>,
        /// Function's name.
        function: String,
        /// The inputs of a sample beyond the pole, as seen from the first: `alpha = 0, mu = 0.5`.
        at: String,
    },
    /// A formula has no finite value where a constraint asks for one.
    #[error(
        "{function}: its value under constraint `{constraint}` is {} at {at}; narrow the domain, or take the constraint away",
        value_words(*value)
    )]
    Constrained {
        /// Function's name.
        function: String,
        /// The constraint's name.
        constraint: String,
        /// Its value: not a number, or infinite.
        value: f64,
        /// The inputs there: `alpha = 0, mu = 0.5`.
        at: String,
    },
    /// The power of a p-norm is out of range.
    #[error(
        "the power of a p-norm is {power}: it must lie in 2 .. {largest}; the limit of large powers is the goal max"
    )]
    Power {
        /// Power given.
        power: f64,
        /// Largest power known.
        largest: f64,
    },
    /// No coefficients were found that obey a constraint.
    #[error(
        "constraint `{constraint}`: no coefficients of {function} were found that keep it; at {at} it stays {by:.3e} off; \
         loosen it, take another constraint away, or give the formula more freedom"
    )]
    Unsatisfiable {
        /// The constraint's name.
        constraint: String,
        /// Function's name.
        function: String,
        /// The point where it is violated most: `alpha = 0.5, mu = 1`.
        at: String,
        /// By how much, in units of the formula's value, at the best coefficients found.
        by: f64,
    },
    /// A rational form has no coefficients with a positive denominator at every sample.
    #[error("no coefficients make the denominator positive at every sample{}", in_the_way(*.sample))]
    NoDenominator {
        /// Index of a sample in the way, where one is known.
        sample: Option<usize>,
    },
    /// Constraints contradict one another.
    #[error(
        "no coefficients keep all {rows} constraints with a positive denominator; take constraints away or loosen them"
    )]
    Infeasible {
        /// Number of constraints.
        rows: usize,
    },
    /// A coefficient without an effect of its own.
    #[error(
        "coefficient {parameter} (counted from 0) changes nothing that the earlier ones cannot: take it out of the formula"
    )]
    Degenerate {
        /// Index of the coefficient.
        parameter: usize,
    },
    /// A solver could not go on.
    #[error("solver: {message}")]
    Solver {
        /// What it says.
        message: String,
    },
}

/// A sample that no denominator is positive at, as the end of a sentence.
pub(crate) fn in_the_way(sample: Option<usize>) -> String {
    sample.map_or_else(String::new, |sample| format!("; sample {sample} is one of those in the way"))
}
