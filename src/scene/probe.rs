//! A probe: a prefiltered cubemap of a room, and what is wanted of its lookups.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::goals::{Goals, Norms};
use super::kernel::KernelWord;
use super::limits;
use super::material::rough_part;
use super::name::Name;
use super::number::{ErrorLimit, In, Levels, Ops, Planes, Ratio, Span, TapCount, Unit, Whole};
use super::value::{List, Maybe, Text, Word, about, from_file};
use crate::data::{AlphaMap, MipChain, MipMap, ProbeLookup, SurfaceLobe};
use lobefit_truth::optics::kernel::Kernel;

/// Roughness where the scene gives none: below it a fetch is as sharp as the texels.
const ROUGHNESS: [f64; 2] = [0.1, 1.0];

/// Ratios of distances where the scene gives none: from close to a wall to half a room behind the
/// probe.
const RHO: [f64; 2] = [1.0 / 16.0, 8.0];

/// A probe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Probe {
    /// Name without control characters; escape it where it is printed.
    pub name: String,
    /// The lobe that its chain is prefiltered with.
    pub kernel: Kernel,
    /// The file of its table, relative to the scene, where it is one.
    // What the table holds is part of what the scene means; where it lies is not.
    #[serde(skip)]
    pub kernel_file: Option<String>,
    /// Roughness range of what looks it up, in [0, 1], lo <= hi.
    pub roughness: [f64; 2],
    /// Distance of the shading point over that of the probe, from what they see; lo <= hi in [1e-6,
    /// 1e3].
    pub rho: [f64; 2],
    /// Its chain of levels; `None`: fetches are by alpha.
    pub mips: Option<MipChain>,
    /// What its fits must keep; the limit is of the total variation wherever a fetch is not
    /// saturated.
    #[serde(flatten)]
    pub goals: Goals,
    /// Functions that look it up through a proxy, each once.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lookups: Vec<ProbeLookup>,
}

impl Probe {
    /// The part of its roughness range whose lobe is rough; `None` where all of it is smooth.
    pub fn rough_range(&self, map: AlphaMap) -> Option<[f64; 2]> {
        rough_part(self.roughness, map)
    }

    /// The first lookup of several fetches, with their number, where no rule of several is fitted
    /// for the lobe: for one in a file.
    pub(super) fn unruled(&self) -> Option<(usize, u32)> {
        let several = self.lookups.iter().position(|lookup| lookup.taps > 1);
        several.filter(|_| !self.kernel.is_analytic()).map(|j| (j, self.lookups[j].taps))
    }

    /// The roughness of the first and of the last level of its chain, where none that it is looked
    /// up with lies between.
    pub(super) fn unheld(&self) -> Option<[f64; 2]> {
        let chain = self.mips.as_ref()?;
        let ends = [0.0, chain.widest()].map(|level| chain.roughness(level));
        (self.roughness[1] < ends[0] || self.roughness[0] > ends[1]).then_some(ends)
    }

    /// The first lookup of the fitted lobe, where it is fitted for another: with fetches of the
    /// half-cosine lobe.
    pub(super) fn unfitted(&self) -> Option<usize> {
        let fitted = self.lookups.iter().position(|lookup| lookup.is_fitted());
        fitted.filter(|_| self.kernel != Kernel::HalfCosine)
    }
}

