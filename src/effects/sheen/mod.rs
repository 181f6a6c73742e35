//! The effect `sheen`: the rim of cloth. Quantity `sheen-charlie`.

mod catalogue;

use std::collections::BTreeMap;

use super::context::Context;
use super::demand::{Demand, Goals, Job, Span};
use super::effect::Note;
use super::page::{self, Shown};
use super::who::{about, reasons, stay_smooth};
use super::{BakeError, Called, Effect, JobSummary, Made, code};
use crate::approximate::target::{Target, TargetSpec};
use crate::approximate::{self, Entry, FitSet, Region, Wanted};
use crate::data::Use;
use crate::scene::{Material, Scene};
pub use catalogue::{HYPOTHESES, RIVALS};
use lobefit_truth::integrate::sheen::albedo;
use lobefit_truth::quantity::{Quantity, SheenCharlie, Variant};

/// The effect.
pub struct Sheen;

/// Seconds of the truth of the fits on one core, and of one of them.
const TRUTH_S: f64 = 2.0;
const FIT_S: f64 = 0.15;

/// Roughness of the page's curves, as far as they lie in the region.
const CURVES: [f64; 5] = [0.1, 0.2, 0.3, 0.5, 1.0];

/// What to see in the map of the truth.
const CAPTION: &str = "E of the sheen's lobe: near 0 where a narrow lobe is seen face on, and largest at grazing view, where with its \
                       visibility term it returns more than it receives the narrower it is: a value above 1 is the model's own, no error \
                       of its integral.";

impl Effect for Sheen {
    fn name(&self) -> &'static str {
        "sheen"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let materials = scene.materials.iter().enumerate();
        materials.filter_map(|(i, material)| demand(scene, i, material)).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let sheens: Vec<&Material> = scene.materials.iter().filter(|m| m.sheen.is_some()).collect();
        let of = if sheens.len() == 1 { "the sheen of" } else { "the sheens of" };
        reasons([about(&sheens, |m| format!("no sheen is rough: {of} {}", stay_smooth(m)))])
            .unwrap_or_else(|| "no material has a sheen layer".into())
    }

    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let seconds = |job: &Job| TRUTH_S + (HYPOTHESES.len() * job.goals.norms.len()) as f64 * FIT_S;
        jobs.iter().map(|job| JobSummary::fits(job, "the sheen's albedo", seconds(job))).collect()
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        HYPOTHESES.iter().chain(&RIVALS).collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let suits = target.quantity.name() == SheenCharlie.name() && target.used_as == Use::Value;
        RIVALS.iter().filter(|_| suits).collect()
    }

    fn lobe(&self, scene: &Scene) -> String {
        format!("Charlie sheen lobe; alpha = {}", scene.alpha.name())
    }

    fn notes(&self) -> &'static [Note] {
        &[(
            &["charlie_"],
            &["`charlie_*` is E, the albedo of the sheen lobe, by which the layers below it are dimmed."],
        )]
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        let job = called.only_job()?;
        context.progress.stage("fits of the sheen");
        let region = job.region(context.scene.alpha)?;
        let FitSet { fits, dropped } = approximate::fit_all(&wanted(job, &region), &context.counter)?;
        context.progress.stage("report of sheen");
        let mut made = Made::new(called, page::smallest_error(&fits), "error of E of the best fit");
        made.promised(&job.promises, &fits, "sheen", Use::Value);
        made.code(|language| code::functions(language, &fits))?;
        let truth = |alpha, mu| Ok(albedo(alpha, mu));
        let shown = Shown { value: "E", caption: CAPTION, curves: &CURVES, truth };
        let findings = page::findings(&made.part.finding, context, &region, (&fits, &dropped), &shown)?;
        made.findings(&findings)?;
        made.fits(context, (fits, dropped), |_, _, entry| entry);
        Ok(made)
    }
}

fn demand(scene: &Scene, of: usize, material: &Material) -> Option<Demand> {
    let (sheen, name) = (material.sheen.as_ref()?, &material.name);
    let roughness = Span::roughness(material.sheen_range(scene.alpha)?, scene.alpha);
    let (kind, range) = (material.kind.name(), roughness.text());
    Some(Demand {
        job: "sheen".into(),
        rank: 0,
        of,
        item: 0,
        name: name.clone(),
        field: format!("materials[{of}].sheen"),
        because: format!("{name}: {kind} with a sheen layer (roughness {range})"),
        spans: BTreeMap::from([("roughness", roughness), ("mu", Span::new(scene.mu))]),
        goals: Goals { max_ops: sheen.max_ops, max_error: sheen.max_error, norms: sheen.norms.clone() },
    })
}

/// Fits of E(alpha, mu), and the published ones beside them where the map of roughness is theirs.
fn wanted<'a>(job: &'a Job, region: &Region) -> Wanted<'a> {
    let Region { roughness, mu, alpha_map } = *region;
    Wanted {
        spec: TargetSpec {
            quantity: &SheenCharlie,
            column: Some("E".into()),
            used_as: Some(Use::Value),
            variant: Variant::default(),
            alpha_map,
            domain: BTreeMap::from([("roughness".to_string(), roughness), ("mu".to_string(), mu)]),
        },
        own: &HYPOTHESES,
        user: &[],
        published: RIVALS.iter().collect(),
        norms: &job.goals.norms,
        max_ops: job.goals.max_ops,
        keeps: None,
        with_f0: None,
    }
}
