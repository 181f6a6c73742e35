//! The errors of both forms along the approach to each limit.

use serde::{Deserialize, Serialize};

use super::case::{self, CASES, Case};
use super::{ORACLE, naive};
use crate::study::StudyError;
use lobefit_shade::Hypothesis;

/// The truths of a case: rows of distance, inputs and truth for inputs in f64 and in f32.
#[derive(Deserialize)]
struct Truths {
    name: String,
    inputs: Vec<String>,
    f64: Vec<Vec<f64>>,
    f32: Vec<Vec<f64>>,
}

/// The errors of a form along an approach.
#[derive(Debug, Serialize)]
pub struct Approach {
    /// What is computed, and in which precision.
    pub form: &'static str,
    /// Distance from the limit, and relative error; `LOST` where the result is not finite.
    pub points: Vec<(f64, f64)>,
    /// The largest.
    pub worst: f64,
    /// Points at which the result is not finite.
    pub not_finite: usize,
}

/// A case and what was found of it.
#[derive(Debug, Serialize)]
pub struct Measured {
    /// Its name.
    pub name: &'static str,
    /// What is promised of ours.
    pub promise: f64,
    /// Half the distance of neighbours beside 1, in the precision of ours.
    pub rounding: f64,
    /// The naive form.
    pub naive: Vec<Approach>,
    /// Ours.
    pub ours: Approach,
}

/// Error of a result that is infinite or not a number.
pub const LOST: f64 = 1.0;

/// Units of rounding of f64 and f16.
const ROUNDING: [f64; 2] = [f64::EPSILON / 2.0, 1.0 / 2048.0];

/// All cases.
///
/// # Errors
/// A case without truths, a form that cannot be evaluated.
pub fn measured() -> Result<Vec<Measured>, StudyError> {
    let truths: Vec<Truths> = serde_json::from_str(ORACLE)?;
    let of = |case: &Case| {
        let found = truths.iter().find(|truths| truths.name == case.name);
        one(case, found.ok_or_else(|| StudyError::Unfitted { name: case.name.into() })?)
    };
    CASES.iter().map(of).collect()
}

fn one(case: &Case, truths: &Truths) -> Result<Measured, StudyError> {
    let names: Vec<&str> = truths.inputs.iter().map(String::as_str).collect();
    let (naive, rows, rounding) = match case.name {
        "half" => {
            let overflows = |x: &[f64]| case::in_half(case.naive, &names, x);
            (vec![approach("naive, f16", &truths.f32, overflows)?], &truths.f32, ROUNDING[1])
        }
        "sum" => {
            let running = |x: &[f64]| Ok(f64::from(naive::running(&case::weights(x[0] as u32))));
            (vec![approach("naive, f32", &truths.f32, running)?], &truths.f32, ROUNDING[0])
        }
        _ => {
            let form = Hypothesis::parse(case.name, case.naive)?;
            // The only parameter is pi.
            let pi = std::f64::consts::PI;
            let double = |x: &[f64]| case::evaluated(&form, &names, x, |x| x, |_| pi);
            let single =
                |x: &[f64]| Ok(f64::from(case::evaluated(&form, &names, x, |x| x as f32, |_| pi as f32)?));
            let both = vec![
                approach("naive, f32", &truths.f32, single)?,
                approach("naive, f64", &truths.f64, double)?,
            ];
            (both, &truths.f64, ROUNDING[0])
        }
    };
    let precision = if case.name == "half" { "ours, f16" } else { "ours, f64" };
    let ours = approach(precision, rows, case.value)?;
    Ok(Measured { name: case.name, promise: case.promise, rounding, naive, ours })
}

/// Errors at rows of the oracle.
fn approach(
    form: &'static str,
    rows: &[Vec<f64>],
    value: impl Fn(&[f64]) -> Result<f64, StudyError>,
) -> Result<Approach, StudyError> {
    let mut found = Approach { form, points: Vec::with_capacity(rows.len()), worst: 0.0, not_finite: 0 };
    for row in rows {
        let (Some((&distance, rest)), Some(&truth)) = (row.split_first(), row.last()) else { continue };
        let value = value(&rest[..rest.len() - 1])?;
        let error = if value.is_finite() { (value / truth - 1.0).abs() } else { LOST };
        found.not_finite += usize::from(!value.is_finite());
        found.worst = found.worst.max(error);
        found.points.push((distance, error));
    }
    Ok(found)
}