/// A probe: a prefiltered cubemap that is looked up where a ray meets the proxy of a room. It calls
/// for fits of the width alpha' of the lobe to fetch, by the width alpha seen from the shading
/// point and the ratio rho of its distance to the probe's.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Probe")]
#[serde(deny_unknown_fields, expecting = "an object that describes a probe")]
struct ProbeFile {
    /// Name; unique among the probes.
    name: Text<Name>,
    /// The lobe that its levels are prefiltered with: `ndf` D(theta), `half` D(theta/2),
    /// `half-cosine` D(theta/2) cos(theta), which is what engines bake and the default; or the path
    /// of a .json file, relative to the scene, with a table of another lobe
    /// (`lobefit schema --kernel`).
    #[serde(default)]
    kernel: Maybe<KernelWord>,
    /// Roughness of what looks it up: a number, or the range [lo, hi]; default [0.1, 1]. Where
    /// alpha is below 0.0001 it calls for nothing.
    #[serde(default)]
    roughness: Maybe<Span<Unit, true>>,
    /// Distance of the shading point over that of the probe, from the point of the proxy that both
    /// see: a number, or the range [lo, hi]; default [0.0625, 8]. Where even the widest lobe is too
    /// narrow nothing is promised.
    #[serde(default)]
    rho: Maybe<Span<Ratio, true>>,
    /// Its chain of levels, for functions of the level; default none.
    #[serde(default)]
    mips: Maybe<Mips>,
    /// Most operations that an emitted fit may take; default: any number. Where that leaves no fit,
    /// `lookups` cannot be made, and the bake fails.
    #[serde(default)]
    max_ops: Maybe<Whole<Ops>>,
    /// Largest total variation between the footprint that is wanted and the one that is fetched
    /// that at least one emitted fit within `max_ops` must keep, on a grid over `roughness` and
    /// `rho` without its saturated cells, else the bake fails; default: no limit. It bounds the
    /// error of radiance in units of the scene's range. The best width itself leaves up to 0.034
    /// (half-cosine).
    #[serde(default)]
    max_error: Maybe<In<ErrorLimit>>,
    /// Errors to minimise, `max` or `rms`, one fit each; default `max`.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    norms: Norms,
    /// Functions that look it up, each with its proxy of the room and its number of fetches;
    /// default none. They take the width from the fit of the least largest relative error and
    /// return directions with widths, or with levels where `mips` is given.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    lookups: Maybe<List<ProbeLookup, { limits::LOOKUPS_MAX }>>,
}

/// A function that looks a probe up: where the ray that a surface reflects meets the proxy, and
/// what to fetch from there.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Lookup")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a lookup, which may be empty")]
struct LookupFile {
    /// Whether the engine itself finds what the ray hits (by a ray, a depth buffer, a box of its
    /// own) and passes how far it is and where from the probe: the least expensive lookup, by the
    /// distances alone. Not with another field; default false.
    hit: Maybe<bool>,
    /// Number of planes of the proxy; default: a box along the axes, between two corners.
    planes: Maybe<Whole<Planes>>,
    /// Edges of the proxy: `smooth`, which rounds them by the width of the lobe so that nothing
    /// jumps there, or `sharp`; default `smooth`.
    edges: Maybe<Word<Edges>>,
    /// Number of fetches: 1, or where the kernel is no file 2 or 3 along the axis that the wall
    /// stretches; default 1.
    taps: Maybe<Whole<TapCount>>,
    /// What the lobe of a surface is taken for: `mirror`, round about the reflected ray, or for
    /// half-cosine chains `fitted`, leaning towards the normal and squashed at grazing angles as
    /// GGX is, by normal and view; default `mirror`.
    lobe: Maybe<Word<SurfaceLobe>>,
}

/// Edges of a proxy.
#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum Edges {
    Smooth,
    Sharp,
}

impl TryFrom<LookupFile> for ProbeLookup {
    type Error = String;

    fn try_from(file: LookupFile) -> Result<Self, String> {
        let hit = file.hit.0 == Some(true);
        if hit
            && (file.planes.0.is_some()
                || file.edges.0.is_some()
                || file.taps.0.is_some()
                || file.lobe.0.is_some())
        {
            return Err(about("hit", "what the engine hits has no proxy, and one fetch of the mirror lobe"));
        }
        Ok(ProbeLookup {
            hit,
            planes: file.planes.0.map(|n| n.0),
            smooth: !matches!(file.edges.0, Some(Word(Edges::Sharp))),
            taps: file.taps.0.map_or(1, |n| n.0),
            lobe: file.lobe.0.map_or_else(SurfaceLobe::default, |w| w.0),
        })
    }
}

