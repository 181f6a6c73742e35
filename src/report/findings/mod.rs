//! Everything a bake found out, as plain data: filled by the one who ran the jobs, shown by the page, and written
//! as it is to `reports/<effect>.json`.

mod approximation;
mod furnace;
mod index;
mod own;
mod search;
mod table;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Field;

pub use approximation::{ApproximationFinding, AverageFinding, AverageFit, FitCurve, FitFinding};
pub use furnace::{Furnace, FurnaceRow, Marked, Study, StudySeries};
pub use index::{Index, IndexRow};
pub use own::{FitCard, FitPage, FitSlice, SliceCurve};
pub use search::{SearchPage, SearchRow};
pub use table::{ChannelFinding, ErrorFigure, TableFinding};

/// Version of the shape of the reports' JSON files.
pub const SCHEMA_VERSION: u32 = 1;

/// What made a page: enough to make it again, and nothing that changes from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Name of the scene, as the user wrote it.
    pub scene: String,
    /// Hash of the recipe.
    pub recipe: String,
    /// Version of the tool.
    pub tool: String,
    /// Command that makes the page again.
    pub command: String,
}

/// What the bake of a scene found out.
///
/// Empty lists are fine where the scene called for nothing of the kind: the page then says so or leaves the section
/// out. Lists inside an entry must be filled.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// What made it.
    pub origin: Origin,
    /// What the scene called for.
    pub effects: Vec<EffectFinding>,
    /// What was left out.
    pub left_out: Vec<LeftOut>,
    /// Tables, with their errors.
    pub tables: Vec<TableFinding>,
    /// Truths over their inputs: E over roughness and mu.
    pub truths: Vec<Field>,
    /// Every approximation, ours and published, in the order in which the page lists them.
    pub approximations: Vec<ApproximationFinding>,
    /// Fits shown beside their truth; each names one of `approximations`.
    pub fits: Vec<FitFinding>,
    /// Fits of the average albedo over roughness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub averages: Option<AverageFinding>,
    /// Spheres in a white environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub furnace: Option<Furnace>,
    /// Error against evaluations at single points.
    pub studies: Vec<Study>,
}

/// One effect that the scene called for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectFinding {
    /// Name of the effect: `reflection`, ...
    pub effect: String,
    /// What in the scene called for it.
    pub because: Vec<String>,
    /// Domain that the scene spans, by input.
    pub ranges: BTreeMap<String, [f64; 2]>,
    /// Approximation chosen.
    pub approximation: String,
    /// Error that the scene allows; none where it sets no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_error: Option<f64>,
    /// Error that was measured; none where nothing was made that has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_error: Option<f64>,
    /// What error that is: `furnace error |E N - 1|`, ...
    pub metric: String,
}

/// One effect that the scene did not call for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    /// Name of the effect.
    pub effect: String,
    /// Why it was left out.
    pub reason: String,
}
