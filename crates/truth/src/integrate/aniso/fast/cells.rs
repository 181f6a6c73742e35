//! Points in boxes over which E is smooth enough for one interpolant, and the points of them that
//! are checked.

use std::collections::BTreeSet;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::{Place, axes};
use crate::points::hull;
use lobefit_math::ops;

/// Ratio of neighbours, as a logarithm, from which on they lie in different cells: alpha = 1e-4
/// beside 1/64.
const APART: f64 = 1.5;

/// Points drawn at random for the check, and the seed of the draw.
const DRAWN: usize = 2000;
const SEED: u64 = 0x6c6f_6265_6669_7431;

/// The ranges of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ranges {
    pub mu: [f64; 2],
    /// ln of sqrt(alpha_x alpha_y).
    pub log_alpha: [f64; 2],
    /// Of the square of the anisotropy's variable, [`axes::lean`].
    pub square: [f64; 2],
}

/// How far beyond its ranges a box holds a point: the rounding of alpha_x and alpha_y.
const ROUNDING: f64 = 1e-9;

impl Ranges {
    /// Whether a box holds a point.
    pub(super) fn hold(&self, place: &Place) -> bool {
        let [log_alpha, _, square] = coordinates(place);
        let within = |x: f64, [low, high]: [f64; 2]| (low - ROUNDING..=high + ROUNDING).contains(&x);
        within(place.mu, self.mu) && within(log_alpha, self.log_alpha) && within(square, self.square)
    }
}

/// Points near each other in alpha and in mu.
pub(super) struct Cell {
    /// Their numbers: those of one alpha_x and alpha_y follow each other.
    pub points: Vec<usize>,
    pub ranges: Ranges,
}

/// ln(alpha), ln(mu) and the square of the anisotropy's variable.
fn coordinates(place: &Place) -> [f64; 3] {
    let lean = axes::lean((place.alpha[1] / place.alpha[0]).sqrt());
    [ops::log((place.alpha[0] * place.alpha[1]).sqrt()), ops::log(place.mu), lean * lean]
}

/// The values at which groups of neighbours begin.
fn starts(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let next = values.windows(2).filter(|pair| pair[1] - pair[0] > APART).map(|pair| pair[1]);
    values.first().copied().into_iter().chain(next).collect()
}

/// The cells of points, in an order that depends on the points alone.
pub(super) fn cells(places: &[Place]) -> Vec<Cell> {
    let at: Vec<[f64; 3]> = places.iter().map(coordinates).collect();
    let starts = [0, 1].map(|k| starts(at.iter().map(|x| x[k]).collect()));
    let group = |k: usize, i: usize| starts[k].partition_point(|start| *start <= at[i][k]);
    let mut order: Vec<usize> = (0..places.len()).collect();
    let bits = |i: usize| places[i].alpha.map(f64::to_bits);
    order.sort_by_cached_key(|i| (group(0, *i), group(1, *i), bits(*i), *i));
    let same = |a: &usize, b: &usize| (group(0, *a), group(1, *a)) == (group(0, *b), group(1, *b));
    order
        .chunk_by(same)
        .map(|points| Cell { points: points.to_vec(), ranges: ranges(places, &at, points) })
        .collect()
}

fn ranges(places: &[Place], at: &[[f64; 3]], points: &[usize]) -> Ranges {
    Ranges {
        mu: hull(points.iter().map(|i| places[*i].mu)),
        log_alpha: hull(points.iter().map(|i| at[*i][0])),
        square: hull(points.iter().map(|i| at[*i][2])),
    }
}

/// Numbers of the points that are checked: a random draw, and of each cell the points nearest to
/// the corners of its box.
pub(super) fn checked(places: &[Place], cells: &[Cell]) -> Vec<usize> {
    let mut out = BTreeSet::new();
    for Cell { points, ranges } in cells {
        let unit = |x: f64, [low, high]: [f64; 2]| if high > low { (x - low) / (high - low) } else { 0.0 };
        let within = |i: &usize| {
            let (place, [alpha, mu, square]) = (&places[*i], coordinates(&places[*i]));
            let cosine = place.phi.map_or(0.0, ops::cos);
            let mu = unit(mu, ranges.mu.map(ops::log));
            [unit(alpha, ranges.log_alpha), mu, unit(square, ranges.square), cosine * cosine]
        };
        let units: Vec<[f64; 4]> = points.iter().map(within).collect();
        for corner in 0..16_u32 {
            let signed = |(k, x): (usize, &f64)| if corner >> k & 1 == 1 { *x } else { -x };
            let far = |i: &usize| units[*i].iter().enumerate().map(signed).sum::<f64>();
            let nearest = (0..points.len()).max_by(|a, b| far(a).total_cmp(&far(b)));
            out.extend(nearest.map(|i| points[i]));
        }
    }
    let mut random = Pcg64::seed_from_u64(SEED);
    for _ in 0..DRAWN.min(places.len()) {
        out.insert((random.next_u64() % places.len() as u64) as usize);
    }
    out.into_iter().collect()
}
