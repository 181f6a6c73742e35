//! An effect that is a family of tables with slices: all that is not its own.

use super::{BakedTable, Sliced, TableJob, bake, demands, findings, page, summaries};
use crate::data::Layout;
use crate::effects::context::Context;
use crate::effects::demand::{Demand, Job};
use crate::effects::{BakeError, Called, Effect, JobSummary, Made, Profile};
use crate::scene::Scene;

/// Seconds of the page of one of these effects on one core.
const REPORT_S: f64 = 0.3;

impl<F: Sliced> Effect for F {
    fn profile(&self) -> &Profile {
        Sliced::profile(self)
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        demands(self, scene)
    }

    fn left_out(&self, scene: &Scene) -> String {
        Sliced::left_out(self, scene)
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        Sliced::unserved(self, scene)
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        summaries(self, scene, jobs)
    }

    fn report_seconds(&self, scene: &Scene, jobs: &[Job]) -> f64 {
        REPORT_S + self.study_seconds(scene, jobs)
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        let jobs = TableJob::all(context.scene, &called.work)?;
        let (tables, broken) = bake::bake(self, &jobs, context)?;
        let metric = "lookup error of the worst table in a layout of ours";
        let mut made = Made::new(called, measured(&tables), metric);
        made.part.finding.expected_error = expected(&jobs);
        made.broken = broken;
        if !made.broken.is_empty() {
            return Ok(made);
        }
        made.tables(context, tables)?;
        if context.reports(called.effect) {
            let findings = findings::findings(self, &made.part, &made.tables, context)?;
            made.furnaces.extend(findings.furnaces.iter().map(|finding| finding.furnace.clone()));
            made.cautions.extend(findings.ways.iter().flat_map(|ways| ways.cautions()));
            made.beside.extend(findings.ways.iter().filter_map(|ways| ways.cheaper()));
            made.page(page::page(&findings)?, &findings)?;
        }
        Ok(made)
    }
}

/// The largest lookup error of a table in a layout of ours.
fn measured(tables: &[BakedTable]) -> Option<f64> {
    let own = tables.iter().filter(|t| t.layout != Layout::PathTracer);
    own.map(|t| t.errors.lookup.max).reduce(f64::max)
}

/// The largest error that the scene allows a table in a layout of ours; `None` where a table has no
/// limit.
fn expected(jobs: &[TableJob]) -> Option<f64> {
    let own: Vec<Option<f64>> = jobs
        .iter()
        .filter(|job| job.want.layout != Layout::PathTracer)
        .map(|job| job.want.max_error)
        .collect();
    let worst = own.iter().try_fold(0.0_f64, |worst, limit| limit.map(|e| worst.max(e)));
    worst.filter(|_| !own.is_empty())
}
