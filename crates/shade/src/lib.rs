//! The shader language of the project: a formula is a WGSL function of f32 inputs with free
//! parameters.
//!
//! [`Source`] parses functions of numbers and vectors, [`Hypothesis`] parses a formula and refuses
//! what the dialect leaves out; [`Tape`] evaluates it in f64, f32 and f16, with derivatives and
//! over intervals, and counts its operations; [`prove_regular`] proves that it has no pole in a
//! [`Domain`], [`prove_range`] that its values stay in a range; [`measure`] certifies it in the
//! arithmetic that a shader has; [`code`] prints it in every language. Nothing here knows optics.

mod certify;
pub mod code;
pub mod comment;
mod domain;
mod error;
mod hypothesis;
mod inline;
mod range;
mod regular;
mod source;
pub mod tape;
mod trim;

pub use certify::{Measured, Precision, measure, measure_first, measure_in, round_up};
pub use domain::{Domain, DomainAxis};
pub use error::{Place, ShadeError, value_words};
pub use hypothesis::{
    Binary, Builtin, Expr, ExprKind, Fetches, Formula, Function, Hypothesis, Kind, Limits, Parameter,
    Statement, Unary, Variable, power_steps,
};
pub use range::{RangeProof, prove_range};
pub use regular::prove_regular;
pub use source::Source;
pub use tape::{BinaryOp, Features, Interval, Node, Op, Real, Tape, UnaryOp};
