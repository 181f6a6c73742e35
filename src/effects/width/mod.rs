//! The effect `width`: the roughness to fetch a prefiltered environment map, or a blurred picture of
//! what lies behind, with, where a lobe is refracted. Quantity `refracted-width`.

use super::context::Context;
use super::demand::{Demand, Job, Span};
use super::effect::Note;
use super::value::{IOR_WIDTH_MIN, ValueFits};
use super::who::{about, reasons, rough, stay_smooth};
use super::{BakeError, Called, Effect, JobSummary, Made, ggx};
use crate::approximate::target::Target;
use crate::approximate::{Entry, own, published};
use crate::data::{AlphaMap, Use};
use crate::scene::limits::EXACT_IOR;
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::quantity::{Quantity, RefractedWidth};

/// The effect.
pub struct Width;

/// r'(roughness, mu, ior) with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 5] = own![
    "refracted_width_2",
    "refracted_width_4",
    "refracted_width_9",
    "refracted_width_11",
    "refracted_width_14"
];

/// What engines ship: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 2] = published![
    "refracted_width_none" by "no rule: the roughness of the surface",
    "refracted_width_khronos" by "Khronos glTF Sample Renderer, applyIorToRoughness; Bevy, three.js",
];

/// Least index of refraction of a job: the truth is quick from there.
const IOR_MIN: f64 = 1.05;

const FITS: ValueFits = ValueFits {
    quantity: &RefractedWidth,
    side: None,
    column: "roughness_refracted",
    own: &HYPOTHESES,
    published: &PUBLISHED,
    role: "refracted_roughness",
    of: "refraction",
    field: "wants.refracted_width",
    layer: None,
    because: "with a rough surface wants the width of what it refracts",
    caption: "The roughness of the prefiltered lobe that holds half of its energy within the cone that holds half of the refracted one.",
    curves: &[0.1, 0.2, 0.4, 0.7, 1.0],
    shown_at: &[("ior", 1.5)],
    seconds: [3.5, 0.4],
    table: None,
    around: None,
};

impl Effect for Width {
    fn name(&self) -> &'static str {
        "width"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material, range): (usize, &Material, [f64; 2])| {
            let (want, ior) = (material.wants.refracted_width.as_ref()?, material.ior?);
            let mut demand = FITS.demand(scene, of, range, want.goals.clone());
            let ior = ior.map(|ior| ior.max(IOR_MIN));
            demand.spans.push(("ior", Span::at_least(ior, IOR_WIDTH_MIN, [IOR_MIN, EXACT_IOR])));
            Some(demand)
        };
        // The roughness of a chain has alpha = roughness^2.
        rough(scene).filter(|_| scene.alpha == AlphaMap::RoughnessSquared).filter_map(demand).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let glass = scene.materials.iter().filter(|m| m.lobe() == Lobe::Glass);
        let (wanting, others): (Vec<&Material>, Vec<&Material>) =
            glass.partition(|m| m.wants.refracted_width.is_some());
        if wanting.is_empty() && others.is_empty() {
            return "no material transmits light".into();
        }
        if !wanting.is_empty() && scene.alpha != AlphaMap::RoughnessSquared {
            return "it is of chains with alpha = roughness^2, which the scene has not".into();
        }
        reasons([about(&wanting, stay_smooth)]).unwrap_or_else(|| "no glass wants `refracted_width`".into())
    }

    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        FITS.expects(jobs)
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        HYPOTHESES.iter().chain(&PUBLISHED).collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let suits = target.quantity.name() == RefractedWidth.name()
            && (target.column, target.used_as) == (FITS.column, Use::VALUE);
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
                "`refracted_roughness` is the roughness to fetch a prefiltered environment map (alpha = roughness^2), or a picture that is blurred",
                "as one, with, in the direction refract(-v, n, 1/ior), for glass seen from outside. Within the same cone lies half of the energy.",
                "The error is of the roughness itself. Pass an ior within the stated domain.",
            ],
        )]
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        FITS.bake(called, context)
    }
}
