//! The jobs of a plan: plain values that name everything the work needs.

use super::effect::EffectName;
use crate::data::{AlphaMap, MipChain, ProbeLookup, Smith, TexelFormat};
use crate::scene::{Layout, Norm, Serves, VolumeLayout};
use lobefit_truth::integrate::coupling::Specular;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::kernel::Kernel;

/// Narrowest roughness range of a job. A range of one value has no axis to interpolate along and no second
/// dimension to fit, so it is widened about itself to this width; the figure is a choice, small beside the
/// curvature of E in roughness.
pub const ROUGHNESS_WIDTH_MIN: f64 = 0.01;

/// Range of mu over which every table is judged, whatever the fits' domain is.
pub const JUDGED_MU: [f64; 2] = [1e-3, 1.0];

/// Narrowest range of anisotropy or index of refraction of a job, for the same reason and by the same choice.
pub const SPAN_WIDTH_MIN: f64 = 0.01;

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

/// What a table of three axes holds the albedo of, with the hull of the materials' ranges, at least `SPAN_WIDTH_MIN`
/// wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VolumeSpan {
    /// An anisotropic lobe: range of the anisotropy in [0, 1].
    Anisotropy([f64; 2]),
    /// Rough glass: range of the index of refraction in [1, 3].
    Ior([f64; 2]),
}

impl VolumeSpan {
    /// The variable's name: `anisotropy` or `ior`.
    pub fn input(self) -> &'static str {
        match self {
            VolumeSpan::Anisotropy(_) => "anisotropy",
            VolumeSpan::Ior(_) => "ior",
        }
    }

    /// Its range.
    pub fn range(self) -> [f64; 2] {
        match self {
            VolumeSpan::Anisotropy(range) | VolumeSpan::Ior(range) => range,
        }
    }

    /// The effect that it belongs to.
    pub fn effect(self) -> EffectName {
        match self {
            VolumeSpan::Anisotropy(_) => EffectName::Anisotropy,
            VolumeSpan::Ior(_) => EffectName::Glass,
        }
    }
}

/// One table of a [`VolumeJob`].
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeTable {
    /// Name, unique in its plan: `ggx-aniso-correlated-64x64x32`, `ggx-glass-inside-correlated-128x128x32`,
    /// `path-tracer-reflection-separable-64x64x32`, with `-azimuth` before the shadowing form and `-f32` at the end
    /// where they apply.
    pub name: String,
    /// Where the ray comes from; `None` of an anisotropic lobe.
    pub side: Option<Side>,
}

/// The tables of three axes to bake for all materials that want the same size, format and layout: one of an anisotropic
/// lobe, of rough glass one for each side.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeJob {
    /// The tables; of glass outside, inside. All of the same size.
    pub tables: Vec<VolumeTable>,
    /// Shadowing form: the scene's; separable in the path tracer's layout.
    pub smith: Smith,
    /// How roughness becomes alpha: as the scene says; alpha = roughness in the path tracer's layout.
    pub alpha_map: AlphaMap,
    /// Coordinates.
    pub layout: VolumeLayout,
    /// Columns, rows and slices.
    pub size: [usize; 3],
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Roughness that the rows span: the hull of the materials' rough ranges, at least `ROUGHNESS_WIDTH_MIN` wide, from alpha = 4e-4 on.
    pub roughness: [f64; 2],
    /// The lobe and its range.
    pub span: VolumeSpan,
    /// Limit on the error of the trilinear lookup: the strictest of the materials'. `None` in the path tracer's layout.
    pub max_error: Option<f64>,
    /// The limits that `max_error` is the strictest of, in the scene's order.
    pub limits: Vec<Limit>,
    /// Those of them that cannot be judged: of materials whose roughness lies below all rows.
    pub unjudged: Vec<Limit>,
    /// Names of the materials that want it, in the scene's order.
    pub materials: Vec<String>,
}

impl VolumeJob {
    /// The materials that set `max_error`, with the field of each: `gold (materials[0].wants.tables[1].max_error)`.
    pub fn limited_by(&self) -> String {
        listed(self.limits.iter().filter(|limit| Some(limit.max_error) == self.max_error))
    }

    /// The materials whose limits cannot be judged, with the field of each; none where all can.
    pub fn unjudged_by(&self) -> Option<String> {
        (!self.unjudged.is_empty()).then(|| listed(self.unjudged.iter()))
    }

    /// Texels of one of its tables.
    pub fn texels(&self) -> usize {
        self.size.iter().product()
    }
}

