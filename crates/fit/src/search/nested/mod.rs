//! A second space of forms: sums of connected monomials with one reciprocal, written as one nested
//! Horner tree.
//!
//! Every monomial is another one times a step: an argument, 1 / (x + k y), or a product of two
//! steps that is computed once. So each monomial costs one multiply-add, whatever its powers, where
//! a quotient of sums pays for two sums and a division. A beam keeps the best sums of every cost.
//! Sums grow by one monomial and by pairs, ranked first by what they take away of the weighted
//! squares; the best are measured by Lawson's rounds, with several k. Good sums need not have good
//! parts: one of 13 operations has 0.0113 of the furnace, and without its last monomial 0.066, where
//! others have 0.020. So from the best sums of every cost walks exchange some monomials for others
//! (`anneal`).

mod anneal;
mod frame;
mod tree;

use std::collections::BTreeSet;

use rayon::prelude::*;

use self::frame::{Frame, coefficients};
use self::tree::{Monomials, Steps, Terms, additions, text};
use super::draft::Draft;
use super::finish::finished;
use super::form::Term;
use super::helper::Helper;
use super::space::{SLOTS, SearchSamples, Space};
use super::{Found, Progress};
use crate::FitError;
use lobefit_math::ops;

/// Sums of a cost and of one set of products that are built upon, in a space of the usual width.
const WIDTH: usize = 50;

/// Sums of a cost that are measured, of those ranked.
const MEASURED: usize = 200;

/// Sums that a sum may grow into that are ranked by rounds, of those ranked by least squares.
const BEST: usize = 12;

/// Rounds of Lawson's with which sums are ranked, measured, and measured at their best k.
const FEW: usize = 3;
const ROUNDS: [usize; 2] = [10, 30];

/// Part of the weights that is spread evenly when a sum is measured: those of another sum are next
/// to 0 where that one had no error, and a weight of 0 stays.
const SHARE: f64 = 0.9;

/// Step of log2 k between sums of the same terms that are both built upon.
const BUCKET: f64 = 0.7;

/// Factors of k that are tried for the sums that are built upon.
const FACTORS: [f64; 4] = [1.12, 1.0 / 1.12, 1.35, 1.0 / 1.35];

/// The first k.
const FIRST: [f64; 3] = [0.7, 1.4, 2.8];

/// Walks from the best sums of a cost and a set of products; and the samples, of all and of the
/// edges, that walks see.
const WALKS: usize = 16;
const FEWER: [usize; 2] = [160, 120];

/// Sums of a cost, with whatever products, that walk on at last; and moves of a walk for every
/// monomial, at first and at last.
const ELITE: usize = 10;
const MOVES: usize = 140;
const LONG: usize = 1200;

/// Sums of each cost that are solved on all samples.
const FINALISTS: usize = 6;

/// A sum that has been measured.
#[derive(Clone)]
struct Sum {
    terms: Terms,
    k: f64,
    /// By sample, those under which least squares come close to the smallest largest residual.
    weights: Vec<f64>,
    max: f64,
}

