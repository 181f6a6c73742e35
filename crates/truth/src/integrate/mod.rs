//! A quantity at a point, integrated to a value with an error bound.

pub mod aniso;
pub mod brdf;
pub mod count;
mod error;
mod estimate;
pub mod glass;
mod goal;
pub mod monte_carlo;
mod patches;
mod path;
pub mod reflection;
pub mod walk;

pub use error::IntegrateError;
pub(crate) use estimate::Integrand;
pub use estimate::{Estimate, PanelRule};
pub(crate) use goal::Goal;
pub use path::Path;
