//! The jobs of a plan: plain values that name everything the work needs.

use crate::data::{AlphaMap, Smith, TexelFormat};
use crate::scene::{Layout, Norm, Serves};

/// Narrowest roughness range of a job. A range of one value has no axis to interpolate along and no second
/// dimension to fit, so it is widened about itself to this width; the figure is a choice, small beside the
/// curvature of E in roughness.
pub const ROUGHNESS_WIDTH_MIN: f64 = 0.01;

/// One table to bake, for all materials that want the same size, format, layout and use.
#[derive(Clone, Debug, PartialEq)]
pub struct TableJob {
    /// Name, unique in its plan: `ggx-dfg-correlated-32x32`, and what differs from the defaults appended
    /// (`-f32`, `-plain`, `-split-sum`); `auto` in place of the size where the bake chooses it.
    pub name: String,
    /// Shadowing form.
    pub smith: Smith,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Texels along mu; `None`: the bake chooses the smallest of 16, 32, 64, 128 squares that meets `max_error`.
    pub columns: Option<usize>,
    /// Texels along roughness; `None` exactly where `columns` is.
    pub rows: Option<usize>,
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Coordinates.
    pub layout: Layout,
    /// What it is looked up for.
    pub serves: Serves,
    /// Roughness range: the hull of the materials' rough ranges, at least `ROUGHNESS_WIDTH_MIN` wide.
    pub roughness: [f64; 2],
    /// Limit on the lookup error: the strictest of the materials'. Always given where the size is not.
    pub max_error: Option<f64>,
    /// The limits that `max_error` is the strictest of, in the scene's order.
    pub limits: Vec<Limit>,
    /// Names of the materials that want it, in the scene's order.
    pub materials: Vec<String>,
}

impl TableJob {
    /// The materials that set `max_error`, with the field of each: `gold (materials[0].wants.table.max_error)`.
    pub fn limited_by(&self) -> String {
        listed(self.limits.iter().filter(|limit| Some(limit.max_error) == self.max_error))
    }
}

/// A limit on an error, and where the scene sets it.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Name of the material.
    pub material: String,
    /// The field, as `materials[0].wants.fit.max_error`; of a table whose size is open it may be a default.
    pub field: String,
    /// The limit.
    pub max_error: f64,
}

fn listed<'a>(limits: impl Iterator<Item = &'a Limit>) -> String {
    limits.map(|l| format!("{} ({})", l.material, l.field)).collect::<Vec<_>>().join(", ")
}

/// A limit that a material sets: one emitted normalisation of at most `max_ops` operations within `max_error`.
#[derive(Clone, Debug, PartialEq)]
pub struct FitPromise {
    /// Most operations; `None`: any.
    pub max_ops: Option<u32>,
    /// Largest furnace error |E N - 1|.
    pub max_error: f64,
    /// Names of the materials that ask for it.
    pub materials: Vec<String>,
    /// Their fields.
    pub limits: Vec<Limit>,
}

impl FitPromise {
    /// The materials that ask for it, with the field of each: `gold (materials[0].wants.fit.max_error)`.
    pub fn wanted_by(&self) -> String {
        listed(self.limits.iter())
    }
}

/// The fit to make: one for the whole scene, because a fit over the hull of the ranges holds in each of them.
///
/// Merge rule: the hull of the roughness ranges; the largest `max_ops` (a material content with fewer operations
/// finds those fits among the others); every norm, average and hypothesis that any material wants. Limits on the
/// error are not merged, since one belongs to its number of operations: each different pair is a [`FitPromise`].
#[derive(Clone, Debug, PartialEq)]
pub struct FitJob {
    /// Shadowing form.
    pub smith: Smith,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Roughness domain, at least `ROUGHNESS_WIDTH_MIN` wide.
    pub roughness: [f64; 2],
    /// Domain of mu.
    pub mu: [f64; 2],
    /// Most operations of an emitted fit; `None`: any.
    pub max_ops: Option<u32>,
    /// The strictest error of the promises, for summaries; what must hold are the `promises`.
    pub max_error: Option<f64>,
    /// What must hold of the emitted normalisations, each by itself.
    pub promises: Vec<FitPromise>,
    /// Errors to minimise, in the order max, rms.
    pub norms: Vec<Norm>,
    /// Also fit E_avg(alpha).
    pub average: bool,
    /// The user's hypothesis files, relative to the scene file, each once.
    pub hypotheses: Vec<String>,
    /// Names of the materials that want it, in the scene's order.
    pub materials: Vec<String>,
}
