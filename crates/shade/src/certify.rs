//! The measured error of a formula in a shader's arithmetic, with its coefficients as emitted.

use std::ops::Range;

use rayon::prelude::*;

use super::tape::{BLOCK, Half, Node, Op, Real, Workspace};
use super::{ShadeError, Tape};
use lobefit_math::lanes;

/// Points whose squares are summed before they join the total: bounds the rounding error of a sum
/// of millions.
const RUN: usize = 4096;

/// 1 less some roundings.
const BELOW: f64 = 1.0 - 1e-15;

/// The arithmetic that a formula is measured in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Precision {
    /// f32, every operation rounded.
    #[default]
    F32,
    /// f32, products contracted into the additions that use them (see [`Tape::contracted`]).
    F32Fused,
    /// f16: inputs, coefficients and every operation rounded to half precision, subnormals kept.
    F16,
    /// f16, contracted.
    F16Fused,
}

impl Precision {
    /// All of them.
    pub const ALL: [Precision; 4] =
        [Precision::F32, Precision::F32Fused, Precision::F16, Precision::F16Fused];

    /// The word used in certificates and options: `f32`, `f32-fma`, `f16`, `f16-fma`.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F32Fused => "f32-fma",
            Precision::F16 => "f16",
            Precision::F16Fused => "f16-fma",
        }
    }

    /// Whether products are contracted.
    pub fn is_fused(self) -> bool {
        matches!(self, Precision::F32Fused | Precision::F16Fused)
    }

    /// Whether it is half precision.
    pub fn is_half(self) -> bool {
        matches!(self, Precision::F16 | Precision::F16Fused)
    }
}

/// Error of a formula over a set of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Largest |scale f - target|.
    pub max_abs: f64,
    /// Largest |scale f - target| / |target|, over the points where the target is not 0 to a
    /// shader: at least the smallest normal f32.
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

/// Measures `scale f - target` with f evaluated in f32 at f32 points (one column per input) and the
/// rest in f64; a formula without inputs has the same value at every point of the target.
///
/// The furnace error of a normalisation N has scale E and target 1; the error of a value scale 1
/// and target the truth. The result does not depend on the number of threads.
///
/// # Errors
/// No points; columns or coefficients of the wrong number or length; truth or result that is not
/// finite, with its index.
pub fn measure(
    tape: &Tape,
    coefficients: &[f32],
    inputs: &[Vec<f32>],
    scale: &[f64],
    target: &[f64],
) -> Result<Measured, ShadeError> {
    Ok(measure_first(tape, coefficients, inputs, scale, target, target.len())?.0)
}

/// [`measure`] over all points and over the `first` of them, from one evaluation: where the others
/// are there to find the largest error and would spoil a mean.
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
) -> Result<(Measured, Measured), ShadeError> {
    measure_in(tape, coefficients, inputs, scale, target, first, Precision::F32)
}

