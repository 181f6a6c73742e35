//! The proof of what texels are optimised for: samples of the lattice integrated directly.
//!
//! Targets lie between Chebyshev nodes of ln(alpha), where columns that move with alpha cross the
//! critical angles of glass: the interpolation errs most on a few lines of alpha. So samples are
//! drawn all over the lattice, and the lines of the worst of them are integrated at every row.

use std::collections::BTreeSet;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::{Node, TexelPlan};
use lobefit_fit::texels::Wanted;
use lobefit_truth::integrate::IntegrateError;

/// Lines of alpha that are integrated whole.
const LINES: usize = 24;

/// Seed of the draw.
const SEED: u64 = 0x6c61_7474_6963_6531;

/// What direct integrals showed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Checked {
    /// Samples integrated.
    pub samples: usize,
    /// Worst difference of a target from its integral.
    pub worst: f64,
    /// The point of it.
    pub at: Option<Node>,
    /// Integrand evaluations.
    pub evaluations: u64,
}

/// Compares the targets of tables that share a plan with direct integrals at a fixed sample of
/// those that count: `drawn` of the whole lattice, and the lines of the worst of them. What lies
/// between can be worse. `direct` gives the losses at points, a value for each table, and the
/// integrand evaluations that they took.
///
/// Errors: those of `direct`; a difference that is not a number.
pub fn check<const TABLES: usize>(
    quantity: &'static str,
    plan: &TexelPlan,
    drawn: usize,
    wanted: [&Wanted; TABLES],
    direct: impl Fn(&[Node]) -> Result<(Vec<[f64; TABLES]>, u64), IntegrateError>,
) -> Result<Checked, IntegrateError> {
    let [columns, rows, slices] = plan.samples();
    let index = |[column, row, slice]: [usize; 3]| (slice * rows + row) * columns + column;
    let counts = |at: &[usize; 3]| wanted.iter().any(|w| w.weights[index(*at)] > 0.0);
    let mut checked = Checked::default();
    let mut compare = |samples: Vec<[usize; 3]>| -> Result<Vec<(f64, [usize; 3])>, IntegrateError> {
        let nodes: Vec<Node> = samples.iter().map(|at| plan.sample(*at)).collect();
        let (losses, evaluations) = direct(&nodes)?;
        let mut found = Vec::with_capacity(samples.len());
        for ((at, node), losses) in samples.into_iter().zip(&nodes).zip(&losses) {
            let off = |(wanted, loss): (&&Wanted, &f64)| (wanted.targets[index(at)] - loss).abs();
            let mut difference = 0.0_f64;
            for one in wanted.iter().zip(losses).map(off) {
                if one.is_nan() {
                    return Err(IntegrateError::NotFinite { quantity, place: format!("{node:?}") });
                }
                difference = one.max(difference);
            }
            if difference > checked.worst {
                (checked.worst, checked.at) = (difference, Some(*node));
            }
            found.push((difference, at));
        }
        (checked.samples, checked.evaluations) =
            (checked.samples + nodes.len(), checked.evaluations + evaluations);
        Ok(found)
    };
    let mut random = Pcg64::seed_from_u64(SEED);
    let mut below = |n: usize| (random.next_u64() % n as u64) as usize;
    let drawn: BTreeSet<[usize; 3]> =
        (0..drawn).map(|_| [below(columns), below(rows), below(slices)]).collect();
    let mut found = compare(drawn.into_iter().filter(|at| counts(at)).collect())?;
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let lines: BTreeSet<[usize; 2]> =
        found.iter().take(LINES).map(|(_, [column, _, slice])| [*column, *slice]).collect();
    let whole = lines.into_iter().flat_map(|[column, slice]| (0..rows).map(move |row| [column, row, slice]));
    compare(whole.filter(|at| counts(at)).collect())?;
    Ok(checked)
}
