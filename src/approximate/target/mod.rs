//! What a formula of the user's is fitted to: a quantity's column in a use, over a domain, as
//! samples to fit on and other points to certify at.
//!
//! The quantity says which uses its columns have, what their errors are ([`Residual`]), how values
//! over f0 are made of a lobe's E and B ([`OverF0`]) and which points are left out ([`Excuse`]).
//!
//! [`Residual`]: lobefit_truth::quantity::Residual
//! [`OverF0`]: lobefit_truth::quantity::OverF0
//! [`Excuse`]: lobefit_truth::quantity::Excuse
//!
//! Where formula and truth are affine in f0, the error is too: it is largest at an end of the range
//! of f0, and its mean square is that over the two Gauss nodes, so that four values of f0 stand for
//! all. Roughness stands for the quantity's alpha; both are inputs of the formula.

mod affine;
mod edges;
mod error;
mod f0;
mod points;
mod sampled;
mod spec;
mod truth;

pub use error::TargetError;
pub use sampled::Sampled;
pub use spec::{Span, Target, TargetSpec};