/// The best sums of every cost, with every reciprocal of the space, solved and measured on all
/// samples.
pub(super) fn found(
    space: &Space,
    samples: &SearchSamples,
    progress: &dyn Fn(&Progress),
) -> Result<Vec<Found>, FitError> {
    let (ranked, few) = (samples.ranked(), samples.some(FEWER));
    let finalists = space.finalists(FINALISTS);
    let mut levels: Vec<Vec<(Steps, Sum)>> = vec![Vec::new(); 1 + space.max_ops as usize];
    let mut tried = 0;
    for steps in space.helpers.iter().filter_map(|helper| Steps::of(space, *helper)).flat_map(products) {
        let mut beam = Beam { space, steps: &steps, samples: &ranked, few: &few, tried: 0 };
        for (level, found) in levels.iter_mut().zip(beam.run(progress)) {
            level.extend(found.into_iter().take(finalists).map(|sum| (steps.clone(), sum)));
        }
        tried += beam.tried;
    }
    // The best of all reciprocals and products walk on, for longer.
    let sort = |level: &mut Vec<(Steps, Sum)>| level.sort_by(|a, b| better(&a.1, &b.1));
    for (ops, level) in levels.iter_mut().enumerate().filter(|(_, level)| !level.is_empty()) {
        sort(level);
        let elite = level[..level.len().min(space.widened(ELITE))].par_iter().enumerate();
        let walked = elite.filter_map(|(seed, (steps, sum))| {
            let beam = Beam { space, steps, samples: &ranked, few: &few, tried: 0 };
            Some((steps.clone(), beam.annealed(sum, seed as u64, LONG)?))
        });
        let walked: Vec<(Steps, Sum)> = walked.collect();
        level.extend(walked);
        sort(level);
        level.truncate(finalists);
        let (ops, max_ops, best) = (ops as u32, space.max_ops, level[0].1.max);
        progress(&Progress { trial: None, sweep: 0, sweeps: 1, ops, max_ops, forms: tried, best });
    }
    let finalists: Vec<(Steps, Sum)> = levels.into_iter().flatten().collect();
    let solved = finalists.par_iter().map(|(steps, sum)| solve(space, steps, sum, &ranked, samples));
    let solved: Vec<Option<Found>> = solved.collect::<Result<_, _>>()?;
    Ok(solved.into_iter().flatten().collect())
}

/// The sets of products that are tried: none, and one or two of the reciprocal r with the arguments
/// x and y of its sum: r x; r y; r y and r y x; r y and (r y)^2.
fn products(steps: Steps) -> Vec<Steps> {
    let last = steps.steps.len() - 1;
    let (Helper::Reciprocal { x, y, power } | Helper::RootReciprocal { x, y, power }) = steps.helper else {
        return vec![steps];
    };
    let place = |axis: u8, power: u8| {
        let mut term = [0; SLOTS];
        term[usize::from(axis)] = power;
        steps.place(&term)
    };
    let (Some(x), Some(y)) = (place(x, 1), place(y, power)) else { return vec![steps] };
    let first = steps.with([y, last]);
    vec![steps.with([x, last]), first.with([x, last + 1]), first.with([last + 1, last + 1]), first, steps]
}

fn better(a: &Sum, b: &Sum) -> std::cmp::Ordering {
    a.max.total_cmp(&b.max).then_with(|| a.terms.cmp(&b.terms))
}

/// A sum to be measured: grown from another by a term.
struct Grown<'a> {
    from: &'a Sum,
    terms: Terms,
    /// Largest residual after few rounds.
    max: f64,
}

struct Beam<'a> {
    space: &'a Space,
    steps: &'a Steps,
    samples: &'a SearchSamples,
    /// Those that walks see.
    few: &'a SearchSamples,
    tried: u64,
}

