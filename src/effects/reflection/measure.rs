//! A table measured as a shader sees it.

use rayon::prelude::*;

use super::{Field, Lookup, PointSet, Split, TRUTH_ERROR};
use crate::data::{Layout, Serves, Table};
use crate::effects::{Deviation, Rounding};

/// The errors of a table, told apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Bound on the error of the truths that the texels were made from and that the lookup is judged against.
    pub integration: f64,
    /// Rounding to the format, by channel.
    pub quantisation: Vec<Rounding>,
    /// Error of the bilinear lookup of the quantised texels in the table's use, f32 weights.
    pub lookup: Deviation,
    /// The same with weights of 8 fractional bits, as many texture units interpolate.
    pub lookup_8_bit: Deviation,
    /// Error of E alone.
    pub lookup_e: Deviation,
    /// Error of B alone, where the table holds it.
    pub lookup_b: Option<Deviation>,
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
        quantisation: Rounding::of(table, &quantised),
        lookup: over(&exact, use_of, points, truth),
        lookup_8_bit: over(&coarse, use_of, points, truth),
        lookup_e: over(&exact, Judged::E, points, truth),
        lookup_b: split.then(|| over(&exact, Judged::B, points, truth)),
        points: points.len(),
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

fn over(lookup: &Lookup, judged: Judged, points: &PointSet, truth: &Field) -> Deviation {
    let errors: Vec<f64> =
        (0..points.len()).into_par_iter().map(|i| signed(lookup, judged, points, truth, i)).collect();
    Deviation::of(&errors, &truth.e, |i| i < points.uniform, |worst| points.place(worst))
}
