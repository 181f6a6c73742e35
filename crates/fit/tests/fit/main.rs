//! The solver, the formula dialect, constraints, precision and search.

#[path = "../../../../tests/code_support/mod.rs"]
mod code_support;
#[path = "../../../../tests/fit_support/mod.rs"]
mod fit_support;

mod code;
mod constraints;
mod dialect;
mod global;
mod nist;
mod planted;
mod poles;
mod precision;
mod rational;
mod regular;
mod saddles;
mod search;
mod solve;
mod starts;
mod tape;
