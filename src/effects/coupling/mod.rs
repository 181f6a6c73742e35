//! The effect `diffuse-coupling`: how much light a specular lobe leaves for the diffuse base below it. Quantity `diffuse-coupling`.
//!
//! A factor stands for every albedo of the base: with albedo c the base sends back factor c, and the error of the factor counts c times.

mod any;
pub mod bake;
mod catalogue;
mod code;
pub mod emitted;
mod findings;
mod grid;
mod page;
mod reciprocity;
pub mod results;
mod rivals;
mod rule;
mod table;

use crate::approximate::target::TargetSpec;
use crate::approximate::{self, Counter, FitSet, FitStageError, Keeps, Region, Wanted};
use crate::data::{Norm, Smith, Use};
pub use any::{AnyF0, Between, anywhere};
pub use catalogue::{catalogue_names, catalogue_sources, hypotheses, rivals};
use lobefit_truth::integrate::coupling::Specular;
use lobefit_truth::quantity::{DiffuseCoupling, Variant};
pub use rivals::{OWN_SPECULAR, OwnSpecular, RIVALS, light_ops};

/// Largest f0 for which a factor under a bare lobe is proven not to be negative: beyond any dielectric's.
const SINGLE_F0: f64 = 0.9;

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingSpec {
    /// What multiplies the specular lobe.
    pub specular: Specular,
    /// Shadowing form.
    pub smith: Smith,
    /// Where the fits must hold.
    pub region: Region,
    /// For which reflectances at normal incidence.
    pub f0: [f64; 2],
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// Errors to minimise.
    pub norms: Vec<Norm>,
}

impl CouplingSpec {
    /// The target of the fits, over reflectances in `f0`.
    fn target(&self, f0: [f64; 2]) -> TargetSpec {
        let Region { roughness, mu, alpha_map } = self.region;
        let domain = [("roughness", roughness), ("mu", mu), ("f0", f0)];
        TargetSpec {
            quantity: &DiffuseCoupling,
            column: Some("factor".into()),
            used_as: Some(Use::Coupling),
            variant: Variant { specular: Some(self.specular), ..self.smith.into() },
            alpha_map,
            domain: domain.into_iter().map(|(name, range)| (name.to_string(), range)).collect(),
        }
    }

    /// What its fits keep wherever a shader may call them: no less than no light for the base. Under a bare lobe the truth goes to the
    /// loss 1 - E as f0 goes to 1, which vanishes at a mirror: there no fit can be told from 0.
    fn keeps(&self) -> Keeps {
        let f0 = if self.specular == Specular::Single { SINGLE_F0 } else { 1.0 };
        Keeps { roughness: self.region.roughness, alpha_map: self.region.alpha_map, f0 }
    }
}

/// Fits of the factor, and the published ones beside them; of formulas that take roughness, where the map to alpha is theirs.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be integrated.
pub fn fit_all(spec: &CouplingSpec, counter: &Counter) -> Result<FitSet, FitStageError> {
    let wanted = Wanted {
        spec: spec.target(spec.f0),
        own: hypotheses(spec.specular),
        user: &[],
        published: rivals(spec.specular).collect(),
        norms: &spec.norms,
        max_ops: spec.max_ops,
        keeps: Some(spec.keeps()),
        with_f0: None,
    };
    let mut set = approximate::fit_all(&wanted, counter)?;
    for fit in &mut set.fits {
        if let Some(ops) = rivals::light_ops(&fit.approximation.name)? {
            fit.approximation.cost.ops = ops;
        }
    }
    Ok(set)
}