/// [`measure_first`] in another arithmetic; scale, target and the error itself are always f64.
///
/// In f16 the points are rounded to half precision first, so that the error is also that of the
/// input: what a shader sees that keeps its variables in f16.
///
/// # Errors
/// As [`measure_first`]; in f16 a coefficient, a literal or an input beyond 65504, which is
/// infinite there.
pub fn measure_in(
    tape: &Tape,
    coefficients: &[f32],
    inputs: &[Vec<f32>],
    scale: &[f64],
    target: &[f64],
    first: usize,
    precision: Precision,
) -> Result<(Measured, Measured), ShadeError> {
    let given = tape.check_shape(inputs, coefficients)?;
    // A formula without inputs has one value, whatever the number of points.
    let points = if inputs.is_empty() { target.len() } else { given };
    let shape = |what: &str, found, expected| ShadeError::Shape {
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
    let contracted = precision.is_fused().then(|| tape.contracted());
    let used = contracted.as_ref().unwrap_or(tape);
    let first = first.min(points);
    let sums = if precision.is_half() {
        let (inputs, coefficients) = halved(used, coefficients, inputs, precision)?;
        let values = Values { tape: used, inputs: &inputs, coefficients: &coefficients, wide: half_to_f64 };
        values.runs(scale, target, first)
    } else {
        let values = Values { tape: used, inputs, coefficients, wide: f64::from };
        values.runs(scale, target, first)
    };
    let (mut all, mut head) = (Sums::default(), Sums::default());
    for run in sums {
        let run = run.map_err(|fault| match fault {
            Fault::Value(index) => unmeasurable(tape, coefficients, inputs, index, precision),
            Fault::Column(name, index, value) => {
                let column = format!("{}: {name}", tape.function());
                ShadeError::NotFinite { column, index, value }
            }
        })?;
        all.join(&run);
        if all.points == first {
            head = all;
        }
    }
    Ok((all.measured(), head.measured()))
}

/// What is not finite: the formula at a point, or a column there with its value.
enum Fault {
    Value(usize),
    Column(&'static str, usize, f64),
}

/// A formula with what it is evaluated on.
struct Values<'a, R> {
    tape: &'a Tape,
    inputs: &'a [Vec<R>],
    coefficients: &'a [R],
    wide: fn(R) -> f64,
}

impl<R: Real + Send + Sync> Values<'_, R> {
    /// The errors of runs of points, in order; no run holds points on both sides of `first`.
    fn runs(&self, scale: &[f64], target: &[f64], first: usize) -> Vec<Result<Sums, Fault>> {
        let starts = (0..first).step_by(RUN).chain((first..target.len()).step_by(RUN));
        let starts: Vec<usize> = starts.collect();
        let end = |start: usize| (start + RUN).min(if start < first { first } else { target.len() });
        starts.par_iter().map(|start| self.run(*start..end(*start), scale, target)).collect()
    }

    fn run(&self, points: Range<usize>, scale: &[f64], target: &[f64]) -> Result<Sums, Fault> {
        let mut workspace = Workspace::new(self.tape);
        let mut errors = Vec::with_capacity(points.len());
        for start in points.clone().step_by(BLOCK) {
            let count = BLOCK.min(points.end - start);
            self.tape.forward(self.inputs, start, count, self.coefficients, &mut workspace);
            for (i, value) in (start..start + count).zip(workspace.result()) {
                let value = (self.wide)(*value);
                if !value.is_finite() {
                    return Err(Fault::Value(i));
                }
                for (column, x) in [("scale", scale[i]), ("target", target[i])] {
                    if !x.is_finite() {
                        return Err(Fault::Column(column, i, x));
                    }
                }
                errors.push(scale[i] * value - target[i]);
            }
        }
        Ok(Sums::of(&errors, &target[points.clone()], points.start))
    }
}

/// Inputs and coefficients in half precision.
fn halved(
    tape: &Tape,
    coefficients: &[f32],
    inputs: &[Vec<f32>],
    precision: Precision,
) -> Result<(Vec<Vec<Half>>, Vec<Half>), ShadeError> {
    let scale = "scale the formula";
    let half = |what: &str, numbers: &[f32], remedy| {
        to_half(numbers).map_err(|x| ShadeError::Unrepresentable {
            function: tape.function().to_string(),
            what: format!("{what}{x}"),
            precision,
            remedy,
        })
    };
    for (node, op) in (0..).zip(tape.ops()) {
        if let Op::Literal(x) = op {
            let place = tape.place(node);
            half(&format!("at {}:{}, the literal ", place.line, place.column), &[*x], scale)?;
        }
    }
    let coefficients = half("coefficient ", coefficients, scale)?;
    let columns = tape.inputs().iter().zip(inputs);
    let inputs = columns.map(|(name, column)| half(&format!("input {name} = "), column, "narrow the domain"));
    Ok((inputs.collect::<Result<_, ShadeError>>()?, coefficients))
}

