//! What a plan says of an effect: why the scene calls for it, its jobs, and what they should take.

use std::collections::BTreeSet;

use serde::Serialize;

use super::demand::{Budget, Demand, Job, Ranges, hull, merged};
use super::who::grouped;
use super::{BakeError, Effect};
use crate::approximate::{Emission, Formulas};
use crate::data::Pick;
use crate::report::{EffectFinding, words};
use crate::scene::Scene;
use lobefit_shade::Hypothesis;

/// One job of an effect, for people and scripts.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct JobSummary {
    /// Name of the table or of the family of fits.
    pub name: String,
    /// What it is, in words.
    pub approximation: String,
    /// What speaks against its goals being kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// Domain by input.
    pub ranges: Ranges,
    /// Bytes of texels; the most that there can be where `bytes_at_most`.
    pub bytes: u64,
    /// Whether the bake chooses the size.
    pub bytes_at_most: bool,
    /// The error that the scene allows; `None` where it sets no limit.
    pub expected_error: Option<f64>,
    /// What is recommended where the scene sets no limit and there is a choice.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recommended: Option<String>,
    /// Expected time on one core.
    pub seconds: f64,
    /// What became of goals that differ between materials.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub merging: Option<String>,
}

/// An effect that the scene calls for: the jobs, and their sum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Called {
    /// Its name.
    pub effect: &'static str,
    /// The materials or probes that call for it, and why: one sentence each.
    pub because: Vec<String>,
    /// The same for people: sentences that differ in names and ranges alone are one.
    #[serde(skip)]
    pub reasons: Vec<String>,
    /// Hull of the jobs' domains, by input.
    pub ranges: Ranges,
    /// The jobs' approximations in words.
    pub approximation: String,
    /// Bytes of texels of all jobs; the most that there can be where `bytes_at_most`.
    pub bytes: u64,
    /// Whether the bake chooses the size of a table.
    pub bytes_at_most: bool,
    /// The largest error that the scene allows any of the jobs; `None` where one of them has no
    /// limit.
    pub expected_error: Option<f64>,
    /// Expected time of all jobs and of their report on one core.
    pub seconds: f64,
    /// The jobs one by one.
    pub jobs: Vec<JobSummary>,
    /// The same as the bake takes them.
    #[serde(skip)]
    pub work: Vec<Job>,
    /// The effect itself.
    #[serde(skip)]
    pub by: &'static dyn Effect,
}

/// An effect that is left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    /// Its name.
    pub effect: &'static str,
    /// Why.
    pub reason: String,
}

impl JobSummary {
    /// The summary of a job of fits.
    pub fn fits(job: &Job, of: &str, seconds: f64) -> JobSummary {
        JobSummary {
            name: job.name.clone(),
            approximation: format!("fits of {of}, {}", job.goals.text()),
            ranges: job.ranges.clone(),
            expected_error: job.goals.max_error,
            recommended: job
                .goals
                .max_error
                .is_none()
                .then(|| Emission::rule_without_limit(job.goals.max_ops)),
            seconds,
            merging: job.merging(),
            ..JobSummary::default()
        }
    }

    /// The error that the scene allows, in words.
    pub fn limit(&self) -> String {
        match (self.expected_error, &self.recommended) {
            (Some(limit), _) => format!("error within {limit}"),
            (None, Some(rule)) => format!("no limit on the error: recommended is {rule}"),
            (None, None) => "no limit on the error".into(),
        }
    }

    /// Says where no formula is within the budget.
    pub fn doubting(mut self, job: &Job, own: Formulas) -> JobSummary {
        let Budget { max_ops, call } = job.budget();
        let costs =
            job.formulas(own).iter().filter_map(|entry| Hypothesis::parse(entry.file, entry.source).ok());
        let cheapest = costs.map(|formula| call.ops(formula.tape().cost_ops())).min();
        if let (Some(cheapest), Some(most)) = (cheapest, max_ops)
            && cheapest > most
        {
            self.doubt = Some(format!(
                "no formula has so few, and `bake` fails: the cheapest takes {}",
                words::operations(cheapest)
            ));
        }
        self
    }

