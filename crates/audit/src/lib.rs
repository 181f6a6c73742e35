//! Other people's tables and shader functions against the truth: the verbs `lobefit audit`
//! and `lobefit furnace`.
//!
//! | module | purpose |
//! |---|---|
//! | [`foreign`] | bytes of tables and shader files to plain values and tapes |
//! | [`audit`] | the conventions that a table may follow, the best of them, and what is wrong under it |
//! | [`cost`] | what a function costs in compiled instructions, beside our formulas |
//! | [`furnace`] | a whole BRDF function in a white furnace, and for reciprocity |
//! | [`ltc`] | tables of linearly transformed cosines |
//! | [`report`] | the figures of an audit and their page |
//! | [`run`] | the verbs `audit` and `furnace` |
//!
//! The program `lobefit` runs the binary of this package for both. Readers of files
//! that are not our own, and the parser for GLSL, are compiled here and nowhere else.

pub mod audit;
mod cli;
pub mod cost;
pub mod foreign;
pub mod furnace;
pub mod ltc;
pub mod report;

pub use cli::run;
