//! The sources and the README themselves.

mod actions;
mod cycles;
mod floors;
mod from_outside;
mod languages;
mod readme;
mod toy_effect;
