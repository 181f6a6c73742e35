//! Floor 3: a quantity at a point, integrated to a value with an error bound.

pub mod aniso;
mod error;
mod estimate;
pub mod glass;
pub mod monte_carlo;
pub mod reflection;

pub use error::IntegrateError;
pub use estimate::{Estimate, PanelRule};
