//! The sources and the README themselves.

mod cycles;
mod floors;
mod languages;
mod readme;
