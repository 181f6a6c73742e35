//! The effect `dielectric`: what a dielectric's lobe reflects with the exact Fresnel term. Quantity
//! `ggx-glass`, column R from outside.

mod table;

use super::context::Context;
use super::demand::{Demand, Job, Span};
use super::effect::Profile;
use super::table::{ValueTable, wants};
use super::value::{self, IOR_WIDTH_MIN, ValueFits};
use super::who::{about, named, verb};
use super::{BakeError, Called, Effect, JobSummary, Made, clearcoat, ggx};
use crate::approximate::{Entry, Formulas, own, published};
use crate::scene::limits::{EXACT_IOR, SLICED_ALPHA};
use crate::scene::{EXACT_FRESNEL, Goals, Kind, Material, Scene, TableWant};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::GGX_GLASS;

/// The effect.
pub struct Dielectric;

/// R(alpha, mu, ior) with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 4] =
    own!["ggx_dielectric_37", "ggx_dielectric_41", "ggx_dielectric_47", "ggx_dielectric_50"];

/// The same of one index of refraction, R(alpha, mu).
pub const OF_ONE_INDEX: [Entry; 6] = own![
    "ggx_dielectric_flat_6",
    "ggx_dielectric_flat_7",
    "ggx_dielectric_flat_8",
    "ggx_dielectric_flat_10",
    "ggx_dielectric_flat_13",
    "ggx_dielectric_flat_15",
];

/// What engines ship: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 4] = published![
    "ggx_dielectric_fresnel" by "A. Fresnel, of a smooth surface",
    "ggx_dielectric_schlick" by "C. Schlick 1994, of a smooth surface",
    "ggx_dielectric_karis" by "B. Karis, Physically Based Shading on Mobile, 2014",
    "ggx_dielectric_materialx" by "MaterialX, mx_ggx_dir_albedo_analytic",
];

/// Least alpha of a job. For narrower lobes, which are near Fresnel's own term, every value of the truth
/// is an integral of its own.
pub(super) const ALPHA_MIN: f64 = SLICED_ALPHA;

/// Least cosine of which the truth is quick, and seconds of the truth with smaller ones.
const MU_QUICK: f64 = 2e-4;
const SLOW_S: f64 = 60.0;

const FITS: ValueFits = ValueFits {
    quantity: GGX_GLASS,
    side: Some(Side::Outside),
    column: "R",
    used_as: None,
    own: Formulas { all: &HYPOTHESES, flat: &OF_ONE_INDEX },
    published: &PUBLISHED,
    role: "ggx_dielectric_albedo",
    of: "dielectrics",
    field: EXACT_FRESNEL,
    layer: None,
    because: "with a rough specular lobe wants the exact Fresnel term",
    caption: "R of the lobe: the rest of the light goes in, or is lost between facets.",
    curves: &[0.1, 0.2, 0.4, 0.7, 1.0],
    shown_at: &[("ior", 1.5)],
    seconds: [1.0, 0.2],
    table: None,
    around: None,
};

/// Its tables, but for which are wanted.
const TABLE: ValueTable = ValueTable {
    side: FITS.side,
    texels: table::texels,
    ..ValueTable::of(GGX_GLASS, FITS.column, "ggx-dielectric", "ggx_dielectric_lookup")
};

/// The tables that the dielectrics of a scene want.
fn wanted(scene: &Scene) -> Vec<(TableWant, String)> {
    let least = scene.alpha.roughness(ALPHA_MIN);
    // A coat takes those of a smooth lobe below it.
    wants(scene, EXACT_FRESNEL, |m| m.roughness[1] >= least || m.coat.is_some())
}

/// The fits, and the tables that are wanted beside them.
fn with(wants: &[(TableWant, String)]) -> ValueFits<'_> {
    let table = (!wants.is_empty()).then_some(ValueTable { wants, ..TABLE });
    ValueFits { table, ..FITS }
}

