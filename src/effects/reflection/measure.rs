//! A table measured as a shader sees it.

use super::{Field, Lookup, PointSet, Split, TRUTH_ERROR};
use crate::data::{Layout, Place, Serves, Table};

/// Error of a lookup over a point set.
#[derive(Clone, Debug, PartialEq)]
pub struct LookupError {
    /// Largest absolute error, over all points.
    pub max: f64,
    /// Largest error relative to E.
    pub max_rel: f64,
    /// Root mean square over the uniform points.
    pub rms: f64,
    /// Signed mean over the uniform points (of E for a table that serves the albedo, else of the worse of E and B).
    pub mean: f64,
    /// Where the largest is.
    pub at: Place,
}

/// The errors of a table, told apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Bound on the error of the truths that the texels were made from.
    pub integration: f64,
    /// Largest change of a texel by rounding to its format.
    pub quantisation: f64,
    /// Error of the bilinear lookup of the quantised texels, f32 weights.
    pub lookup: LookupError,
    /// The same with weights of 8 fractional bits, as many texture units interpolate.
    pub lookup_8_bit: LookupError,
    /// Number of points measured.
    pub points: usize,
}

/// Measures a table against the truth at the points. Error: |E - truth| for a table that serves the albedo, else the larger of
/// the errors of E and B, which bounds that of f0 A + B for every f0 in [0, 1] (a lerp of B and E).
pub fn measure(table: &Table, layout: Layout, serves: Serves, points: &PointSet, truth: &Field) -> Errors {
    let quantised = table.quantised();
    let pairs = table.channels.iter().zip(&quantised.channels);
    let quantisation = pairs
        .flat_map(|(a, b)| a.texels.iter().zip(&b.texels))
        .fold(0.0_f64, |worst, (a, b)| (a - b).abs().max(worst));
    let exact = Lookup::new(&quantised, layout, serves);
    Errors {
        integration: TRUTH_ERROR,
        quantisation,
        lookup: over(&exact, serves, points, truth),
        lookup_8_bit: over(&exact.clone().with_weight_bits(8), serves, points, truth),
        points: points.len(),
    }
}

/// Signed error at every point: of E, or of the worse of E and B.
pub fn error_map(lookup: &Lookup, serves: Serves, points: &PointSet, truth: &Field) -> Vec<f64> {
    (0..points.len()).map(|i| signed(lookup, serves, points, truth, i).0).collect()
}

/// Signed error at point `i`, and E, which it is taken relative to (B itself falls to 1e-8 at normal incidence).
fn signed(lookup: &Lookup, serves: Serves, points: &PointSet, truth: &Field, i: usize) -> (f64, f64) {
    let Split { e, b } = lookup.at(points.roughness[i], points.alpha[i], points.mu[i]);
    let of_e = f64::from(e) - truth.e[i];
    if serves == Serves::Albedo {
        return (of_e, truth.e[i]);
    }
    let of_b = f64::from(b) - truth.b[i];
    if of_b.abs() > of_e.abs() { (of_b, truth.e[i]) } else { (of_e, truth.e[i]) }
}

fn over(lookup: &Lookup, serves: Serves, points: &PointSet, truth: &Field) -> LookupError {
    let (mut max, mut max_rel, mut worst) = (0.0, 0.0_f64, 0);
    let (mut squares, mut sum) = (Vec::with_capacity(points.uniform), Vec::with_capacity(points.uniform));
    for i in 0..points.len() {
        let (error, value) = signed(lookup, serves, points, truth, i);
        if error.abs() > max {
            (max, worst) = (error.abs(), i);
        }
        max_rel = max_rel.max(error.abs() / value.abs());
        if i < points.uniform {
            squares.push(error * error);
            sum.push(error);
        }
    }
    LookupError {
        max,
        max_rel,
        rms: crate::math::sum::mean(&squares).sqrt(),
        mean: crate::math::sum::mean(&sum),
        at: points.place(worst),
    }
}
