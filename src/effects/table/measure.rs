//! A table measured as a shader sees it.

use rayon::prelude::*;

use super::{Lookup, LookupError, LookupPoints};
use crate::data::{Decode, Half, HalfError, HalfRefusal, Table, Values};
use crate::effects::{Albedo, Deviation, Rounding};
use lobefit_shade::{Precision, round_up};

/// The true values at the points where a lookup is judged, in their order.
#[derive(Clone, Copy, Debug)]
pub struct Truth<'a> {
    /// Directional albedo.
    pub e: &'a [f64],
    /// Schlick's bias; not read of a table without it.
    pub b: Option<&'a [f64]>,
}

impl<'a> Truth<'a> {
    /// E, and B where there is one.
    pub fn of(albedo: &'a Albedo) -> Truth<'a> {
        Truth { e: &albedo.e, b: (!albedo.b.is_empty()).then_some(&albedo.b[..]) }
    }
}

/// The errors of a table, by their causes.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Largest error known of the integrals that the texels were made from and that the lookup is
    /// judged against.
    pub integration: f64,
    /// Rounding to the format, by channel.
    pub quantisation: Vec<Rounding>,
    /// Error of the linear lookup of the quantised texels in the table's use, f32 weights: of E, or
    /// where the table has B that of [`Judged::Either`].
    pub lookup: Deviation,
    /// The same with weights of 8 fractional bits, as many texture units interpolate.
    pub lookup_8_bit: Deviation,
    /// The same with coordinates and decoding in f16 and f32 weights.
    pub half: Half,
    /// Error of E alone.
    pub lookup_e: Deviation,
    /// Error of B alone, where the table has it.
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
    /// The larger error of the two, which bounds that of f0 A + B for every f0 in [0, 1] (a lerp of
    /// B and E).
    Either,
}

/// Measures a table against the truth at the points.
///
/// # Errors
/// A table that the lookup cannot read; one with B where the truth has none.
pub fn measure(
    table: &Table,
    decode: Decode,
    points: &LookupPoints,
    truth: Truth,
    integration: f64,
) -> Result<Errors, LookupError> {
    let quantised = table.quantised();
    let exact = Lookup::new(&quantised, decode)?;
    let coarse = exact.clone().with_weight_bits(8);
    let looked_up = values(&exact, points);
    let over = |judged| -> Result<Deviation, LookupError> {
        Ok(deviation(&errors(&exact, &looked_up, judged, truth)?, points, truth))
    };
    let lookup_e = over(Judged::E)?;
    let has_b = decode.has_bias();
    let in_use = if has_b { Judged::Either } else { Judged::E };
    let lookup = if has_b { over(in_use)? } else { lookup_e.clone() };
    Ok(Errors {
        integration,
        quantisation: Rounding::of(table, &quantised),
        lookup,
        lookup_8_bit: deviation(&error_map(&coarse, in_use, points, truth)?, points, truth),
        half: half(&exact, in_use, points, truth)?,
        lookup_e,
        lookup_b: if has_b { Some(over(Judged::B)?) } else { None },
        points: points.len(),
    })
}

/// Signed error of a lookup at every point.
///
/// # Errors
/// B is judged, and the lookup or the truth has none.
pub fn error_map(
    lookup: &Lookup,
    judged: Judged,
    points: &LookupPoints,
    truth: Truth,
) -> Result<Vec<f64>, LookupError> {
    errors(lookup, &values(lookup, points), judged, truth)
}

/// What a lookup gives at every point.
fn values(lookup: &Lookup, points: &LookupPoints) -> Vec<Values> {
    points.all.par_iter().map(|point| lookup.at(point)).collect()
}

/// Signed error of each value.
fn errors(lookup: &Lookup, values: &[Values], judged: Judged, truth: Truth) -> Result<Vec<f64>, LookupError> {
    let no_bias = || LookupError::NoBias { table: lookup.table().into() };
    let at = |(i, Values { e, b }): (usize, &Values)| {
        let of_e = f64::from(*e) - truth.e[i];
        if judged == Judged::E {
            return Ok(of_e);
        }
        let (b, truth) = b.zip(truth.b).ok_or_else(no_bias)?;
        let of_b = f64::from(b) - truth[i];
        Ok(if judged == Judged::B || of_b.abs() > of_e.abs() { of_b } else { of_e })
    };
    values.iter().enumerate().map(at).collect()
}

/// The error of a lookup in half precision, by the worse of the two ways of rounding products, or the first
/// point where it has no finite value.
fn half(lookup: &Lookup, judged: Judged, points: &LookupPoints, truth: Truth) -> Result<Half, LookupError> {
    let of = |precision: Precision| -> Result<Half, LookupError> {
        let errors = error_map(&lookup.clone().with_precision(precision), judged, points, truth)?;
        let precision = precision.name().to_string();
        if let Some(i) = errors.iter().position(|error| !error.is_finite()) {
            let refused = format!("the lookup has no finite value in {precision}");
            return Ok(Half::Refused(HalfRefusal { refused, at: points.place(i) }));
        }
        let Deviation { max, rms, at, .. } = deviation(&errors, points, truth);
        Ok(Half::Measured(HalfError { max_abs: round_up(max, 4), rms, at, precision }))
    };
    Ok(of(Precision::F16)?.or_worse(of(Precision::F16Fused)?))
}

fn deviation(errors: &[f64], points: &LookupPoints, truth: Truth) -> Deviation {
    Deviation::of(errors, truth.e, |i| points.uniform[i], |worst| points.place(worst))
}
