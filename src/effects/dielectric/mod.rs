//! The effect `dielectric`: what a dielectric's lobe reflects with the exact Fresnel term. Quantity
//! `ggx-glass`, column R from outside.

use super::context::Context;
use super::demand::{Demand, Job, Span};
use super::effect::Note;
use super::value::{IOR_WIDTH_MIN, ValueFits};
use super::who::{about, named, reasons, rough, verb};
use super::{BakeError, Called, Effect, JobSummary, Made, ggx};
use crate::approximate::target::Target;
use crate::approximate::{Entry, own, published};
use crate::data::Use;
use crate::scene::limits::EXACT_IOR;
use crate::scene::{Kind, Material, Scene};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::{GgxGlass, Quantity};

/// The effect.
pub struct Dielectric;

/// R(alpha, mu, ior) with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 4] =
    own!["ggx_dielectric_37", "ggx_dielectric_41", "ggx_dielectric_47", "ggx_dielectric_50"];

/// What engines ship: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 4] = published![
    "ggx_dielectric_fresnel" by "A. Fresnel, of a smooth surface",
    "ggx_dielectric_schlick" by "C. Schlick 1994, of a smooth surface",
    "ggx_dielectric_karis" by "B. Karis, Physically Based Shading on Mobile, 2014",
    "ggx_dielectric_materialx" by "MaterialX, mx_ggx_dir_albedo_analytic",
];

/// Least alpha of a job. For narrower lobes, which are near Fresnel's own term, every value of the truth
/// is an integral of its own.
const ALPHA_MIN: f64 = 4e-4;

/// Least cosine of which the truth is quick, and seconds of the truth with smaller ones.
const MU_QUICK: f64 = 2e-4;
const SLOW_S: f64 = 60.0;

const FITS: ValueFits = ValueFits {
    quantity: &GgxGlass,
    side: Some(Side::Outside),
    column: "R",
    own: &HYPOTHESES,
    published: &PUBLISHED,
    role: "ggx_dielectric_albedo",
    of: "dielectrics",
    field: "wants.exact_fresnel",
    because: "with a rough specular lobe wants the exact Fresnel term",
    caption: "R of the lobe: the rest of the light goes in, or is lost between facets.",
    curves: &[0.1, 0.2, 0.4, 0.7, 1.0],
    shown_at: &[("ior", 1.5)],
    seconds: [1.0, 0.2],
    table: None,
    around: None,
};

impl Effect for Dielectric {
    fn name(&self) -> &'static str {
        "dielectric"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material, range): (usize, &Material, [f64; 2])| {
            let (want, ior) = (material.wants.exact_fresnel.as_ref()?, material.ior?);
            let least = scene.alpha.roughness(ALPHA_MIN);
            if range[1] < least {
                return None;
            }
            let range = [range[0].max(least), range[1]];
            let mut demand = FITS.demand(scene, of, range, want.goals.clone());
            demand.spans.insert("ior", Span::at_least(ior, IOR_WIDTH_MIN, [1.0, EXACT_IOR]));
            Some(demand)
        };
        rough(scene).filter_map(demand).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let dielectric = |m: &&Material| m.kind == Kind::Dielectric;
        let (smooth, others): (Vec<&Material>, Vec<&Material>) =
            scene.materials.iter().filter(dielectric).partition(|m| m.wants.exact_fresnel.is_some());
        if smooth.is_empty() && others.is_empty() {
            return "no material is a dielectric".into();
        }
        let near = |m: &[&Material]| {
            let (named, stay) = (named(m), verb(m, "stay"));
            format!("{named} {stay} below alpha {ALPHA_MIN}, where the lobe is near Fresnel's own term")
        };
        reasons([about(&smooth, near)]).unwrap_or_else(|| {
            "no dielectric wants `exact_fresnel`; with Schlick's term it is of `reflection`".into()
        })
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let [truth, fit] = FITS.seconds;
        let truth = if scene.mu[0] < MU_QUICK { SLOW_S } else { truth };
        ValueFits { seconds: [truth, fit], ..FITS }.expects(jobs)
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        HYPOTHESES.iter().chain(&PUBLISHED).collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let suits = target.quantity.name() == GgxGlass.name()
            && (target.column, target.used_as) == (FITS.column, Use::VALUE)
            && target.variant.side == FITS.side;
        HYPOTHESES.iter().chain(&PUBLISHED).filter(|_| suits).collect()
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &[FITS.role]
    }

    fn lobe(&self, scene: &Scene) -> String {
        ggx(scene)
    }

    fn notes(&self) -> &'static [Note] {
        &[(
            &[FITS.role],
            &[
                "`ggx_dielectric_albedo` is R, the albedo of a dielectric's single-scattering lobe with the exact Fresnel term, seen from outside.",
                "The layer below receives at most 1 - R. The light that is lost between facets is part of 1 - R and reaches neither. Pass an ior",
                "within the stated domain.",
            ],
        )]
    }

    fn is_explored(&self) -> bool {
        true
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        FITS.bake(called, context)
    }
}
