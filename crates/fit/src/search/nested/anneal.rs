//! Walks by exchange of monomials, from good sums to better ones that no single exchange reaches:
//! simulated annealing of the logarithm of the largest residual.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::super::space::SLOTS;
use super::tree::{additions, nested};
use super::{Beam, ROUNDS, Sum};
use lobefit_math::ops;

/// Moves of a walk for every monomial.
const MOVES: usize = 140;

/// Rises of the logarithm that are taken with probability 1/e, at first and at last.
const HEAT: [f64; 2] = [0.12, 0.004];

/// Part of the moves that change k alone, and by how much at most: its logarithm.
const TUNING: f64 = 0.15;
const TUNED: f64 = 0.2;

/// Most monomials that a move exchanges.
const EXCHANGED: usize = 3;

/// Rounds of Lawson's that a move is judged by.
const FEW: usize = 4;

/// Monomials that may come last, of those that least squares rank.
const LAST: usize = 6;

impl Beam<'_> {
    /// The best sum on a walk from one, of as many monomials; none if the first is not solvable.
    pub(super) fn walk(&self, from: &Sum, seed: u64) -> Option<Sum> {
        let mut random = Pcg64::seed_from_u64(seed);
        let n = self.samples.len();
        let mut at = self.measured(&from.terms, from.k, &vec![1.0 / n as f64; n], ROUNDS[0])?;
        let mut best = at.clone();
        let moves = MOVES * at.terms.len();
        for step in 0..moves {
            let heat = HEAT[0] * ops::pow(HEAT[1] / HEAT[0], step as f64 / moves as f64);
            let Some(next) = self.moved(&at, &mut random) else { continue };
            let rise = ops::log(next.max / at.max);
            if rise <= 0.0 || random.random::<f64>() < ops::exp(-rise / heat) {
                at = next;
            }
            if at.max < best.max {
                best = at.clone();
            }
        }
        Some(best)
    }

    /// A neighbour: another k, or some monomials exchanged for others.
    fn moved(&self, at: &Sum, random: &mut Pcg64) -> Option<Sum> {
        if random.random::<f64>() < TUNING {
            let k = at.k * ops::exp(TUNED * random.random_range(-1.0..1.0));
            return self.measured(&at.terms, k, &at.weights, FEW);
        }
        let mut terms = at.terms.clone();
        // The coefficient of 1, which no step leads to, stays; it comes first.
        let first = usize::from(terms.first() == Some(&[0; SLOTS]));
        let count = random.random_range(1..=EXCHANGED.min(terms.len() - first).max(1));
        for _ in 0..count.min(terms.len() - first) {
            terms.remove(random.random_range(first..terms.len()));
        }
        for _ in 1..count {
            let near = additions(self.space, self.steps, &terms);
            terms.push(*near.get(random.random_range(0..near.len().max(1)))?);
        }
        // What is left over may hang together by the last monomial alone.
        let inverse = self.inverse(at.k);
        let frame = self.frame(&terms, &inverse, &at.weights)?;
        let whole = |term: &_| {
            let mut all = terms.clone();
            all.push(*term);
            nested(self.steps, &all).is_some()
        };
        let near: Vec<_> = additions(self.space, self.steps, &terms).into_iter().filter(whole).collect();
        let across = |term: &_| Some((*term, frame.across(self.column(&inverse, term))?));
        let (near, columns): (Vec<_>, Vec<_>) = near.iter().filter_map(across).unzip();
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let best = frame.best(&columns, (0..near.len()).map(|k| vec![k]).collect(), LAST);
        let last = best.get(random.random_range(0..best.len().max(1)))?[0];
        terms.push(near[last]);
        terms.sort_unstable();
        self.measured(&terms, at.k, &at.weights, FEW)
    }
}
