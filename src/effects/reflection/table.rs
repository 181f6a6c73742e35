//! `ggx-dfg`: the table of E, or of E and B, that a shader looks up.

use rayon::prelude::*;

use super::demand::table_seconds;
use crate::approximate::Memo;
use crate::data::{Layout, Serves, Smith, Table};
use crate::effects::Albedo;
use crate::effects::table::{
    BuildError, Family, Further, LookupPoints, Made, Point, Region, Spec, TableJob, Truths, flat,
};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::reflection::{Effort, albedo, split};
use lobefit_truth::quantity::{GGX_REFLECTION, TRUTH_ERROR};

/// 2^17 uniform points, half as many in the layer mu ~ alpha, and the edges.
const LOG2_POINTS: u32 = 17;

/// The tables of this effect.
pub struct Dfg;

impl Family for Dfg {
    fn prefix(&self, _: Layout) -> &'static str {
        "ggx-dfg"
    }

    fn role(&self, _: Layout, serves: Serves) -> &'static str {
        match serves {
            Serves::Albedo => "ggx_albedo",
            Serves::SplitSum => "ggx_dfg",
        }
    }

    fn layouts(&self) -> &'static [Layout] {
        &[Layout::Homogeneous, Layout::PlainSquared, Layout::Plain]
    }

    fn described(&self, job: &TableJob, _: Option<Side>) -> String {
        format!("for {}", job.serves.name())
    }

    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64 {
        table_seconds(i, jobs)
    }

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        Ok((build(spec, memo)?, Made { evaluations: 0, integration: TRUTH_ERROR }))
    }

    /// With B where a table that is judged in the same region holds it.
    fn finer(&self, job: &TableJob, jobs: &[TableJob]) -> bool {
        let same = |other: &&TableJob| other.smith == job.smith && other.region() == job.region();
        jobs.iter().filter(same).any(|other| other.serves == Serves::SplitSum)
    }

    fn points(&self, region: &Region, _: bool) -> Result<LookupPoints, BuildError> {
        Ok(LookupPoints::certification(region, LOG2_POINTS))
    }

    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        split: bool,
        memo: &Memo,
    ) -> Result<Truths, IntegrateError> {
        Ok(Truths {
            sides: vec![Albedo::new(smith, &points.inputs(), split, memo)?],
            made: Made { evaluations: 0, integration: TRUTH_ERROR },
            further: Further::new(move |_, points, memo| known(smith, points, split, memo)),
        })
    }
}

/// E, and B with `split`, from the patches of the region, however few the points.
fn known(smith: Smith, points: &LookupPoints, split: bool, memo: &Memo) -> Result<Albedo, IntegrateError> {
    let patches = GGX_REFLECTION.interpolant(smith, split);
    let at = |point: &Point| patches.at(f64::from(point.alpha), f64::from(point.mu));
    let Some(both) = points.all.par_iter().map(at).collect::<Option<Vec<(f64, f64)>>>() else {
        return Albedo::new(smith, &points.inputs(), split, memo);
    };
    memo.add(both.len());
    let (e, b): (Vec<f64>, Vec<f64>) = both.into_iter().unzip();
    Ok(Albedo { e, b: if split { b } else { Vec::new() } })
}

/// The table before its texels are rounded to their format.
///
/// # Errors
/// A layout with slices; texels that are not finite.
pub fn build(spec: &Spec, memo: &Memo) -> Result<Vec<Table>, BuildError> {
    made(spec, flat::ROUNDS, memo)
}

/// The table as it is usually made: samples at the texels.
///
/// # Errors
/// As [`build`].
pub fn sampled(spec: &Spec, memo: &Memo) -> Result<Vec<Table>, BuildError> {
    made(spec, 0, memo)
}

fn made(spec: &Spec, rounds: usize, memo: &Memo) -> Result<Vec<Table>, BuildError> {
    memo.add(flat::samples(spec, rounds));
    let split_sum = spec.serves == Serves::SplitSum;
    let many = flat::per_cell(spec, rounds) > 1;
    let known = (many && split_sum).then(|| GGX_REFLECTION.interpolant(spec.smith, true));
    let effort = &Effort::ladder()[1];
    let at = |&(alpha, mu): &(f64, f64)| match known.and_then(|known| known.at(alpha, mu)) {
        Some(both) => both,
        None if split_sum => split(spec.smith, alpha, mu, effort),
        None => (albedo(spec.smith, alpha, mu, &effort.outer), 0.0),
    };
    flat::build("ggx-reflection", spec, rounds, &|places| {
        known.inspect(|known| known.cover(places));
        Ok(places.par_iter().map(at).collect())
    })
}
