//! The effect `dielectric`: what a dielectric's lobe reflects with the exact Fresnel term. Quantity
//! `ggx-glass`, column R from outside.

use super::context::Context;
use super::demand::{Demand, Job, Span};
use super::effect::Note;
use super::value::ValueFits;
use super::who::{about, reasons, rough, stay_smooth};
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::target::Target;
use crate::approximate::{Entry, own, published};
use crate::data::Use;
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

/// Narrowest range of the index of refraction of a job.
const IOR_WIDTH_MIN: f64 = 0.05;

/// Where the truth is quick: the domain of its table.
const IOR: [f64; 2] = [1.0, 3.0];

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
            let mut demand = FITS.demand(scene, of, range, want.goals.clone());
            demand.spans.insert("ior", Span::at_least(ior, IOR_WIDTH_MIN, IOR));
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
        reasons([about(&smooth, stay_smooth)]).unwrap_or_else(|| {
            "no dielectric wants `exact_fresnel`; with Schlick's term it is of `reflection`".into()
        })
    }

    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        FITS.expects(jobs)
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

    fn notes(&self) -> &'static [Note] {
        &[(
            &[FITS.role],
            &[
                "`ggx_dielectric_albedo` is R of a dielectric's single-scattering lobe with the exact Fresnel term, seen from outside. What lies",
                "below is dimmed by no more than 1 - R; of that, what is lost between facets belongs to neither.",
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
