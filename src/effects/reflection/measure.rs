//! A table measured as a shader sees it.

use rayon::prelude::*;

use super::{Field, Lookup, PointSet, Split, TRUTH_ERROR};
use crate::data::{Channel, Layout, Place, Serves, Table};

/// Error of a lookup over a point set.
#[derive(Clone, Debug, PartialEq)]
pub struct LookupError {
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

/// What rounding to the texel format does to one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounding {
    /// Channel.
    pub channel: String,
    /// Largest change of a texel.
    pub max: f64,
    /// Root mean square.
    pub rms: f64,
    /// Column and row of the largest.
    pub at: Place,
}

/// The errors of a table, told apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Bound on the error of the truths that the texels were made from and that the lookup is judged against.
    pub integration: f64,
    /// Rounding to the format, by channel.
    pub quantisation: Vec<Rounding>,
    /// Error of the bilinear lookup of the quantised texels in the table's use, f32 weights.
    pub lookup: LookupError,
    /// The same with weights of 8 fractional bits, as many texture units interpolate.
    pub lookup_8_bit: LookupError,
    /// Error of E alone.
    pub lookup_e: LookupError,
    /// Error of B alone, where the table holds it.
    pub lookup_b: Option<LookupError>,
    /// Number of points measured.
    pub points: usize,
}

/// Which value of a lookup is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judged {
    /// E.
    E,
    /// B.
    B,
    /// The larger error of the two, which bounds that of f0 A + B for every f0 in [0, 1] (a lerp of B and E).
    Either,
}

/// Measures a table against the truth at the points. The error of its use is |E - truth| for a table that serves the albedo,
/// else that of [`Judged::Either`].
pub fn measure(table: &Table, layout: Layout, serves: Serves, points: &PointSet, truth: &Field) -> Errors {
    let quantised = table.quantised();
    let exact = Lookup::new(&quantised, layout, serves);
    let coarse = exact.clone().with_weight_bits(8);
    let (split, use_of) = match serves {
        Serves::Albedo => (false, Judged::E),
        Serves::SplitSum => (true, Judged::Either),
    };
    Errors {
        integration: TRUTH_ERROR,
        quantisation: table
            .channels
            .iter()
            .zip(&quantised.channels)
            .map(|(a, b)| rounding(a, b, table))
            .collect(),
        lookup: over(&exact, use_of, points, truth),
        lookup_8_bit: over(&coarse, use_of, points, truth),
        lookup_e: over(&exact, Judged::E, points, truth),
        lookup_b: split.then(|| over(&exact, Judged::B, points, truth)),
        points: points.len(),
    }
}

fn rounding(exact: &Channel, stored: &Channel, table: &Table) -> Rounding {
    let gaps: Vec<f64> = exact.texels.iter().zip(&stored.texels).map(|(a, b)| (a - b).abs()).collect();
    let worst = (0..gaps.len()).fold(0, |worst, i| if gaps[i] > gaps[worst] { i } else { worst });
    let columns = table.axes[0].size;
    let place = [("column", worst % columns), ("row", worst / columns)];
    let squares: Vec<f64> = gaps.iter().map(|g| g * g).collect();
    Rounding {
        channel: exact.name.clone(),
        max: gaps.get(worst).copied().unwrap_or(0.0),
        rms: crate::math::sum::mean(&squares).sqrt(),
        at: place.into_iter().map(|(name, i)| (name.to_string(), i as f64)).collect(),
    }
}

/// Signed error at every point.
pub fn error_map(lookup: &Lookup, judged: Judged, points: &PointSet, truth: &Field) -> Vec<f64> {
    (0..points.len()).map(|i| signed(lookup, judged, points, truth, i)).collect()
}

/// Signed error at point `i`.
fn signed(lookup: &Lookup, judged: Judged, points: &PointSet, truth: &Field, i: usize) -> f64 {
    let Split { e, b } = lookup.at(points.roughness[i], points.alpha[i], points.mu[i]);
    let of_e = f64::from(e) - truth.e[i];
    if judged == Judged::E {
        return of_e;
    }
    let of_b = f64::from(b) - truth.b[i];
    if judged == Judged::B || of_b.abs() > of_e.abs() { of_b } else { of_e }
}

fn over(lookup: &Lookup, judged: Judged, points: &PointSet, truth: &Field) -> LookupError {
    let errors: Vec<f64> =
        (0..points.len()).into_par_iter().map(|i| signed(lookup, judged, points, truth, i)).collect();
    let (mut max, mut max_rel, mut worst) = (0.0, 0.0_f64, 0);
    for (i, error) in errors.iter().enumerate() {
        if error.abs() > max {
            (max, worst) = (error.abs(), i);
        }
        max_rel = max_rel.max(error.abs() / truth.e[i].abs());
    }
    let uniform = &errors[..points.uniform];
    let squares: Vec<f64> = uniform.iter().map(|e| e * e).collect();
    LookupError {
        max,
        max_rel,
        rms: crate::math::sum::mean(&squares).sqrt(),
        mean: crate::math::sum::mean(uniform),
        at: points.place(worst),
    }
}
