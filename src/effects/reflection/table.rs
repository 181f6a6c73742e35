//! The table of E, or of E and B, that a shader looks up: `ggx-dfg`, `beckmann-dfg`.

use rayon::prelude::*;

use super::Reflection;
use super::demand::table_seconds;
use crate::approximate::Memo;
use crate::data::{Layout, Serves, Smith, Table};
use crate::effects::Albedo;
use crate::effects::table::{
    BuildError, Family, Further, LookupPoints, Made, Point, Region, Spec, TableJob, Truths, flat,
};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::{self, TRUTH_ERROR};

/// 2^17 uniform points, half as many in the layer mu ~ alpha, and the edges.
const LOG2_POINTS: u32 = 17;

impl Family for Reflection {
    fn prefix(&self, _: Layout) -> &'static str {
        self.tables[0]
    }

    fn role(&self, _: Layout, serves: Serves) -> &'static str {
        match serves {
            Serves::Albedo => self.tables[1],
            Serves::SplitSum => self.tables[2],
        }
    }

    fn layouts(&self) -> &'static [Layout] {
        &[Layout::Homogeneous, Layout::PlainSquared, Layout::Plain]
    }

    fn described(&self, job: &TableJob, _: Option<Side>) -> String {
        format!("for {}", job.want.serves.name())
    }

    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64 {
        table_seconds(i, jobs, self.price)
    }

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        Ok((build(self, spec, memo)?, Made { evaluations: 0, integration: TRUTH_ERROR }))
    }

    /// With B where a table that is judged in the same region holds it.
    fn finer(&self, job: &TableJob, jobs: &[TableJob]) -> bool {
        let same = |other: &&TableJob| other.smith == job.smith && other.region == job.region;
        jobs.iter().filter(same).any(|other| other.want.serves == Serves::SplitSum)
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
        let lobe = self.lobe;
        Ok(Truths {
            sides: vec![Albedo::of((lobe, smith), &points.inputs(), split, memo)?],
            made: Made { evaluations: 0, integration: TRUTH_ERROR },
            further: Further::new(move |_, points, memo| known((lobe, smith), points, split, memo)),
        })
    }
}

/// E, and B with `split`, from the patches of the region, however few the points.
fn known(
    (lobe, smith): (&dyn quantity::Reflection, Smith),
    points: &LookupPoints,
    split: bool,
    memo: &Memo,
) -> Result<Albedo, IntegrateError> {
    let patches = lobe.known(smith, split);
    let at = |point: &Point| patches.at(f64::from(point.alpha), f64::from(point.mu));
    let Some(both) = points.all.par_iter().map(at).collect::<Option<Vec<(f64, f64)>>>() else {
        return Albedo::of((lobe, smith), &points.inputs(), split, memo);
    };
    memo.add(both.len());
    let (e, b): (Vec<f64>, Vec<f64>) = both.into_iter().unzip();
    Ok(Albedo { e, b: if split { b } else { Vec::new() } })
}

/// The table before its texels are rounded to their format.
///
/// # Errors
/// A layout with slices; texels that are not finite.
pub fn build(of: &Reflection, spec: &Spec, memo: &Memo) -> Result<Vec<Table>, BuildError> {
    made(of, spec, flat::ROUNDS, memo)
}

/// The table as it is usually made: samples at the texels.
///
/// # Errors
/// As [`build`].
pub fn sampled(of: &Reflection, spec: &Spec, memo: &Memo) -> Result<Vec<Table>, BuildError> {
    made(of, spec, 0, memo)
}

fn made(of: &Reflection, spec: &Spec, rounds: usize, memo: &Memo) -> Result<Vec<Table>, BuildError> {
    memo.add(flat::samples(spec, rounds));
    let split_sum = spec.serves == Serves::SplitSum;
    let many = flat::per_cell(spec, rounds) > 1;
    let known = (many && split_sum).then(|| of.lobe.known(spec.smith, true));
    let at = |&(alpha, mu): &(f64, f64)| match known.and_then(|known| known.at(alpha, mu)) {
        Some(both) => both,
        None => of.lobe.texel(spec.smith, (alpha, mu), split_sum),
    };
    flat::build(of.lobe.name(), spec, rounds, &|places| {
        known.inspect(|known| known.cover(places));
        Ok(places.par_iter().map(at).collect())
    })
}
