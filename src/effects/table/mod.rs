//! What tables of all effects share: the lookup and its error. Tables of three axes, whose slices lie along a further input after mu
//! and roughness, share their plan of points too.
//!
//! The layouts that are made for the trilinear lookup ([`aniso_axes`], [`azimuth_axes`], [`glass_axes`]) hold losses, 1 - E, whose
//! rounding to a half is small where E is close to 1; their texels are optimised for it ([`TexelPlan`]).
//!
//! | table | size | columns | rows | slices | texel |
//! |---|---|---|---|---|---|
//! | `ggx-reflection-aniso`, azimuth mean | 64 x 64 x 32 | mu, `homogeneous` | roughness | anisotropy, `aspect` | loss |
//! | `ggx-glass`, each side | 128 x 128 x 32 | mu, `homogeneous-ior` | roughness | ior, `ior` | loss |
//! | `ggx-reflection-aniso` with azimuth | 64 x 16 x 16 | mu, `homogeneous` in the alpha towards the view | roughness | anisotropy, `aspect` | cubic of the azimuth |

mod axes;
mod azimuth;
pub mod bake;
mod check;
mod estimator;
mod job;
mod lookup;
mod measure;
mod page;
mod plan;
mod points;
mod region;
mod results;
mod spec;

pub use axes::{aniso_axes, azimuth_axes, glass_axes};
pub use azimuth::Azimuth;
pub use check::{Checked, check};
pub use estimator::{DRAWN, SOURCES_SAMPLES, estimate};
pub use job::{PlannedTable, TableJob, demand, demands, summaries, wanted};
pub use lookup::{Lookup, LookupError, Point};
pub use measure::{Errors, Judged, Truth, error_map, measure};
pub use plan::{Node, TexelPlan};
pub use points::{GROUP, Points};
pub use region::{Region, SliceAxis, Slices, aspect};
pub use spec::{BuildError, Made, Spec};
pub(in crate::effects) use spec::{alpha_nodes, channel};

/// Samples per cell that the texels of glass are optimised on: four from slice to slice, where the error is.
pub const GLASS_SAMPLES: [usize; 3] = [2, 1, 4];

/// The same for the azimuth mean.
pub const ANISO_SAMPLES: [usize; 3] = [2, 2, 2];

/// Rounds of relaxation after which the error of these tables stands still.
pub const ROUNDS: usize = 12;

/// Seconds of the page of one of these effects on one core.
pub const REPORT_S: f64 = 0.3;

/// How the functions of tables in the path tracer's layout begin.
pub const PATH_TRACER: &str = "path_tracer_";
