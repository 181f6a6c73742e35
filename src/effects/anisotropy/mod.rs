//! The effect `anisotropy`: tables of E of the anisotropic reflection lobe over mu, roughness and anisotropy, as the mean over the
//! azimuth of the view or with it.

mod path_tracer;
mod points;
mod table;
mod truth;

pub use path_tracer::{NOTE as PATH_TRACER_NOTE, SIZE as PATH_TRACER_SIZE, axes as path_tracer_axes};
pub use points::Judge;
pub use table::{build, sources};
pub use truth::{AzimuthMap, at_azimuths, azimuth_map, means, means_on};

/// The quantity of this effect.
pub const QUANTITY: &str = "ggx-reflection-aniso";
