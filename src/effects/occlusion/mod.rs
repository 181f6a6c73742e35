//! The effect `occlusion`: lookups of binary sub-voxels, for occlusion culling by voxels that depth
//! was accumulated in. They are exact: no quantity is approximated.

use serde::Serialize;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Profile;
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::data::Cost;
use crate::emit::call::{Call, MaskLookup};
use crate::report::{Block, EffectFinding, Origin, Page, Section, words};
use crate::scene::{CULLING, Pass, Scene};
use lobefit_shade::code::{MASK_FUNCTIONS, MaskCost, MaskFunction, subvoxels};

/// The effect.
pub struct Occlusion;

/// What their error is, in words.
const METRIC: &str = "none: exact";

impl Effect for Occlusion {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "occlusion",
                lobe: |_| {
                    "Sub-voxel masks: bit x + 2 y + 4 z of a byte is the sub-voxel at (x, y, z) of a cell of 2 x 2 x 2".into()
                },
                notes: &[(
                    &["subvoxel_centroid"],
                    &[
                        "`subvoxel_centroid` is where to splat a voxel whose sub-voxels are not splatted one by one; `supervoxel_mask` makes",
                        "the mask of eight voxels, whose splat lies at its centroid. Logical operations, shifts, counts of bits, conversions: 1.",
                    ],
                )],
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let culling = scene.culling.iter().filter(|culling| culling.passes.contains(&Pass::Voxels));
        let demand = culling.map(|culling| Demand {
            job: "subvoxels".into(),
            name: CULLING.into(),
            field: CULLING.into(),
            because: format!(
                "culling: voxels are splatted ({} voxels)",
                culling.grid.map(|n| n.to_string()).join(" x ")
            ),
            ..Demand::default()
        });
        demand.collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        match scene.culling {
            Some(_) => "`voxels` is none of the passes of culling".into(),
            None => "the scene has no `culling`".into(),
        }
    }

    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let summary = |job: &Job| JobSummary {
            name: job.name.clone(),
            approximation: "lookups of sub-voxel masks, exact".into(),
            ranges: job.ranges.clone(),
            expected_error: Some(0.0),
            ..JobSummary::default()
        };
        jobs.iter().map(summary).collect()
    }

    fn report_seconds(&self, _: &Scene, _: &[Job]) -> f64 {
        0.0
    }

    fn functions(&self) -> Vec<String> {
        MASK_FUNCTIONS.map(|function| function.name.into()).to_vec()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        let mut made = Made::new(called, Some(0.0), METRIC);
        for function in &MASK_FUNCTIONS {
            let cost = cost(function)?;
            made.part.entries.masks.push(entry(function, cost));
            made.part.entries.calls.push(call(function, cost));
        }
        made.code(context, |language| Ok(subvoxels(language)))?;
        if context.reports(self.name()) {
            let finding = called.finding(Some(0.0), METRIC);
            let functions = made.part.entries.masks.clone();
            made.page(page(context.origin(), &functions), &Figures { effect: finding, functions })?;
        }
        Ok(made)
    }
}

/// The figures of the page.
#[derive(Serialize)]
struct Figures {
    effect: EffectFinding,
    functions: Vec<MaskLookup>,
}

fn cost(function: &MaskFunction) -> Result<Cost, BakeError> {
    let MaskCost { ops, fetches, bytes } = function.cost().map_err(|e| BakeError::Effect(Box::new(e)))?;
    Ok(Cost { ops, fetches, bytes })
}

fn entry(function: &MaskFunction, cost: Cost) -> MaskLookup {
    MaskLookup {
        effect: Occlusion.name().into(),
        function: function.name.into(),
        inputs: function.inputs.iter().map(ToString::to_string).collect(),
        gives: function.gives.into(),
        cost,
    }
}

/// What the culling calls, each for itself: which way to the centroid is cheaper, compiled code
/// says.
fn call(function: &MaskFunction, cost: Cost) -> Call {
    Call {
        effect: Occlusion.name().into(),
        of: CULLING.into(),
        purpose: function.name.into(),
        function: function.name.into(),
        name: function.name.into(),
        metric: METRIC.into(),
        cost,
        ..Call::default()
    }
}

fn page(origin: Origin, functions: &[MaskLookup]) -> Page {
    let columns = "function|gives|ops>|fetches>|bytes>";
    let row = |MaskLookup { function, inputs, gives, cost, .. }: &MaskLookup| {
        let call = format!("{function}({})", inputs.join(", "));
        vec![call, gives.clone(), cost.ops.to_string(), cost.fetches.to_string(), cost.bytes.to_string()]
    };
    let caption = "Errors are 0: the nearest floats of the exact means, where a division is rounded once. Compiled costs: docs/occlusion.md.";
    let table = words::table(columns, functions.iter().map(row).collect(), caption);
    let lead = "Bit b = x + 2 y + 4 z of a mask is the sub-voxel at (x, y, z), each 0 or 1, with its centre at 0.25 or 0.75 of the cell. Mask 0 \
                has no centroid: (-1, -1, -1) stands for it. Byte b of a super-voxel of 64 bits is the mask of the cell at (x, y, z) of the same order.";
    let section = Section::new("masks", "Masks", lead, vec![Block::Table(table)]);
    let conclusion = "Counting bits gives the centroid of a mask of sub-voxels without a table, exactly.";
    Page::new("lobefit: occlusion", origin, conclusion, vec![section])
}
