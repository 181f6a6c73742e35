//! How far a stand-in is off: the figures that tables of all effects are measured in.

use crate::data::{Channel, Place, Table};
use lobefit_math::sum;

/// Error of a lookup over a point set.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// Largest absolute error, over all points.
    pub max: f64,
    /// Largest error relative to E (also where the error is B's, which falls to 1e-8 itself).
    pub max_rel: f64,
    /// Root mean square over the uniform points.
    pub rms: f64,
    /// Signed mean over the uniform points.
    pub mean: f64,
    /// Where the largest is.
    pub at: Place,
}

impl Deviation {
    /// Of signed errors at points; `truth` is E, by point; `uniform` tells which are uniform and
    /// `place` where a point is.
    pub fn of(
        errors: &[f64],
        truth: &[f64],
        uniform: impl Fn(usize) -> bool,
        place: impl Fn(usize) -> Place,
    ) -> Deviation {
        let (mut max, mut max_rel, mut worst) = (0.0, 0.0_f64, 0);
        for (i, error) in errors.iter().enumerate() {
            // An error that is no number is the largest there is.
            if error.is_nan() || error.abs() > max {
                (max, worst) = (error.abs(), i);
            }
            max_rel = max_rel.max(error.abs() / truth[i].abs());
            if max.is_nan() {
                break;
            }
        }
        let even: Vec<f64> = (0..errors.len()).filter(|i| uniform(*i)).map(|i| errors[i]).collect();
        let squares: Vec<f64> = even.iter().map(|e| e * e).collect();
        Deviation { max, max_rel, rms: sum::mean(&squares).sqrt(), mean: sum::mean(&even), at: place(worst) }
    }
}

/// What rounding to the texel format does to one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounding {
    /// Channel.
    pub channel: String,
    /// Largest change of a texel.
    pub max: f64,
    /// Root mean square.
    pub rms: f64,
    /// Column, row and slice of the largest, as far as there are axes.
    pub at: Place,
}

impl Rounding {
    /// Of every channel.
    pub fn of(exact: &Table, stored: &Table) -> Vec<Rounding> {
        let pairs = exact.channels.iter().zip(&stored.channels);
        pairs.map(|(a, b)| rounding(a, b, exact)).collect()
    }
}

fn rounding(exact: &Channel, stored: &Channel, table: &Table) -> Rounding {
    let gaps: Vec<f64> = exact.texels.iter().zip(&stored.texels).map(|(a, b)| (a - b).abs()).collect();
    let larger = |(worst, max), (i, gap): (usize, &f64)| if *gap > max { (i, *gap) } else { (worst, max) };
    let (worst, max) = gaps.iter().enumerate().fold((0, 0.0), larger);
    let place = ["column", "row", "slice"].into_iter().zip(table.place(worst));
    let squares: Vec<f64> = gaps.iter().map(|g| g * g).collect();
    Rounding {
        channel: exact.name.clone(),
        max,
        rms: sum::mean(&squares).sqrt(),
        at: place.map(|(name, i)| (name.to_string(), i as f64)).collect(),
    }
}
