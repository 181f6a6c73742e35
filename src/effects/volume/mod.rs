//! Tables of three axes in the layouts that are made for the trilinear lookup: axes ([`aniso_axes`], [`glass_axes`],
//! [`azimuth_axes`]), texels optimised for it ([`VolumePlan`]), and the azimuth in four channels ([`Azimuth`]).
//!
//! All of them hold losses, 1 - E, whose rounding to a half is small where E is close to 1.
//!
//! | table | size | columns | rows | slices | texel |
//! |---|---|---|---|---|---|
//! | `ggx-reflection-aniso`, azimuth mean | 64 x 64 x 32 | mu, `homogeneous` | roughness | anisotropy, `aspect` | loss |
//! | `ggx-glass`, each side | 128 x 128 x 32 | mu, `homogeneous-ior` | roughness | ior, `ior` | loss |
//! | `ggx-reflection-aniso` with azimuth | 64 x 16 x 16 | mu, `homogeneous` in the alpha towards the view | roughness | anisotropy, `aspect` | cubic of the azimuth |

mod axes;
mod azimuth;
mod plan;

pub use axes::{aniso_axes, azimuth_axes, glass_axes};
pub use azimuth::Azimuth;
pub use plan::{Point, VolumePlan};

/// Size of the table of the azimuth mean.
pub const ANISO_SIZE: [usize; 3] = [64, 64, 32];

/// Size of each of the two tables of glass.
pub const GLASS_SIZE: [usize; 3] = [128, 128, 32];

/// Size of the table with the azimuth: 128 KiB in halves of four channels.
pub const AZIMUTH_SIZE: [usize; 3] = [64, 16, 16];

/// Samples per cell that the texels of glass are optimised on: four from slice to slice, where the error is.
pub const GLASS_SAMPLES: [usize; 3] = [2, 1, 4];

/// The same for the azimuth mean.
pub const ANISO_SAMPLES: [usize; 3] = [2, 2, 2];

/// Rounds of relaxation after which the error of these tables stands still.
pub const ROUNDS: usize = 12;
