//! Other people's tables and shader functions against the truth: the verb `lobefit audit`.
//!
//! | module | purpose |
//! |---|---|
//! | [`foreign`] | bytes of tables and shader files to plain values and tapes |
//! | [`audit`] | the conventions that a table may follow, the best of them, and what is wrong under it |
//! | [`cost`] | what a function costs in compiled instructions, beside our formulas |
//! | [`report`] | the figures of an audit and their page |
//! | [`run`] | the verb |
//!
//! The program `lobefit` runs the binary of this package for its verb `audit`. Readers of files
//! that are not our own, and the parser for GLSL, are compiled here and nowhere else.

pub mod audit;
mod cli;
pub mod cost;
pub mod foreign;
pub mod report;

pub use cli::run;
