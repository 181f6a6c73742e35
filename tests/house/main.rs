//! The sources and the README themselves.

mod cycles;
mod floors;
mod from_outside;
mod languages;
mod readme;
mod toy_effect;
