//! The measured error of a formula in f32, with its coefficients as emitted.

use super::{FitError, Tape};

/// Points whose squares are summed before they join the total: bounds the rounding error of a sum of millions.
const RUN: usize = 4096;

/// Error of a formula over a set of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Largest |scale f - target|.
    pub max_abs: f64,
    /// Largest |scale f - target| / |target|, over the points where the target is not 0.
    pub max_rel: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// Signed mean.
    pub mean: f64,
    /// Index of the point where `max_abs` is attained, the first of equals.
    pub worst: usize,
    /// Number of points.
    pub points: usize,
}

/// Measures `scale f - target` with f evaluated in f32 at f32 points (one column per input) and the rest in f64.
///
/// The furnace error of a normalisation N has scale E and target 1; the error of a value scale 1 and target the
/// truth. The result does not depend on the number of threads.
///
/// # Errors
/// No points; columns or coefficients of the wrong number or length; truth or result that is not finite, with its
/// index.
pub fn measure(
    tape: &Tape,
    coefficients: &[f32],
    inputs: &[Vec<f32>],
    scale: &[f64],
    target: &[f64],
) -> Result<Measured, FitError> {
    Ok(measure_first(tape, coefficients, inputs, scale, target, target.len())?.0)
}

/// [`measure`] over all points and over the `first` of them, from one evaluation: where the others are there to find the
/// largest error and would spoil a mean.
///
/// # Errors
/// As [`measure`]; `first` is 0.
pub fn measure_first(
    tape: &Tape,
    coefficients: &[f32],
    inputs: &[Vec<f32>],
    scale: &[f64],
    target: &[f64],
    first: usize,
) -> Result<(Measured, Measured), FitError> {
    let points = tape.check_shape(inputs, coefficients)?;
    let shape = |what: &str, found, expected| FitError::Shape {
        what: format!("{}: {what}", tape.function()),
        found,
        expected,
    };
    if points == 0 || first == 0 {
        return Err(shape("points to measure at", 0, 1));
    }
    for (name, column) in [("scale", scale), ("target", target)] {
        if column.len() != points {
            return Err(shape(name, column.len(), points));
        }
    }
    let values = tape.evaluate(inputs, coefficients)?;
    let finite = |column: &str, index: usize, value: f64| {
        if value.is_finite() {
            return Ok(value);
        }
        let column = format!("{}: {column}", tape.function());
        Err(FitError::NotFinite { column, index, value })
    };
    let mut errors = Vec::with_capacity(points);
    for (i, value) in values.iter().enumerate() {
        let value = finite("value in f32", i, f64::from(*value))?;
        errors.push(finite("scale", i, scale[i])? * value - finite("target", i, target[i])?);
    }
    let first = first.min(points);
    Ok((summarise(&errors, target), summarise(&errors[..first], &target[..first])))
}

fn summarise(errors: &[f64], target: &[f64]) -> Measured {
    let (mut max_abs, mut max_rel, mut worst) = (0.0, 0.0_f64, 0);
    for (i, (error, target)) in errors.iter().zip(target).enumerate() {
        if error.abs() > max_abs {
            (max_abs, worst) = (error.abs(), i);
        }
        if *target != 0.0 {
            max_rel = max_rel.max(error.abs() / target.abs());
        }
    }
    let count = errors.len() as f64;
    let total = |f: &dyn Fn(&f64) -> f64| -> f64 {
        errors.chunks(RUN).map(|run| run.iter().map(f).sum::<f64>()).sum::<f64>() / count
    };
    Measured {
        max_abs,
        max_rel,
        rms: total(&|e| e * e).sqrt(),
        mean: total(&|e| *e),
        worst,
        points: errors.len(),
    }
}

/// The smallest number of `digits` significant decimal digits that is not below `x`: how a bound is printed.
///
/// Values that are not finite or not positive are returned as they are.
pub fn round_up(x: f64, digits: usize) -> f64 {
    let digits = digits.max(1);
    if !x.is_finite() || x <= 0.0 {
        return x;
    }
    let text = format!("{x:.*e}", digits - 1);
    let Some((mantissa, exponent)) = text.split_once('e') else { return x };
    let (Ok(rounded), Ok(exponent)) = (text.parse::<f64>(), exponent.parse::<i32>()) else { return x };
    if rounded >= x {
        return rounded;
    }
    let whole: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let Ok(whole) = whole.parse::<u64>() else { return x };
    let up = format!("{}e{}", whole + 1, exponent - (digits as i32 - 1));
    up.parse().unwrap_or(x)
}
