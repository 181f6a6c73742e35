//! The one door to transcendental functions.
//!
//! Rust's std leaves the precision of `sin`, `exp`, `powf`, ... to the platform, so the same source
//! gives other bits on another machine. These go to the pinned pure-Rust `libm` instead;
//! `clippy.toml` bans the std ones. `sqrt`, `abs`, `floor` and `mul_add` are exact by IEEE 754 and
//! may be called directly.

pub use libm::{
    acos, acosf, acosh, asin, asinf, asinh, atan, atan2, atan2f, atanf, cbrt, cos, cosf, cosh, erfc, exp,
    exp2, exp2f, expf, expm1, lgamma, log, log1p, log2, log2f, logf, pow, powf, sin, sincos, sinf, sinh, tan,
    tanf, tanh,
};
