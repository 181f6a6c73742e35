//! Lookups of prefiltered probes, as the page of the effect shows them.

use serde::Serialize;

use crate::data::Place;
use crate::report::Field;
use crate::report::{ApproximationFinding, EffectFinding, LeftOut, Origin};

/// What a bake found out about lookups of probes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParallaxFindings {
    /// What made it.
    pub origin: Origin,
    /// What called for it.
    pub effect: EffectFinding,
    /// Hypotheses without a fit.
    pub left_out: Vec<LeftOut>,
    /// For each kind of lobe that chains are prefiltered with.
    pub lobes: Vec<ParallaxLobe>,
}

/// The chains of one kind of lobe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParallaxLobe {
    /// `half-cosine`, ...
    pub kernel: String,
    /// As a formula.
    pub formula: String,
    /// Every fit, ours and published.
    pub approximations: Vec<ApproximationFinding>,
    /// The total variation of each of them, in their order, and last that of the best widths.
    pub variations: Vec<VariationFinding>,
    /// Places whose fetches are saturated: roughness, rho.
    pub saturated: Vec<(f64, f64)>,
    /// What the best width leaves, over roughness and rho: total variation, root mean square
    /// difference, largest difference, difference of the encircled energies.
    pub least: Vec<Field>,
    /// Relative errors of fits over roughness and rho, 0 where a fetch is saturated.
    pub maps: Vec<ParallaxMap>,
    /// The best width over rho, one per roughness.
    pub curves: Vec<ParallaxCurve>,
    /// Functions of the levels of chains.
    pub chains: Vec<ChainFinding>,
    /// Functions that look a probe up through a proxy.
    pub lookups: Vec<LookupFinding>,
}

/// The total variation of a formula.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VariationFinding {
    /// Name of the approximation, or of the best widths.
    pub name: String,
    /// Somebody else's.
    pub published: bool,
    /// Its operations; none of the best widths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ops: Option<u32>,
    /// Where the shading point is nearer than the probe.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearer: Option<VariationRow>,
    /// Where it is farther.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub farther: Option<VariationRow>,
}

/// Total variation over some cells, and other measures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VariationRow {
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub max: f64,
    /// Where that is.
    pub at: Place,
    /// Mean and largest of the root mean square difference of energies per area over that of the
    /// footprint asked for.
    pub l2: [f64; 2],
    /// Of the largest difference over the largest of what is asked for.
    pub largest: [f64; 2],
    /// Of the root of the integral over ln R of the squared difference of encircled energies.
    pub encircled: [f64; 2],
}

/// The relative error of a fit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParallaxMap {
    /// Name of the approximation.
    pub name: String,
    /// The formula as a person reads it, constants filled in; empty of a published one.
    pub formula: String,
    /// The error.
    pub error: Field,
}

/// Widths over rho at one roughness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParallaxCurve {
    /// Roughness.
    pub roughness: f64,
    /// Ratios, increasing.
    pub rho: Vec<f64>,
    /// The best width at each.
    pub best: Vec<f64>,
    /// Formula and its width at each.
    pub fits: Vec<(String, Vec<f64>)>,
}

/// A function of levels.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChainFinding {
    /// Its name.
    pub function: String,
    /// The chain in words.
    pub chain: String,
    /// What it gives.
    pub gives: String,
    /// Operations.
    pub ops: u32,
    /// Largest error in levels.
    pub max: f64,
    /// Where it is.
    pub at: Place,
}

/// A function that looks a probe up through a proxy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LookupFinding {
    /// Its name.
    pub function: String,
    /// `box`, or `planes_N`.
    pub proxy: String,
    /// `smooth` or `sharp`.
    pub edges: String,
    /// What the lobe of the surface is taken for: `mirror` or `fitted`.
    pub lobe: String,
    /// Fetches.
    pub fetches: u32,
    /// Operations, those of the functions that it calls among them.
    pub ops: u32,
    /// The width that it takes.
    pub width: String,
    /// The chain whose levels it returns, in words; none where it returns widths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chain: Option<String>,
}
