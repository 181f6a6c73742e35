//! Floor 3: data and hypotheses to fits. Knows nothing of optics: a hypothesis is any WGSL function of f32 inputs,
//! data are residuals `scale * f - target`.
//!
//! [`Hypothesis`] parses a formula and refuses what the dialect leaves out; [`Tape`] evaluates it in f64 and f32,
//! with derivatives and over intervals, and counts its operations; [`prove_regular`] proves that it has no pole in
//! a [`Domain`], [`prove_range`] that its values stay in a range; [`optimise`] finds its coefficients, [`rational`] the
//! globally best ones of forms that are a quotient of linear ones, [`mod@search`] the forms themselves; [`measure`] certifies them in f32, as emitted. [`texels`] does for
//! tables what [`optimise`] does for formulas.

mod certify;
mod domain;
mod error;
mod hypothesis;
mod range;
pub mod rational;
mod regular;
pub mod search;
mod solve;
mod tape;
pub mod texels;
pub mod volume;

pub use certify::{Measured, Precision, measure, measure_first, measure_in, round_up};
pub use domain::{Domain, DomainAxis};
pub use error::{FitError, Place};
pub use hypothesis::{
    Binary, Builtin, Expr, ExprKind, Formula, Function, Hypothesis, Kind, Limits, Parameter, Statement,
    Unary, Variable, power_steps,
};
pub use range::{RangeProof, prove_range};
pub use regular::prove_regular;
pub use solve::{
    Condition, Constraint, Fitted, Gap, Goal, Held, Method, Norm, Options, Samples, Stage, Termination,
    optimise, residual_range, round_to_f32,
};
pub use tape::{Assembler, BinaryOp, Interval, Node, Op, Real, Tape, UnaryOp};