/// A limit on an error, and where the scene sets it.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Name of the material or probe.
    pub material: String,
    /// The field, as `materials[0].wants.fit.max_error`; of a table whose size is not given it may be a default.
    pub field: String,
    /// The limit.
    pub max_error: f64,
}

fn listed<'a>(limits: impl Iterator<Item = &'a Limit>) -> String {
    limits.map(|l| format!("{} ({})", l.material, l.field)).collect::<Vec<_>>().join(", ")
}

/// A limit that a material or a probe sets: one emitted normalisation, or fit of the sheen, of a coupling or of a lookup, of at most `max_ops` operations within `max_error`.
#[derive(Clone, Debug, PartialEq)]
pub struct FitPromise {
    /// Most operations; `None`: any.
    pub max_ops: Option<u32>,
    /// Largest furnace error |E N - 1|; of the sheen, largest error of E; of a coupling, largest error of the factor; of a lookup, largest
    /// total variation.
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
    /// Also fit f0 A + B.
    pub blend: bool,
    /// The user's hypothesis files, relative to the scene file, each once.
    pub hypotheses: Vec<String>,
    /// Names of the materials that want it, in the scene's order.
    pub materials: Vec<String>,
}

/// The fits of the sheen's albedo: one job for the whole scene, merged as [`FitJob`] is.
#[derive(Clone, Debug, PartialEq)]
pub struct SheenJob {
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Roughness domain of the sheen, at least `ROUGHNESS_WIDTH_MIN` wide.
    pub roughness: [f64; 2],
    /// Domain of mu.
    pub mu: [f64; 2],
    /// Most operations of an emitted fit; `None`: any.
    pub max_ops: Option<u32>,
    /// The strictest error of the promises, for summaries; what must hold are the `promises`.
    pub max_error: Option<f64>,
    /// What must hold of the emitted fits, each by itself: `max_error` is of E here.
    pub promises: Vec<FitPromise>,
    /// Errors to minimise, in the order max, rms.
    pub norms: Vec<Norm>,
}

/// The fits of the coupling of diffuse bases with one kind of specular lobe: one job for all dielectrics of the scene that have
/// that, merged as [`FitJob`] is.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingJob {
    /// What multiplies the specular lobe.
    pub specular: Specular,
    /// Shadowing form.
    pub smith: Smith,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Roughness domain, at least `ROUGHNESS_WIDTH_MIN` wide.
    pub roughness: [f64; 2],
    /// Domain of mu.
    pub mu: [f64; 2],
    /// The hull of the materials' reflectances at normal incidence, over their colour channels. It may be one value: a factor is
    /// close to a multiple of 1 - f0, and one f0 leaves two axes to fit over.
    pub f0: [f64; 2],
    /// Most operations of an emitted fit; `None`: any.
    pub max_ops: Option<u32>,
    /// The strictest error of the promises, for summaries; what must hold are the `promises`.
    pub max_error: Option<f64>,
    /// What must hold of the emitted fits, each by itself: `max_error` is of the factor here.
    pub promises: Vec<FitPromise>,
    /// Errors to minimise, in the order max, rms.
    pub norms: Vec<Norm>,
}

/// The fits of the width of a fetch from chains that are prefiltered with one kind of lobe: one job for all probes of the scene that have
/// that, merged as [`FitJob`] is.
#[derive(Clone, Debug, PartialEq)]
pub struct ParallaxJob {
    /// The lobe.
    pub kernel: Kernel,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Roughness domain, at least `ROUGHNESS_WIDTH_MIN` wide.
    pub roughness: [f64; 2],
    /// Domain of the ratio of distances, its ends at least 1 % apart.
    pub rho: [f64; 2],
    /// The different chains of levels, in the order of the probes.
    pub chains: Vec<MipChain>,
    /// The different lookups, with the chain of the probe that they fetch from, in the order of the probes.
    pub lookups: Vec<(ProbeLookup, Option<MipChain>)>,
    /// Most operations of an emitted fit; `None`: any.
    pub max_ops: Option<u32>,
    /// The strictest error of the promises, for summaries; what must hold are the `promises`.
    pub max_error: Option<f64>,
    /// What must hold of the emitted fits, each by itself: `max_error` is of the total variation here, where a fetch is not saturated.
    pub promises: Vec<FitPromise>,
    /// Errors to minimise, in the order max, rms.
    pub norms: Vec<Norm>,
}