/// The same of coats, whose base keeps what their lobe leaves.
const OF_COATS: ValueFits = ValueFits {
    field: "coat",
    layer: Some("coat"),
    because: "with a coat whose base takes the albedo of its lobe",
    ..FITS
};

/// Seconds of the truth of a rough dielectric interface, and of one fit.
pub(super) fn seconds(fits: &ValueFits, scene: &Scene) -> [f64; 2] {
    let [truth, fit] = fits.seconds;
    [if scene.mu[0] < MU_QUICK { SLOW_S } else { truth }, fit]
}

impl Effect for Dielectric {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "dielectric",
                fits: &[FITS],
                prefixes: &[FITS.role, TABLE.role],
                lobe: ggx,
                notes: &[(
                    &[FITS.role, TABLE.role],
                    &[
                        "`ggx_dielectric_albedo`, and `ggx_dielectric_lookup` of a table, is R, the albedo of a dielectric's single-scattering lobe with the exact Fresnel term, seen from outside.",
                        "The layer below receives at most 1 - R. The light that is lost between facets is part of 1 - R: a base that is scaled by 1 - R gets it. Pass",
                        "roughness and ior within the stated domain, of a smoother or rougher surface the nearest roughness there: beyond it R may leave [0, 1].",
                    ],
                )],
                is_explored: true,
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material): (usize, &Material)| {
            let least = scene.alpha.roughness(ALPHA_MIN);
            let own = |fits: ValueFits, [low, high]: [f64; 2], ior, goals: Goals| {
                let mut demand = fits.demand(scene, of, [low.max(least), high], goals);
                let ior = Span::at_least(ior, IOR_WIDTH_MIN, [1.0, EXACT_IOR]);
                demand.spans.push(("ior", ior.or_one(fits.own.is_flat())));
                demand
            };
            let want = material.wants.exact_fresnel.as_ref().zip(material.ior);
            let rough = want.filter(|_| material.roughness[1] >= least);
            let lobe = rough.map(|(want, ior)| own(FITS, material.roughness, ior, want.goals.clone()));
            let coat = material.coat.as_ref().map(|coat| {
                let [low, high] = coat.roughness;
                let goals = Goals { norms: coat.goals.norms.clone(), ..Goals::default() };
                own(OF_COATS, [low, high.max(least)], coat.ior, goals)
            });
            lobe.into_iter().chain(coat)
        };
        scene.materials.iter().enumerate().flat_map(demand).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        if scene.materials.iter().all(|m| m.kind != Kind::Dielectric) {
            return "no material is a dielectric".into();
        }
        self.unserved(scene).unwrap_or_else(|| {
            "no dielectric wants `exact_fresnel`; with Schlick's term it is of `reflection`".into()
        })
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let wants = |m: &&Material| m.kind == Kind::Dielectric && m.wants.exact_fresnel.is_some();
        let smooth: Vec<&Material> = scene.materials.iter().filter(wants).collect();
        about(&smooth, |m| {
            let (named, stay) = (named(m), verb(m, "stay"));
            format!("{named} {stay} below alpha {ALPHA_MIN}, where the lobe is near Fresnel's own term")
        })
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        value::expects(&[ValueFits { seconds: seconds(&FITS, scene), ..with(&wanted(scene)) }], jobs)
    }

    fn stages(&self, scene: &Scene, jobs: &[Job]) -> usize {
        jobs.len() + wanted(scene).len()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        let mut made = with(&wanted(context.scene)).bake(called, context)?;
        for call in &mut made.part.entries.calls {
            let material = context.scene.materials.iter().find(|material| material.name == call.of);
            if call.layer.is_some() || material.is_some_and(|own| own.exact_base().is_some()) {
                call.around.extend(clearcoat::taking(material));
                call.then = call.around.first().map(|around| around.function.clone());
            }
        }
        Ok(made)
    }
}
