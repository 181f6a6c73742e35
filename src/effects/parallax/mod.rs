//! The effect `parallax`: a prefiltered cubemap looked up where a ray meets the proxy of a room. Quantity `parallax-alpha`.

pub mod bake;
mod catalogue;
mod chain;
mod grid;
pub mod lookups;
mod page;
pub mod probe;
pub mod results;
mod source;
pub mod taps;
mod variation;

use crate::approximate::target::TargetSpec;
use crate::approximate::{self, Counter, FitSet, FitStageError, Wanted};
use crate::data::{AlphaMap, Norm, Use};
pub use catalogue::{HYPOTHESES, RIVALS, catalogue_names, catalogue_sources};
pub use chain::{Gives, LevelError, LevelFunction, bias, of_chain};
pub use grid::{Cell, Grid, Spread};
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::{ParallaxAlpha, Variant};
pub use lookups::{Corrected, LobeFit, Ratio, Shading, ShadingLobe, Uncorrected, Width};
pub use taps::{RuleTap, Stretch, TapRule, width};
pub use variation::{Variation, variations};

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
}

/// Fits of the width of a fetch, and the published ones beside them; of formulas that take roughness, where the map to alpha is theirs.
/// Errors are relative to the best width, where that is not saturated.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be computed.
pub fn fit_all(spec: &ParallaxSpec, counter: &Counter) -> Result<FitSet, FitStageError> {
    let domain = [("roughness", spec.roughness), ("rho", spec.rho)];
    let wanted = Wanted {
        spec: TargetSpec {
            quantity: &ParallaxAlpha,
            column: Some("alpha_adjusted".into()),
            used_as: Some(Use::Parallax),
            variant: Variant { kernel: Some(spec.kernel), ..Variant::default() },
            alpha_map: spec.alpha_map,
            domain: domain.into_iter().map(|(name, range)| (name.to_string(), range)).collect(),
        },
        own: &HYPOTHESES,
        user: &[],
        published: RIVALS.iter().collect(),
        norms: &spec.norms,
        max_ops: spec.max_ops,
        keeps: None,
        with_f0: None,
    };
    let mut set = approximate::fit_all(&wanted, counter)?;
    for fit in set.fits.iter_mut().filter(|fit| fit.emitted) {
        fit.hypothesis = fit.hypothesis.renamed(&named(spec.kernel, fit.hypothesis.name()));
        fit.approximation.name = fit.hypothesis.name().to_string();
    }
    for dropped in &mut set.dropped {
        dropped.hypothesis = named(spec.kernel, &dropped.hypothesis);
    }
    Ok(set)
}

/// The name of a function for chains of a kernel: that of the usual one is not told, any other follows the effect's.
pub fn named(kernel: Kernel, name: &str) -> String {
    if kernel == Kernel::default() {
        return name.into();
    }
    let rest = name.strip_prefix(PREFIX).unwrap_or(name);
    format!("{PREFIX}{}_{rest}", kernel.name().replace('-', "_"))
}

/// How the functions of this effect begin.
pub const PREFIX: &str = "parallax_";
