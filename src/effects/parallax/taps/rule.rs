//! Where the fetches go, how wide they are and what they weigh.

use crate::math::ops;
use crate::optics::footprint::{RuleTap, Stretch};

/// A rule for a number of fetches: continuous in the stretch, and one fetch of the lobe itself where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapRule {
    count: usize,
}

/// kappa of the columns below.
const STRETCHES: [f64; 6] = [1.0, 1.06, 1.31, 1.74, 2.37, 3.86];

/// Tilts in units of alpha, and widths, of the outer fetches of 2 and 3.
type Columns = [[f64; 6]; 4];
const TWO: Columns = [
    [0.0, -0.45, -0.70, -0.83, -1.02, -1.17],
    [1.0, 0.83, 0.78, 0.77, 0.78, 0.78],
    [0.0, 0.45, 0.62, 0.61, 0.44, 0.22],
    [1.0, 1.08, 0.95, 0.94, 0.72, 0.64],
];
const THREE: Columns = [
    [0.0, -0.70, -1.05, -1.27, -1.31, -1.16],
    [1.0, 0.86, 0.85, 0.79, 0.73, 0.69],
    [0.0, 0.83, 0.98, 1.05, 1.17, 1.08],
    [1.0, 1.27, 1.05, 0.89, 0.81, 0.61],
];
const CENTRE: [f64; 6] = [1.0, 0.86, 0.69, 0.58, 0.51, 0.53];

impl TapRule {
    /// One fetch along the mirror ray.
    pub fn one() -> TapRule {
        TapRule { count: 1 }
    }

    /// Two fetches.
    pub fn two() -> TapRule {
        TapRule { count: 2 }
    }

    /// Three fetches.
    pub fn three() -> TapRule {
        TapRule { count: 3 }
    }

    /// How many fetches.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The fetches for a lobe of width `alpha` in [0, 1], from the one nearest to the shading point to the farthest.
    pub fn taps(&self, stretch: &Stretch, alpha: f64) -> Vec<RuleTap> {
        let kappa = stretch.kappa;
        // a probe in front of the wall: growth = tan psi = sqrt(kappa^2 - 1)
        let lean = stretch.growth / (kappa * kappa - 1.0).max(f64::MIN_POSITIVE).sqrt();
        let lean = lean.clamp(0.0, 1.0);
        let outer = |columns: &Columns| {
            let [c0, m0, c1, m1] = columns.map(|column| at(&column, kappa));
            let (c, shift) = (0.5 * (c1 - c0), 0.5 * (c1 + c0) * lean);
            let (m, more) = (0.5 * (m1 + m0), 0.5 * (m1 - m0) * lean);
            let weight = 1.0 / self.count as f64;
            [
                RuleTap { tilt: (shift - c) * alpha, width: m - more, weight },
                RuleTap { tilt: (shift + c) * alpha, width: m + more, weight },
            ]
        };
        match self.count {
            2 => outer(&TWO).to_vec(),
            3 => {
                let [near, far] = outer(&THREE);
                vec![near, RuleTap { tilt: 0.0, width: at(&CENTRE, kappa), weight: 1.0 / 3.0 }, far]
            }
            _ => vec![RuleTap { tilt: 0.0, width: 1.0, weight: 1.0 }],
        }
    }
}

fn at(column: &[f64; 6], kappa: f64) -> f64 {
    let x = ops::log(kappa.clamp(STRETCHES[0], STRETCHES[5]));
    let i = STRETCHES.partition_point(|s| ops::log(*s) <= x).clamp(1, 5);
    let (a, b) = (ops::log(STRETCHES[i - 1]), ops::log(STRETCHES[i]));
    column[i - 1] + (column[i] - column[i - 1]) * (x - a) / (b - a)
}
