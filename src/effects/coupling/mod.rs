//! The effect `diffuse-coupling`: how much light a specular lobe leaves for the diffuse base below
//! it. Quantity `diffuse-coupling`.
//!
//! A factor stands for every albedo of the base: with albedo c the base sends back factor c, and
//! the error of the factor counts c times.

mod any;
mod bake;
mod catalogue;
mod code;
pub mod emitted;
mod findings;
mod grid;
pub mod page;
mod published;
mod reciprocity;
mod results;
mod rule;
mod table;

use super::context::Context;
use super::demand::{Demand, Job, Span, hull};
use super::effect::Profile;
use super::who::{about, anisotropy, named, reasons, rough, stay_smooth, verb};
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::target::{Target, TargetSpec};
use crate::approximate::{
    self, CallOps, Emission, Entry, FitSet, FitStageError, Formulas, Memo, Region, SafeRange, Wanted,
};
use crate::data::{AlphaMap, Ndf, Norm, Smith};
use crate::scene::{Base, Kind, Material, Scene};
pub use any::{AnyF0, Between, F0, Peak, anywhere};
pub use catalogue::{entries, hypotheses};
use catalogue::{published, sources};
use lobefit_fit::FitError;
use lobefit_shade::Hypothesis;
pub use lobefit_surface as surface;
use lobefit_truth::quantity::{self, COUPLING, Specular, Variant};
pub use published::{OWN_SPECULAR, OwnSpecular, PUBLISHED, light_ops};

impl From<surface::SurfaceError> for BakeError {
    fn from(error: surface::SurfaceError) -> BakeError {
        BakeError::Effect(Box::new(error))
    }
}

/// The effect.
pub struct DiffuseCoupling;

/// Seconds of the truths of the fits and of their pictures on one core, and of one of the fits.
const TRUTH_S: f64 = 0.9;
const FIT_S: f64 = 0.1;

impl Effect for DiffuseCoupling {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "diffuse-coupling",
                prefixes: &["diffuse_coupling"],
                lobe: super::ggx,
                notes: &[
                    super::NOTE_F0,
                    (
                        &["diffuse_coupling"],
                        &[
                            "`diffuse_coupling` is the factor of a white diffuse base below a specular lobe, for `diffuse_coupled_*`.",
                        ],
                    ),
                ],
                is_explored: true,
                without: anisotropy,
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demands = rough(scene).filter_map(|(i, m, roughness)| demand(scene, (i, m), roughness));
        demands.collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let dielectrics = scene.materials.iter().filter(|m| m.kind == Kind::Dielectric);
        let (based, bare): (Vec<&Material>, Vec<&Material>) = dielectrics.partition(|m| m.base.is_some());
        if based.is_empty() {
            let but = about(&bare, |m| format!(": {} {} no `base`", named(m), verb(m, "have")));
            return format!("no material is a dielectric with a diffuse base{}", but.unwrap_or_default());
        }
        let (black, lit): (Vec<&Material>, Vec<&Material>) =
            based.into_iter().partition(|m| m.base.as_ref().is_some_and(Base::is_black));
        let black = about(&black, |m| {
            format!("{} {} a black base, which sends back nothing", named(m), verb(m, "have"))
        });
        let lit = lit.into_iter().filter(|m| m.distribution == Ndf::Ggx);
        let (exact, lit): (Vec<&Material>, Vec<&Material>) = lit.partition(|m| m.is_exact());
        let exact = about(&exact, |m| {
            let (named, want) = (named(m), verb(m, "want"));
            format!("{named} {want} the exact Fresnel term, below which the base is of `clearcoat`")
        });
        let lit =
            about(&lit, |m| format!("{}: there the factor is (1 - f0)(1 - (1 - mu)^5)", stay_smooth(m)));
        let why = reasons([black, self.unserved(scene), exact, lit]).unwrap_or_default();
        format!("no dielectric with a diffuse base calls for it: {why}")
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let other = |m: &&Material| m.rough_base().is_some() && m.distribution != Ndf::Ggx;
        let rough: Vec<&Material> = scene.materials.iter().filter(other).collect();
        about(&rough, |m| {
            let of = if m.len() == 1 { "a rough base" } else { "rough bases" };
            format!(
                "{} {} {of} below Beckmann's lobe, for which this version has no factor",
                named(m),
                verb(m, "have")
            )
        })
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let summary = |job: &Job| {
            let specular = specular(scene, job)?;
            let fits = hypotheses(specular).len() * job.goals.norms.len();
            let of = format!("the coupling factor under a {} lobe", specular.name());
            let summary = JobSummary::fits(job, &of, TRUTH_S + fits as f64 * FIT_S);
            Some(summary.doubting(job, Formulas::of(hypotheses(specular))))
        };
        jobs.iter().filter_map(summary).collect()
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        entries().collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let kinds = target.variant.specular.into_iter().filter(|_| target.used_as == COUPLING);
        kinds.flat_map(|s| hypotheses(s).iter().chain(published(s))).collect()
    }

    fn safe_range_for(&self, target: &Target) -> Option<SafeRange> {
        let roughness = target.axes.iter().find(|axis| axis.name == "roughness")?.range;
        Some(safe_range(target.variant.specular?, roughness, target.alpha_map))
    }

    fn operations(&self, formula: &Hypothesis) -> Result<u32, FitError> {
        Ok(light_ops(formula.name())?.unwrap_or_else(|| formula.tape().cost_ops()))
    }

    fn sources(&self) -> Vec<&'static str> {
        sources().collect()
    }

    fn functions(&self) -> Vec<String> {
        emitted::names().collect()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        bake::bake(called, context)
    }
}

