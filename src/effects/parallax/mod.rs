//! The effect `parallax`: a prefiltered cubemap looked up where a ray meets the proxy of a room.
//! Quantity `parallax-alpha`.

mod bake;
mod catalogue;
mod chain;
mod demand;
mod grid;
pub mod lookups;
mod page;
pub mod probe;
mod results;
pub mod room;
mod source;
pub mod taps;
mod timed;
mod variation;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::{Clock, Profile};
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::target::TargetSpec;
use crate::approximate::{self, Emission, Entry, FitSet, FitStageError, Formulas, Memo, Wanted};
use crate::data::{AlphaMap, Norm, Source};
use crate::report::TimedLookup;
use crate::scene::Scene;
pub use catalogue::{HYPOTHESES, PUBLISHED, catalogue_sources};
pub use chain::{Gives, LevelError, LevelFunction, bias, of_chain};
pub use demand::{Lobe, lobes};
pub use grid::{Cell, Grid, Spread};
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::{PARALLAX, ParallaxAlpha, Variant};
pub use lookups::{Corrected, LobeFit, Ratio, Shading, ShadingLobe, Uncorrected, Width};
pub use taps::{RuleTap, Stretch, TapRule, width};
pub use variation::{Variation, variations};

/// The effect.
pub struct Parallax;

/// Seconds of the page on one core.
const REPORT_S: f64 = 0.2;

impl Effect for Parallax {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "parallax",
                prefixes: &[PREFIX],
                lobe: |scene| format!("Prefiltered probes; alpha = {}", scene.alpha.name()),
                notes: &[
                    (
                        &["parallax_"],
                        &[
                            "`parallax_*` is the width of a fetch from a prefiltered probe, of the lobe that its comment names and no other; rho is the",
                            "distance of the shading point over that of the probe from the point of the proxy that both see, mip a level of the chain.",
                        ],
                    ),
                    (
                        &["parallax_lookup_"],
                        &[
                            "`parallax_lookup_*` is what to fetch from a probe through a proxy of its room; `parallax_meet_*`, where a ray meets that, and",
                            "`parallax_fetch_*`, one fetch along a ray, are its parts. Of these alone a NaN, in a ray, may make an infinity.",
                        ],
                    ),
                ],
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        demand::demands(scene)
    }

    fn left_out(&self, scene: &Scene) -> String {
        self.unserved(scene).map_or_else(
            || "the scene has no probe".into(),
            |why| format!("no probe is looked up with a rough lobe: {why}"),
        )
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        demand::smooth(scene)
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        jobs.iter().filter_map(|job| demand::summary(scene, job)).collect()
    }

    fn report_seconds(&self, _: &Scene, _: &[Job]) -> f64 {
        REPORT_S
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        catalogue::entries().collect()
    }

    fn timed(&self, scene: &Scene, seconds: Clock) -> Vec<TimedLookup> {
        timed::lookups(scene, seconds)
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        bake::bake(called, context)
    }
}

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct ParallaxSpec {
    /// The lobe that the chain is prefiltered with.
    pub kernel: Kernel,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Where the fits must hold.
    pub roughness: [f64; 2],
    /// Ratios of the distances of shading point and probe where they must hold.
    pub rho: [f64; 2],
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// Errors to minimise.
    pub norms: Vec<Norm>,
    /// What is emitted.
    pub emission: Emission,
}

/// Fits of the width of a fetch, and the published ones beside them; of formulas that take
/// roughness, where the map to alpha is theirs. Errors are relative to the best width, where that
/// is not saturated.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be computed.
pub fn fit_all(spec: &ParallaxSpec, memo: &Memo) -> Result<FitSet, FitStageError> {
    let domain = [("roughness", spec.roughness), ("rho", spec.rho)];
    let wanted = Wanted {
        spec: TargetSpec {
            quantity: &ParallaxAlpha,
            column: Some("alpha_adjusted".into()),
            used_as: Some(PARALLAX),
            variant: Variant { kernel: Some(spec.kernel.clone()), ..Variant::default() },
            alpha_map: spec.alpha_map,
            domain: domain.into_iter().map(|(name, range)| (name.to_string(), range)).collect(),
        },
        own: Formulas::of(&HYPOTHESES),
        user: &[],
        published: PUBLISHED.iter().collect(),
        norms: &spec.norms,
        max_ops: spec.max_ops,
        safe_range: None,
        emission: spec.emission.clone(),
    };
    let mut set = approximate::fit_all(&wanted, memo)?;
    for fit in set.fits.iter_mut().filter(|fit| fit.approximation.source == Source::Fitted) {
        fit.hypothesis = fit.hypothesis.renamed(&named(&spec.kernel, fit.hypothesis.name()));
        fit.approximation.name = named(&spec.kernel, &fit.approximation.name);
    }
    for dropped in &mut set.dropped {
        dropped.hypothesis = named(&spec.kernel, &dropped.hypothesis);
    }
    Ok(set)
}

/// The name of a function for chains of a kernel: the usual kernel is not named, any other kernel
/// follows the name of the effect.
pub fn named(kernel: &Kernel, name: &str) -> String {
    if *kernel == Kernel::default() {
        return name.into();
    }
    let rest = name.strip_prefix(PREFIX).unwrap_or(name);
    format!("{PREFIX}{}_{rest}", kernel.name().replace('-', "_"))
}

/// How the functions of this effect begin.
pub const PREFIX: &str = "parallax_";
