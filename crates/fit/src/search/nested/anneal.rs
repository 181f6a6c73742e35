//! Walks by exchange of monomials, from good sums to better ones that no single exchange reaches:
//! simulated annealing of the logarithm of the largest residual.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::super::form::Term;
use super::super::space::SLOTS;
use super::tree::{Monomials, additions, connecting};
use super::{Beam, ROUNDS, Sum};
use lobefit_math::ops;

/// Rises of the logarithm that are taken with probability 1/e, at first and at last.
const HEAT: [f64; 2] = [0.12, 0.004];

/// Part of the moves that change k alone, and by how much at most: its logarithm.
const TUNING: f64 = 0.15;
const TUNED: f64 = 0.2;

/// Most monomials that a move exchanges.
const EXCHANGED: usize = 3;

/// Rounds of Lawson's that a move is judged by.
const FEW: usize = 4;

/// A sum whose largest residual is so many times that of its neighbour is left after two rounds.
const HOPELESS: f64 = 1.7;

/// Monomials that one exchanged may give way to, of those that least squares rank.
const LAST: usize = 6;

impl Beam<'_> {
    /// The best sum on a walk from one, of as many monomials and so many moves for each; none if the
    /// first is not solvable.
    pub(super) fn walk(&self, from: &Sum, seed: u64, moves: usize) -> Option<Sum> {
        let mut random = Pcg64::seed_from_u64(seed);
        let n = self.samples.len();
        let mut at = self.measured(&from.terms, from.k, &vec![1.0 / n as f64; n], ROUNDS[0])?;
        let mut columns = self.monomials(at.k);
        let mut best = at.clone();
        let moves = moves * at.terms.len();
        for step in 0..moves {
            let heat = HEAT[0] * ops::pow(HEAT[1] / HEAT[0], step as f64 / moves as f64);
            let next = if random.random::<f64>() < TUNING {
                let k = at.k * ops::exp(TUNED * random.random_range(-1.0..1.0));
                self.measured(&at.terms, k, &at.weights, FEW)
            } else {
                self.exchanged(&at, &mut columns, &mut random)
            };
            let Some(next) = next else { continue };
            let rise = ops::log(next.max / at.max);
            if rise <= 0.0 || random.random::<f64>() < ops::exp(-rise / heat) {
                if next.k != at.k {
                    columns = self.monomials(next.k);
                }
                at = next;
            }
            if at.max < best.max {
                best = at.clone();
            }
        }
        Some(best)
    }

    /// A neighbour of the same k: some monomials exchanged for others.
    fn exchanged(&self, at: &Sum, columns: &mut Monomials, random: &mut Pcg64) -> Option<Sum> {
        let mut terms = at.terms.clone();
        // The coefficient of 1, which no step leads to, stays; it comes first.
        let first = usize::from(terms.first() == Some(&[0; SLOTS]));
        let count = random.random_range(1..=EXCHANGED.min(terms.len() - first).max(1));
        for _ in 0..count.min(terms.len() - first) {
            terms.remove(random.random_range(first..terms.len()));
        }
        columns.compute(&terms);
        let mut frame = self.frame(terms.iter().map(|term| columns.of(term).to_vec()), &at.weights)?;
        for left in (0..count).rev() {
            let mut near = additions(self.space, self.steps, &terms);
            if left == 0 {
                // What is left over may hang together by the last monomial alone.
                near = connecting(self.steps, &terms, near);
            }
            columns.compute(&near);
            let mut ranked: Vec<(f64, Term)> =
                near.into_iter().map(|term| (frame.gain(columns.of(&term)), term)).collect();
            ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
            ranked.truncate(LAST);
            let (_, term) = *ranked.get(random.random_range(0..ranked.len().max(1)))?;
            frame.push(columns.of(&term).to_vec())?;
            terms.push(term);
        }
        let level = frame.lawson(&[], FEW, HOPELESS * at.max)?;
        terms.sort_unstable();
        Some(Sum { terms, k: at.k, weights: level.weights, max: level.max })
    }
}