impl Beam<'_> {
    /// The best sums of every cost, by cost.
    fn run(&mut self, progress: &dyn Fn(&Progress)) -> Vec<Vec<Sum>> {
        let max_ops = self.space.max_ops;
        let mut levels = vec![Vec::new(); 1 + max_ops as usize];
        if self.steps.ops >= max_ops {
            return levels;
        }
        levels[self.steps.ops as usize] = self.seeds();
        for ops in self.steps.ops + 1..=max_ops {
            let mut seen = BTreeSet::new();
            let at = ops as usize;
            let mut level = self.grown(&levels[at - 1], 1, &mut seen);
            level.extend(self.grown(&levels[at - 2], 2, &mut seen));
            level.sort_by(better);
            level.truncate(self.space.widened(WIDTH));
            let walks = level[..level.len().min(self.space.widened(WALKS))].par_iter().enumerate();
            let walked = walks.filter_map(|(seed, sum)| self.annealed(sum, seed as u64, MOVES));
            let walked: Vec<Sum> = walked.collect();
            level.extend(walked);
            level.sort_by(better);
            let mut kept = BTreeSet::new();
            level.retain(|sum| kept.insert((sum.terms.clone(), bucket(sum.k))));
            level.truncate(self.space.widened(WIDTH));
            let best = level.first().map_or(f64::INFINITY, |sum| sum.max);
            progress(&Progress { trial: None, sweep: 0, sweeps: 1, ops, max_ops, forms: self.tried, best });
            levels[at] = level;
        }
        levels
    }

    /// The sums that all grow from: no term, or the coefficient of 1.
    fn seeds(&self) -> Vec<Sum> {
        let root = if self.space.anchor.is_some() { Vec::new() } else { vec![[0; SLOTS]] };
        let n = self.samples.len();
        let seed = |k: &f64| Sum { terms: root.clone(), k: *k, weights: vec![1.0 / n as f64; n], max: 0.0 };
        FIRST.iter().map(seed).collect()
    }

    /// The end of a walk from a sum, of so many moves for every monomial.
    fn annealed(&self, sum: &Sum, seed: u64, moves: usize) -> Option<Sum> {
        let few = Beam { samples: self.few, ..*self };
        let n = self.samples.len();
        let end = few.walk(sum, seed, moves)?;
        let sum = self.measured(&end.terms, end.k, &vec![1.0 / n as f64; n], ROUNDS[1])?;
        Some(self.tuned(sum))
    }

    /// The best sums of one or two terms more, but for those seen before.
    fn grown(&mut self, level: &[Sum], more: usize, seen: &mut BTreeSet<(Terms, i32)>) -> Vec<Sum> {
        let ranked: Vec<(Vec<Grown>, u64)> = level.par_iter().map(|sum| self.ranked(sum, more)).collect();
        self.tried += ranked.iter().map(|(_, tried)| tried).sum::<u64>();
        let mut candidates: Vec<Grown> = ranked.into_iter().flat_map(|(grown, _)| grown).collect();
        candidates.sort_by(|a, b| a.max.total_cmp(&b.max).then_with(|| a.terms.cmp(&b.terms)));
        candidates.retain(|grown| seen.insert((grown.terms.clone(), bucket(grown.from.k))));
        candidates.truncate(self.space.widened(MEASURED));
        let measured =
            |grown: &Grown| self.measured(&grown.terms, grown.from.k, &grown.from.weights, ROUNDS[0]);
        let mut sums: Vec<Sum> = candidates.par_iter().filter_map(measured).collect();
        sums.sort_by(better);
        sums.truncate(self.space.widened(WIDTH));
        let mut sums: Vec<Sum> = sums.into_par_iter().map(|sum| self.tuned(sum)).collect();
        sums.sort_by(better);
        sums
    }

    /// The sums of one or two terms more that a sum may grow into, the best by weighted least
    /// squares measured by a few rounds; and how many there were.
    fn ranked<'b>(&self, from: &'b Sum, more: usize) -> (Vec<Grown<'b>>, u64) {
        let mut columns = self.monomials(from.k);
        let Some(frame) = self.framed(&from.terms, &mut columns, &from.weights) else {
            return (Vec::new(), 0);
        };
        let near = additions(self.space, self.steps, &from.terms);
        let mut pool: Vec<(Term, Vec<f64>)> = Vec::new();
        let mut add = |term: Term| {
            if let Some(k) = pool.iter().position(|(own, _)| *own == term) {
                return Some(k);
            }
            columns.compute([&term]);
            pool.push((term, frame.across(columns.of(&term).to_vec())?));
            Some(pool.len() - 1)
        };
        let mut sets: Vec<Vec<usize>> = Vec::new();
        for term in &near {
            let Some(first) = add(*term) else { continue };
            if more == 1 {
                sets.push(vec![first]);
                continue;
            }
            let mut with = from.terms.clone();
            with.push(*term);
            // Each set once, whichever of the two comes first.
            let seconds = additions(self.space, self.steps, &with);
            let others = seconds.into_iter().filter(|other| !near.contains(other) || other < term);
            sets.extend(others.filter_map(&mut add).map(|second| vec![first, second]));
        }
        let tried = sets.len() as u64;
        let columns: Vec<&[f64]> = pool.iter().map(|(_, column)| column.as_slice()).collect();
        let best = frame.best(&columns, sets, BEST);
        let grown = |set: &Vec<usize>| {
            let others: Vec<&[f64]> = set.iter().map(|k| columns[*k]).collect();
            let max = frame.lawson(&others, FEW, f64::INFINITY)?.max;
            let mut terms: Terms = from.terms.iter().copied().chain(set.iter().map(|k| pool[*k].0)).collect();
            terms.sort_unstable();
            Some(Grown { from, terms, max })
        };
        (best.iter().filter_map(grown).collect(), tried)
    }

    fn measured(&self, terms: &Terms, k: f64, weights: &[f64], rounds: usize) -> Option<Sum> {
        let level =
            self.framed(terms, &mut self.monomials(k), weights)?.lawson(&[], rounds, f64::INFINITY)?;
        Some(Sum { terms: terms.clone(), k, weights: level.weights, max: level.max })
    }

    /// A sum with the best k about its own.
    fn tuned(&self, sum: Sum) -> Sum {
        let again = |k: f64| self.measured(&sum.terms, k, &sum.weights, ROUNDS[0]);
        let others: Vec<Sum> = FACTORS.iter().filter_map(|factor| again(sum.k * factor)).collect();
        let best = others.into_iter().fold(sum, |a, b| if b.max < a.max { b } else { a });
        let more = self.measured(&best.terms, best.k, &best.weights, ROUNDS[1]);
        more.filter(|more| more.max < best.max).unwrap_or(best)
    }

    fn monomials(&self, k: f64) -> Monomials<'_> {
        Monomials::new(self.samples, self.steps.helper.values(&self.samples.axes, k))
    }

    fn framed(&self, terms: &Terms, columns: &mut Monomials, weights: &[f64]) -> Option<Frame> {
        columns.compute(terms);
        self.frame(terms.iter().map(|term| columns.of(term).to_vec()), weights)
    }

    fn frame(&self, columns: impl IntoIterator<Item = Vec<f64>>, weights: &[f64]) -> Option<Frame> {
        let even = SHARE / weights.len() as f64;
        let weights: Vec<f64> = weights.iter().map(|w| (1.0 - SHARE) * w + even).collect();
        Frame::new(columns, &target(self.space, self.samples), &weights)
    }
}

