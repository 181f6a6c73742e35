//! Proof that a formula's values stay within a range over its domain.

use super::regular::{cone, describe, divide, middle};
use super::tape::Interval;
use super::{Domain, ShadeError, Tape};

/// Boxes examined before the proof is given up.
const BOXES: usize = 50_000;

/// What interval arithmetic says of a range.
#[derive(Clone, Debug, PartialEq)]
pub enum RangeProof {
    /// Every f32 value over the domain lies in the range.
    Proven,
    /// At this point it does not, whatever the rounding.
    Violated {
        /// The point: `alpha = 0.5, mu = 1`.
        at: String,
        /// The value there.
        value: f64,
    },
    /// Neither could be shown: the formula touches an end of the range, or comes too close to one,
    /// in this box. That it holds at points that were tried is all there is to say.
    Open {
        /// The box: `alpha = 0.5 .. 0.50001, mu = ...`.
        at: String,
    },
}

/// Tries to prove, by interval arithmetic on a subdivision of the domain, that lo <= f <= hi for
/// every f32 value of f, the rounding of f32 included; either end may be infinite. A formula that
/// reaches an end exactly (1 at a mirror) is not proven there.
///
/// # Errors
/// Ends that are not numbers or in the wrong order; inputs that the domain does not give;
/// coefficients of the wrong number.
pub fn prove_range(
    tape: &Tape,
    coefficients: &[f64],
    domain: &Domain,
    lo: f64,
    hi: f64,
) -> Result<RangeProof, ShadeError> {
    let expected = tape.parameters();
    if coefficients.len() != expected {
        let what = format!("{}: coefficients", tape.function());
        return Err(ShadeError::Shape { what, found: coefficients.len(), expected });
    }
    if lo.is_nan() || hi.is_nan() || lo > hi {
        let message = format!("{lo} .. {hi} is not a range of values");
        return Err(ShadeError::Domain { input: format!("value of {}", tape.function()), message });
    }
    let bounds = |region: &[Interval]| -> Result<Vec<Interval>, ShadeError> {
        Ok(tape.bounds(&domain.intervals(tape.function(), tape.inputs(), region)?, coefficients))
    };
    let value = |region: &[Interval]| -> Result<Interval, ShadeError> {
        // A tape has at least its result.
        Ok(bounds(region)?[tape.ops().len() - 1])
    };
    let whole: Vec<Interval> = domain.axes().iter().map(|a| Interval::new(a.lo, a.hi)).collect();
    let result = tape.ops().len() - 1;
    let cone = cone(tape, result as u32);
    let mut pending = vec![whole.clone()];
    let mut examined = 0;
    while let Some(region) = pending.pop() {
        examined += 1;
        let found = value(&region)?;
        if lo <= found.lo && found.hi <= hi {
            continue;
        }
        let centre: Vec<Interval> = region.iter().map(|x| Interval::point(middle(*x))).collect();
        let there = value(&centre)?;
        if there.hi < lo || there.lo > hi {
            let value = 0.5 * (there.lo + there.hi);
            return Ok(RangeProof::Violated { at: describe(tape, domain, &centre)?, value });
        }
        let widths = |region: &[Interval]| -> Result<(f64, f64), ShadeError> {
            let bounds = bounds(region)?;
            let width = |node: usize| bounds[node].hi - bounds[node].lo;
            Ok((width(result), cone.iter().map(|&node| width(node)).sum()))
        };
        match divide(&region, &whole, widths)? {
            Some((low, high)) if examined < BOXES => pending.extend([high, low]),
            _ => return Ok(RangeProof::Open { at: describe(tape, domain, &region)? }),
        }
    }
    Ok(RangeProof::Proven)
}
