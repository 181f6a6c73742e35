//! What a formula of the user's is fitted to: a quantity's column in a use, over a domain, as
//! samples to fit on and other points to certify at.
//!
//! | use | residual | inputs beside those of the quantity |
//! |---|---|---|
//! | `value` | f - truth | |
//! | `normalisation` | truth f - 1, the furnace error | |
//! | `f0-blend` | f - (f0 A + B) of `ggx-reflection`, where f0 A + B = mix(B, E, f0) | `f0` |
//! | `coupling` | f - factor of `diffuse-coupling` | |
//! | `parallax` | f / alpha_adjusted - 1 of `parallax-alpha`, where no fetch is saturated | |
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