/// What the coefficients' part of a sum should be.
fn target(space: &Space, samples: &SearchSamples) -> Vec<f64> {
    let base = space.base().map_or(0.0, f64::from);
    samples.target.iter().zip(&samples.scale).map(|(t, s)| t - base * s).collect()
}

/// A sum written, its coefficients and k polished on all samples; none if it has a pole there or in
/// the domain.
fn solve(
    space: &Space,
    steps: &Steps,
    sum: &Sum,
    ranked: &SearchSamples,
    samples: &SearchSamples,
) -> Result<Option<Found>, FitError> {
    if sum.terms.iter().all(|term| term[space.axes.len()] == 0) {
        // A polynomial, found cheaper elsewhere.
        return Ok(None);
    }
    let mut monomials = Monomials::new(ranked, steps.helper.values(&ranked.axes, sum.k));
    monomials.compute(&sum.terms);
    let columns: Vec<Vec<f64>> = sum.terms.iter().map(|term| monomials.of(term).to_vec()).collect();
    let Some(mut values) = coefficients(&columns, &target(space, ranked), &sum.weights) else {
        return Ok(None);
    };
    let Some(body) = text(space, steps, &sum.terms) else { return Ok(None) };
    values.push(sum.k);
    let roots = sum.terms.iter().filter(|term| **term == [0; SLOTS]).count();
    let ops = steps.ops + (sum.terms.len() - roots) as u32;
    let draft = Draft::nested(space, ops, (steps.helper, &body), values);
    let columns = |name: &str| super::finish::column(space, samples, name);
    finished(&draft, &columns, samples, space.domain.as_ref(), 0.0, true)
}

/// k by steps of a factor of about 1.6: sums of the same terms are kept apart by it, for a k that
/// suits few terms may not suit what grows of them.
fn bucket(k: f64) -> i32 {
    (ops::log2(k) / BUCKET).round() as i32
}
