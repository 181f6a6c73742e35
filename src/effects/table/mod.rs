//! Tables of all effects: from a scene's wants to measured texels, files, shader code and pages,
//! for any number of axes.
//!
//! An effect declares a [`Family`]: how its tables are named, built and judged. Where its tables
//! have slices, a third axis after mu and roughness, it is [`Sliced`], and that is all there is to
//! the effect.
//!
//! Layouts for the linear lookup hold losses, 1 - E, whose rounding to a half is small where E is
//! close to 1; their texels are optimised for it ([`TexelPlan`]).

mod bake;
mod check;
mod emit;
mod estimator;
mod family;
mod findings;
pub mod flat;
mod furnaces;
mod grid;
mod instead;
mod job;
mod judge;
mod lookup;
mod measure;
mod page;
mod plan;
mod points;
mod region;
mod results;
mod sliced;
mod spec;
mod value;

pub use bake::{BakedTable, bake};
pub use check::{Checked, check};
pub use estimator::{DRAWN, PATH_TRACER_SAMPLES, RUN, estimate};
pub use family::{Family, Further, Sliced, Truths};
pub use findings::finding;
pub use instead::table_instead;
pub use job::{TableJob, demand, demands, summaries, wanted};
pub use judge::Judge;
pub(in crate::effects) use judge::even;
pub use lookup::{Lookup, LookupError, Point};
pub use measure::{Errors, Judged, Truth, error_map, measure};
pub use plan::{Node, TexelPlan};
pub use points::{GROUP, LookupPoints};
pub use region::{Region, SliceAxis, Slices, aspect};
pub use results::{Way, WaysFinding};
pub use spec::{BuildError, Made, Spec};
pub(in crate::effects) use spec::{alpha_nodes, ior_axis};
pub use value::{Texels, ValueTable, Values, wants};

/// Rounds of relaxation after which the error of tables with slices stands still.
pub const ROUNDS: usize = 12;