/// The lookups, each once.
fn lookups(list: Option<List<ProbeLookup, { limits::LOOKUPS_MAX }>>) -> Result<Vec<ProbeLookup>, String> {
    let Some(List(list)) = list else { return Ok(Vec::new()) };
    if list.is_empty() {
        return Err(about("lookups", "the list is empty; leave the field out for no lookup"));
    }
    let repeated = list.iter().enumerate().find(|(i, lookup)| list[..*i].contains(lookup));
    match repeated {
        Some((i, lookup)) => {
            Err(about(format!("lookups[{i}]"), format!("{} is in the list already", lookup.text())))
        }
        None => Ok(list),
    }
}

/// A chain of prefiltered levels: a published `map` with its `count`, or the roughness of each of
/// its `levels`.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Mips", extend("minProperties" = 1))]
#[serde(deny_unknown_fields, default, expecting = "an object with `map` and `count`, or with `levels`")]
struct MipsFile {
    /// Roughness r to level: `linear` r, `r(2-r)`, `r(1.7-0.7r)`, all times `count` - 1; `log`
    /// `count` - 2 + 1.2 log2 r.
    map: Maybe<Word<MipMap>>,
    /// Number of levels, with `map`; at least 3 for `log`.
    count: Maybe<Whole<Levels>>,
    /// Roughness of every level, strictly increasing; between levels it is interpolated.
    #[schemars(extend("minItems" = 2, "uniqueItems" = true))]
    levels: Maybe<List<In<Unit>, { limits::LEVELS_MAX }>>,
}

/// The chain of a file.
struct Mips(MipChain);

impl TryFrom<MipsFile> for Mips {
    type Error = String;

    fn try_from(file: MipsFile) -> Result<Self, String> {
        match (file.map.0, file.count.0, file.levels.0) {
            (Some(map), Some(count), None) => {
                if map.0 == MipMap::Log && count.0 < 3 {
                    return Err(about(
                        "count",
                        "a logarithmic chain has roughness 1 in its last level but one; give 3 or more",
                    ));
                }
                Ok(Mips(MipChain::Mapped { map: map.0, count: count.0 }))
            }
            (None, None, Some(List(levels))) => {
                let levels: Vec<f64> = levels.into_iter().map(|level| level.0).collect();
                if levels.len() < limits::LEVELS_MIN {
                    let (given, least) = (levels.len(), limits::LEVELS_MIN);
                    return Err(about("levels", format!("{given} where at least {least} are called for")));
                }
                if let Some(i) = levels.windows(2).position(|pair| pair[1] - pair[0] < NARROWEST_STEP) {
                    let [low, high] = [levels[i], levels[i + 1]];
                    let message = format!("{high} does not follow {low} by {NARROWEST_STEP} or more");
                    return Err(about(format!("levels[{}]", i + 1), message));
                }
                Ok(Mips(MipChain::Given(levels)))
            }
            _ => Err("give `map` with `count`, or `levels` alone".into()),
        }
    }
}

/// Least step between the roughness of levels: their functions divide by it, in f32.
const NARROWEST_STEP: f64 = 1e-4;

impl TryFrom<ProbeFile> for Probe {
    type Error = String;

    fn try_from(file: ProbeFile) -> Result<Self, String> {
        let (kernel, kernel_file) = match file.kernel.0 {
            None => (Kernel::default(), None),
            Some(KernelWord::Known(kernel)) => (kernel, None),
            // read when the whole scene is
            Some(KernelWord::File(path)) => (Kernel::default(), Some(path)),
        };
        Ok(Probe {
            name: file.name.0,
            kernel,
            kernel_file,
            roughness: file.roughness.0.map_or(ROUGHNESS, |s| s.0),
            rho: file.rho.0.map_or(RHO, |s| s.0),
            mips: file.mips.0.map(|mips| mips.0),
            goals: Goals::read(file.max_ops, file.max_error, file.norms)?,
            lookups: lookups(file.lookups.0)?,
        })
    }
}

from_file!(Mips, MipsFile);
from_file!(ProbeLookup, LookupFile);
from_file!(Probe, ProbeFile);
