//! The effect `sheen`: the rim of cloth. Quantity `sheen-charlie`.

mod catalogue;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Note;
use super::value::ValueFits;
use super::who::{about, reasons, stay_smooth};
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::Entry;
use crate::approximate::target::Target;
use crate::data::Use;
use crate::scene::{Material, Scene};
pub use catalogue::{HYPOTHESES, PUBLISHED};
use lobefit_truth::quantity::{Quantity, SheenCharlie};

/// The effect.
pub struct Sheen;

const FITS: ValueFits = ValueFits {
    quantity: &SheenCharlie,
    column: "E",
    own: &HYPOTHESES,
    published: &PUBLISHED,
    role: "sheen_albedo",
    of: "sheen",
    field: "sheen",
    because: "with a sheen layer",
    caption: "E of the sheen's lobe: near 0 where a narrow lobe is seen face on, and largest at grazing view, where with its visibility \
              term it returns more than it receives the narrower it is: a value above 1 is the model's own, no error of its integral.",
    curves: &[0.1, 0.2, 0.3, 0.5, 1.0],
    seconds: [2.0, 0.15],
    table: None,
    around: None,
};

impl Effect for Sheen {
    fn name(&self) -> &'static str {
        "sheen"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material): (usize, &Material)| {
            let sheen = material.sheen.as_ref()?;
            let range = sheen.rough_range(scene.alpha)?;
            Some(FITS.demand(scene, of, range, sheen.goals.clone()))
        };
        scene.materials.iter().enumerate().filter_map(demand).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let sheens: Vec<&Material> = scene.materials.iter().filter(|m| m.sheen.is_some()).collect();
        let of = if sheens.len() == 1 { "the sheen of" } else { "the sheens of" };
        reasons([about(&sheens, |m| format!("no sheen is rough: {of} {}", stay_smooth(m)))])
            .unwrap_or_else(|| "no material has a sheen layer".into())
    }

    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        FITS.expects(jobs)
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        HYPOTHESES.iter().chain(&PUBLISHED).collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let suits = target.quantity.name() == SheenCharlie.name() && target.used_as == Use::VALUE;
        HYPOTHESES.iter().chain(&PUBLISHED).filter(|_| suits).collect()
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &["sheen_albedo"]
    }

    fn lobe(&self, scene: &Scene) -> String {
        format!("Charlie sheen lobe; alpha = {}", scene.alpha.name())
    }

    fn notes(&self) -> &'static [Note] {
        &[(
            &["sheen_albedo", "charlie_"],
            &["`sheen_albedo` is E of the sheen lobe, by which the layers below it are dimmed."],
        )]
    }

    fn is_explored(&self) -> bool {
        true
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        FITS.bake(called, context)
    }
}
