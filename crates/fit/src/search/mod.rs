//! A search over forms: which formula of a given cost comes closest?
//!
//! A form is a quotient of sums of terms, c_k times powers of the inputs (and of helpers: 1 - x,
//! sqrt(x), 2^(-k x), 1 / (x + k y)), optionally anchored: 1 + P/Q with P = 0 where the value must
//! be exact, and optionally put into a function as a whole, as 2^(P/Q). For each form linear
//! programs give the smallest largest residual that it can have on the samples
//! ([`super::rational`]), and the operations of the formula as written its cost. Beginning with the
//! smallest forms, the best of every cost are changed by one step (a term added, dropped, moved, a
//! factor, a helper) until nothing new is found. What is left is the frontier: every form that no
//! cheaper or equal one beats. Which helpers and functions of the whole pay is tried beforehand
//! ([`scout`]). Where the space has a reciprocal, nested sums of connected monomials are searched
//! too (`nested`): from 12 operations on they are what the frontier of the furnace is made of.
//!
//! Deterministic for any number of threads.

mod beam;
mod draft;
mod finish;
mod form;
mod graph;
mod helper;
mod link;
mod nested;
mod pair;
mod pairing;
mod score;
mod scout;
mod space;
mod write;
mod writer;

pub use helper::Helper;
pub use link::Link;
pub use pair::{Pair, PairSamples, Second, search_pair};
pub use pairing::Pairing;
pub use scout::{Aid, Trial, scout};
pub use space::{Anchor, SearchAxis, SearchSamples, Space};

use crate::FitError;
use lobefit_shade::Hypothesis;

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Which of how many narrow searches of [`scout`] this is; none: a search itself.
    pub trial: Option<[usize; 2]>,
    /// Times that all costs were gone through before.
    pub sweep: usize,
    /// How often they will be, at most.
    pub sweeps: usize,
    /// Cost whose forms have been built upon.
    pub ops: u32,
    /// Highest cost, of forms on the way too.
    pub max_ops: u32,
    /// Forms tried so far.
    pub forms: u64,
    /// Smallest largest residual so far at this cost or below, on the samples that forms are ranked
    /// on.
    pub best: f64,
}

/// A form on the frontier.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The formula; its parameters start at the optimum, rounded to f32.
    pub hypothesis: Hypothesis,
    /// Its operations.
    pub ops: u32,
    /// Largest residual over the samples, in f64 with the coefficients as declared.
    pub max: f64,
    /// Root of the mean square residual over the samples.
    pub rms: f64,
    /// No other coefficients of this form have a smaller largest residual than this on the samples;
    /// 0 (nothing is proven) where the form has constants inside helpers.
    pub bound: f64,
}

/// Searches a space; the frontier by rising cost and falling error.
///
/// # Errors
/// A space or samples that do not make sense, with what is wrong; no form at all within the budget
/// ([`FitError::Solver`]).
pub fn search(
    space: &Space,
    samples: &SearchSamples,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    space.check(samples)?;
    let mut found = nested::found(space, samples, progress)?;
    let least = |ops: u32| found.iter().filter(|f| f.ops <= ops).map(|f| f.max).fold(f64::INFINITY, f64::min);
    let least: Vec<f64> = (0..=space.max_ops + BEYOND).map(least).collect();
    found.extend(solved(space, samples, &least, progress)?);
    for link in &space.links {
        let Some(space) = space.with(Aid::Link(*link)) else { continue };
        found.extend(solved(&space, samples, &[], progress)?);
    }
    finish::best(found, space, space.max_ops)
}

/// Operations beyond the budget that forms may have on their way, and the budget from which on they
/// have none: good forms are often found by taking something away from a dearer one. Of the factors
/// of the furnace, 13 operations reach 0.0218 without and 0.0198 with two more; from 16 on the
/// search is wide enough, and slow.
const BEYOND: u32 = 2;
const WIDE: u32 = 16;

/// The best forms of every cost, of those that are not far behind the least errors known by cost.
fn solved(
    space: &Space,
    samples: &SearchSamples,
    least: &[f64],
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    let ranked = samples.ranked();
    let reach = space.max_ops.max(WIDE.min(space.max_ops + BEYOND));
    let wide = Space { max_ops: reach, ..space.clone() };
    let levels = |ranked: &SearchSamples| {
        let mut levels = beam::Beam::new(&wide, score::Data::new(&wide, ranked), least).run(progress);
        levels.truncate(1 + space.max_ops as usize);
        levels
    };
    let Some(link) = space.link else {
        return finish::solved(space, samples, samples, levels(&ranked));
    };
    let (Some(ranked), Some(linked)) = (link.linked(&ranked), link.linked(samples)) else {
        return Ok(Vec::new());
    };
    finish::solved(space, &linked, samples, levels(&ranked))
}
