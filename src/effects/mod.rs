//! The catalogue of effects. Each has its quantities, default tables, hypotheses and published rivals, and knows how
//! to measure an approximation of its quantities against the truth.

pub mod anisotropy;
mod catalogue;
mod containers;
pub mod context;
pub mod coupling;
mod deviation;
mod error;
pub mod glass;
pub mod parallax;
pub mod reflection;
pub mod room;
pub mod sheen;
pub mod surface;
pub mod table;

pub use catalogue::{catalogue_names, catalogue_sources};
pub use context::{UserHypothesis, origin};
pub use deviation::{Deviation, Rounding};
pub use error::BakeError;
