//! Coefficients, forms and texels by optimisation. Knows nothing of optics: data are residuals
//! `scale * f - target`, and a hypothesis is any formula of the shader language.
//!
//! [`optimise`] finds a formula's coefficients, [`rational`] the globally best ones of forms that
//! are a quotient of linear ones, [`mod@search`] the forms themselves. [`least`] minimises sums of
//! squares that are not a formula's. [`texels`] does for tables what [`optimise`] does for
//! formulas.

mod error;
pub mod rational;
pub mod search;
mod solve;
pub mod texels;

pub use error::FitError;
pub use solve::{
    Condition, Constraint, Fitted, Gap, Goal, Halt, Held, Least, Limits, Method, Norm, Options, Samples,
    SecondOrder, Squares, Stage, Termination, Triangle, least, optimise, residual_range, round_to_f32,
};
