//! Floor 3: the catalogue of effects. Each has its quantities, default tables, hypotheses and published rivals, and knows how
//! to measure an approximation of its quantities against the truth.

mod quantity;
pub mod reflection;
pub mod volume;

pub use quantity::{Input, Method, QUANTITIES, Quantity, Values};
