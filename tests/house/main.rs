//! The sources and the README themselves.

mod floors;
mod readme;
