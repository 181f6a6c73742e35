//! A formula of the user's fitted to a quantity, and searches for formulas: the verb `lobefit fit`.
//!
//! | module | purpose |
//! |---|---|
//! | [`perceptual`] | how much of an error is seen, and the light that it is seen under |
//! | [`fitting`] | one formula: samples, solver, proof, certificates, code, document, page |
//! | [`search`] | forms of the inputs, from the cheapest to the most accurate |
//! | [`run`] | the verb |
//!
//! The program `lobefit` runs the binary of this package for its verb `fit`. A bake fits the
//! formulas of its effects by `lobefit::approximate`, which this package builds upon.

mod cli;
pub mod fitting;
pub mod perceptual;
pub mod search;

pub use cli::run;