/// Numbers rounded to half precision, or the first that is infinite there.
fn to_half(numbers: &[f32]) -> Result<Vec<Half>, f32> {
    let finite = |x: &f32| Half::nearest(*x).to_f32().is_finite();
    // Loops without a way out, which the compiler vectorises; the number is sought where there is one.
    let all = numbers.iter().fold(true, |all, x| all & finite(x));
    match numbers.iter().find(|x| !all && !finite(x)) {
        Some(x) => Err(*x),
        None => Ok(numbers.iter().map(|x| Half::nearest(*x)).collect()),
    }
}

fn half_to_f64(x: Half) -> f64 {
    x.to_f32().into()
}

/// Which part of a formula is not finite at a point, where its value is not.
fn unmeasurable(
    tape: &Tape,
    coefficients: &[f32],
    inputs: &[Vec<f32>],
    index: usize,
    precision: Precision,
) -> ShadeError {
    let contracted = precision.is_fused().then(|| tape.contracted());
    let tape = contracted.as_ref().unwrap_or(tape);
    let point: Vec<f32> = inputs.iter().map(|column| column[index]).collect();
    let (node, value) = if precision.is_half() {
        let half = |numbers: &[f32]| numbers.iter().map(|&x| Half::nearest(x)).collect::<Vec<_>>();
        first_not_finite(tape, &half(coefficients), &half(&point), half_to_f64)
    } else {
        first_not_finite(tape, coefficients, &point, f64::from)
    };
    let at = tape.inputs().iter().cloned().zip(point).collect();
    let place = Box::new(tape.place(node).clone());
    ShadeError::Unmeasurable { place, function: tape.function().to_string(), precision, value, at }
}

/// The first operation that is not finite at a point, or the last of all, with its value.
fn first_not_finite<R: Real>(
    tape: &Tape,
    coefficients: &[R],
    point: &[R],
    wide: impl Fn(R) -> f64,
) -> (Node, f64) {
    let mut values: Vec<R> = Vec::with_capacity(tape.ops().len());
    let mut found = (0, f64::NAN);
    for (node, op) in (0..).zip(tape.ops()) {
        let value = op.evaluate(point, coefficients, &values);
        found = (node, wide(value));
        if !found.1.is_finite() {
            break;
        }
        values.push(value);
    }
    found
}

/// What is known of the errors of some points.
#[derive(Clone, Copy, Default)]
struct Sums {
    max_abs: f64,
    max_rel: f64,
    worst: usize,
    squares: f64,
    total: f64,
    points: usize,
}

impl Sums {
    /// Of a run of points, the first of which has the index `start`.
    fn of(errors: &[f64], target: &[f64], start: usize) -> Sums {
        let mut sums = Sums { worst: start, points: errors.len(), ..Sums::default() };
        for (i, (error, target)) in errors.iter().zip(target).enumerate() {
            let (error, target) = (error.abs(), target.abs());
            if error > sums.max_abs {
                (sums.max_abs, sums.worst) = (error, start + i);
            }
            // The product spares a division wherever the ratio cannot be larger; its rounding is
            // made good by the margin.
            if error >= sums.max_rel * target * BELOW && target >= f64::from(f32::MIN_POSITIVE) {
                sums.max_rel = sums.max_rel.max(error / target);
            }
        }
        (sums.squares, sums.total) = (lanes::total(errors, |e| e * e), lanes::total(errors, |e| e));
        sums
    }

    /// Adds the points that follow.
    fn join(&mut self, next: &Sums) {
        if next.max_abs > self.max_abs {
            (self.max_abs, self.worst) = (next.max_abs, next.worst);
        }
        self.max_rel = self.max_rel.max(next.max_rel);
        self.squares += next.squares;
        self.total += next.total;
        self.points += next.points;
    }

    fn measured(&self) -> Measured {
        let count = self.points as f64;
        Measured {
            max_abs: self.max_abs,
            max_rel: self.max_rel,
            rms: (self.squares / count).sqrt(),
            mean: self.total / count,
            worst: self.worst,
            points: self.points,
        }
    }
}

/// The smallest number of `digits` significant decimal digits that is not below `x`: how a bound is
/// printed.
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
