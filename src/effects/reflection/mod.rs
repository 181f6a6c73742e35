//! The effect `reflection`: the specular lobe of rough metals and dielectrics. Quantities `ggx-reflection` and `ggx-average`.

mod accuracy;
pub mod bake;
mod catalogue;
mod fits;
mod rivals;
mod table;

pub use accuracy::{POINTS, SAMPLERS, Series, Sources, Study, studies};
pub use catalogue::{AVERAGES, BLENDS, NORMALISATIONS, SEEDS, catalogue_names, catalogue_sources};
pub use fits::{FitSpec, fit_all};
pub use rivals::{AVERAGE_RIVALS, BLEND_RIVALS, RIVALS};
pub use table::{TableSpec, build};
