//! The effect `reflection`: the specular lobe of rough metals and dielectrics. Quantities `ggx-reflection` and `ggx-average`.

mod accuracy;
pub mod bake;
mod catalogue;
mod field;
mod fits;
mod points;
mod region;
mod rivals;
mod samples;
mod table;

pub use accuracy::{POINTS, SAMPLERS, Series, Sources, Study, studies};
pub use catalogue::{AVERAGES, BLENDS, NORMALISATIONS, SEEDS, catalogue_names, catalogue_sources};
pub use field::{Counter, Field, TRUTH_ERROR};
pub use fits::{Dropped, Fit, FitSet, FitSpec, FitStageError, fit_all};
pub(in crate::effects) use fits::{Searched, formula, kept, searched, searched_within};
pub use points::{PointSet, certification};
pub use region::Region;
pub use rivals::{AVERAGE_RIVALS, BLEND_RIVALS, RIVALS};
pub(in crate::effects) use samples::{edged, interpolant as average_truth, uniform};
pub use table::{TableSpec, build};