/// What a dielectric with a base that sends back light wants, if its lobe is rough.
fn demand(scene: &Scene, (of, material): (usize, &Material), roughness: [f64; 2]) -> Option<Demand> {
    let base = material.lit_base().filter(|_| !material.is_exact() && material.distribution == Ndf::Ggx)?;
    let [first, rest @ ..] = material.f0?.map(twelve);
    let f0 = rest.iter().fold([first; 2], |all, f0| hull(all, [*f0; 2]));
    let roughness = Span::roughness(roughness, scene.alpha).or_one(false);
    let (name, kind, specular) = (&material.name, material.kind.name(), base.specular.name());
    let rough = if base.is_rough() { "rough " } else { "" };
    let ignored = anisotropy(material).map_or("", |_| "; its anisotropy is left out of them");
    Some(Demand {
        job: format!("coupling-{specular}").into(),
        rank: base.specular as usize,
        of,
        name: name.clone(),
        field: format!("materials[{of}].base"),
        because: format!(
            "{name}: {kind} with a {rough}diffuse base under a {specular} lobe (roughness {}) wants fits{ignored}",
            roughness.text()
        ),
        // f0 may be one value: a factor is close to a multiple of 1 - f0, and one f0 leaves two
        // axes to fit over.
        spans: vec![("f0", Span::new(f0)), ("mu", Span::new(scene.mu)), ("roughness", roughness)],
        goals: base.goals.clone(),
        call: CallOps { times: evaluations(material), ..CallOps::default() },
        ..Demand::default()
    })
}

/// How often a material evaluates the factor: for each channel of its f0, where they differ.
fn evaluations(material: &Material) -> u32 {
    let differs = material.f0.is_some_and(|[red, rest @ ..]| rest.iter().any(|f0| *f0 != red));
    if differs { 3 } else { 1 }
}

/// A reflectance in twelve digits, without the rounding error of ((1.5 - 1)/(1.5 + 1))^2.
fn twelve(f0: f64) -> f64 {
    format!("{f0:.11e}").parse().unwrap_or(f0)
}

/// What multiplies the lobe of a job: as its first demand's material has it.
fn specular(scene: &Scene, job: &Job) -> Option<Specular> {
    Some(scene.materials.get(job.demands.first()?.of)?.base.as_ref()?.specular)
}

/// The emitted factor, by its role: of the usual normalised lobe without its name.
fn role(specular: Specular) -> String {
    match specular {
        Specular::Normalised => "diffuse_coupling".into(),
        Specular::Single | Specular::Compensated => format!("diffuse_coupling_{}", specular.name()),
    }
}

/// Largest f0 for which a factor under a bare lobe is proven not to be negative: beyond any
/// dielectric's.
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
            quantity: &quantity::DiffuseCoupling,
            column: Some("factor".into()),
            used_as: Some(COUPLING),
            variant: Variant { specular: Some(self.specular), ..self.smith.into() },
            alpha_map,
            domain: domain.into_iter().map(|(name, range)| (name.to_string(), range)).collect(),
        }
    }
}

/// What fits keep wherever a shader may call them: no less than no light for the base. Under a bare
/// lobe the truth goes to the loss 1 - E as f0 goes to 1, which vanishes at a mirror: there no fit
/// can be told from 0.
fn safe_range(specular: Specular, roughness: [f64; 2], alpha_map: AlphaMap) -> SafeRange {
    let f0 = if specular == Specular::Single { SINGLE_F0 } else { 1.0 };
    SafeRange { roughness, alpha_map, f0 }
}

/// Fits of the factor, and the published ones beside them; of formulas that take roughness, where
/// the map to alpha is theirs. Every fit is emitted as its formula stands.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be integrated.
pub fn fit_all(spec: &CouplingSpec, memo: &Memo) -> Result<FitSet, FitStageError> {
    fit_emitted(spec, Emission::default(), memo)
}

/// The same with what is emitted of them.
fn fit_emitted(spec: &CouplingSpec, emission: Emission, memo: &Memo) -> Result<FitSet, FitStageError> {
    let wanted = Wanted {
        spec: spec.target(spec.f0),
        own: Formulas::of(hypotheses(spec.specular)),
        user: &[],
        published: published(spec.specular).collect(),
        norms: &spec.norms,
        max_ops: spec.max_ops,
        safe_range: Some(safe_range(spec.specular, spec.region.roughness, spec.region.alpha_map)),
        emission,
    };
    let mut set = approximate::fit_all(&wanted, memo)?;
    for fit in &mut set.fits {
        if let Some(ops) = published::light_ops(&fit.approximation.name)? {
            fit.approximation.cost.ops = ops;
        }
    }
    Ok(set)
}
