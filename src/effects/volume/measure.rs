//! A table of three axes measured as a shader sees it.

use rayon::prelude::*;

use super::{Lookup, LookupError, Points};
use crate::data::{Decode, Table};
use crate::effects::{Deviation, Rounding};

/// The errors of a table, told apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Worst difference from direct integrals found at a fixed sample: of what the texels are made from, or of the truths that the
    /// lookup is judged against, whichever is larger.
    pub integration: f64,
    /// Rounding to the format, by channel.
    pub quantisation: Vec<Rounding>,
    /// Error of the trilinear lookup of the quantised texels, f32 weights.
    pub lookup: Deviation,
    /// The same with weights of 8 fractional bits, as many texture units interpolate.
    pub lookup_8_bit: Deviation,
    /// Number of points measured.
    pub points: usize,
}

/// Measures a table against E at the points.
///
/// Errors: a table that the lookup cannot read.
pub fn measure(
    table: &Table,
    decode: Decode,
    points: &Points,
    truth: &[f64],
    integration: f64,
) -> Result<Errors, LookupError> {
    let quantised = table.quantised();
    let exact = Lookup::new(&quantised, decode)?;
    let coarse = exact.clone().with_weight_bits(8);
    Ok(Errors {
        integration,
        quantisation: Rounding::of(table, &quantised),
        lookup: deviation(&exact, points, truth),
        lookup_8_bit: deviation(&coarse, points, truth),
        points: points.len(),
    })
}

/// Signed error of a lookup at every point.
pub fn error_map(lookup: &Lookup, points: &Points, truth: &[f64]) -> Vec<f64> {
    points.all.par_iter().zip(truth).map(|(point, e)| f64::from(lookup.at(point)) - e).collect()
}

fn deviation(lookup: &Lookup, points: &Points, truth: &[f64]) -> Deviation {
    let errors = error_map(lookup, points, truth);
    Deviation::of(&errors, truth, |i| points.uniform[i], |worst| points.place(worst))
}