    /// What it is, with the doubt.
    pub fn said(&self) -> String {
        let doubt = self.doubt.as_ref().map_or_else(String::new, |doubt| format!("; {doubt}"));
        format!("{}{doubt}", self.approximation)
    }
}

impl Called {
    /// An effect with the jobs that demands merge into; `None` where there is no demand.
    pub fn new(by: &'static dyn Effect, scene: &Scene, mut demands: Vec<Demand>) -> Option<Called> {
        let reasons = grouped(&demands);
        let mut seen = BTreeSet::new();
        let is_first: Vec<bool> = demands.iter().map(|demand| seen.insert(&demand.because)).collect();
        drop(seen);
        let all = demands.iter_mut().map(|demand| std::mem::take(&mut demand.because)).zip(is_first);
        let because: Vec<String> = all.filter_map(|(why, is_first)| is_first.then_some(why)).collect();
        let mut work = merged(demands);
        let is_one = scene.output.pick == Pick::Best;
        work.iter_mut().for_each(if is_one { Job::promise_once } else { Job::promise_each });
        if scene.output.every_error.is_some() {
            let set = work.iter_mut().flat_map(|job| &mut job.promises).flat_map(|promise| &mut promise.by);
            set.for_each(|(_, field)| *field = "--max-error".into());
        }
        if work.is_empty() {
            return None;
        }
        let jobs = by.expects(scene, &work);
        let mut ranges = Ranges::new();
        for (&input, &range) in jobs.iter().flat_map(|job| &job.ranges) {
            let all = ranges.entry(input).or_insert(range);
            *all = hull(*all, range);
        }
        Some(Called {
            effect: by.name(),
            because,
            reasons,
            ranges,
            approximation: jobs.iter().map(|j| j.approximation.as_str()).collect::<Vec<_>>().join("; "),
            bytes: jobs.iter().map(|j| j.bytes).sum(),
            bytes_at_most: jobs.iter().any(|j| j.bytes_at_most),
            expected_error: jobs.iter().try_fold(0.0_f64, |worst, j| j.expected_error.map(|e| worst.max(e))),
            seconds: jobs.iter().map(|j| j.seconds).sum::<f64>() + by.report_seconds(scene, &work),
            jobs,
            work,
            by,
        })
    }

    /// What its page and the manifest say of it, with the error that was measured and what error
    /// that is.
    pub fn finding(&self, measured_error: Option<f64>, metric: &str) -> EffectFinding {
        EffectFinding {
            effect: self.effect.into(),
            because: self.because.clone(),
            reasons: if self.reasons == self.because { Vec::new() } else { self.reasons.clone() },
            ranges: self.ranges.iter().map(|(name, range)| (name.to_string(), *range)).collect(),
            approximation: self.approximation.clone(),
            expected_error: self.expected_error,
            limit: self.limits(),
            measured_error,
            metric: metric.into(),
        }
    }

    /// The error that the scene allows its jobs: once where all have the same, else with their names.
    fn limits(&self) -> String {
        match &lobefit_math::groups(&self.jobs, |job| job.limit())[..] {
            [(limit, _)] => limit.clone(),
            groups => {
                let names = |jobs: &[&JobSummary]| {
                    jobs.iter().map(|job| job.name.as_str()).collect::<Vec<_>>().join(", ")
                };
                let named = groups.iter().map(|(limit, jobs)| format!("{}: {limit}", names(jobs)));
                named.collect::<Vec<_>>().join("; ")
            }
        }
    }

    /// Whether the scene limits the error or the cost of a job, so that its bake may not keep a promise.
    pub fn is_promised(&self) -> bool {
        let is_limited = |job: &JobSummary| job.expected_error.is_some();
        self.jobs.iter().any(is_limited) || self.work.iter().any(Job::is_promised)
    }

    /// Its only job.
    ///
    /// # Errors
    /// None or several: a defect of the effect.
    pub fn only_job(&self) -> Result<&Job, BakeError> {
        match self.work.as_slice() {
            [job] => Ok(job),
            jobs => {
                Err(BakeError::Internal(format!("{}: {} jobs where there is one", self.effect, jobs.len())))
            }
        }
    }
}
