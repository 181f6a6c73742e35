//! Proof that a formula has no pole in its domain.

use std::cmp::Ordering;

use super::tape::{BinaryOp, Interval, Node, Op, UnaryOp};
use super::{Domain, ShadeError, Tape};

/// Boxes examined before the proof is given up.
const BOXES: usize = 200_000;

/// A box whose sides are all below this part of the domain's is not divided further.
const SMALLEST: f64 = 1e-7;

/// Proves, by interval arithmetic on a subdivision of the domain, that in f32 no divisor is 0 or
/// flushed to it, no square root is of a negative number, no logarithm of one that is not positive,
/// no power of a negative base (or of 0 to an exponent that is not positive), and nothing
/// overflows. Branches that a condition excludes are not asked.
///
/// # Errors
/// [`ShadeError::Irregular`] with the sub-expression and a box where it could not be excluded: the
/// formula has a pole there, or comes too close to one to be shipped. Inputs that the domain does
/// not give, coefficients of the wrong number.
pub fn prove_regular(tape: &Tape, coefficients: &[f64], domain: &Domain) -> Result<(), ShadeError> {
    let expected = tape.parameters();
    if coefficients.len() != expected {
        let what = format!("{}: coefficients", tape.function());
        return Err(ShadeError::Shape { what, found: coefficients.len(), expected });
    }
    let whole: Vec<Interval> = domain.axes().iter().map(|a| Interval::new(a.lo, a.hi)).collect();
    let mut pending = vec![whole.clone()];
    let mut examined = 0;
    while let Some(region) = pending.pop() {
        examined += 1;
        let Some(danger) = examine(tape, coefficients, domain, &region)? else { continue };
        let middle: Vec<Interval> = region.iter().map(|x| Interval::point(middle(*x))).collect();
        if let Some(danger) = examine(tape, coefficients, domain, &middle)? {
            return Err(irregular(tape, domain, &middle, &danger));
        }
        let cone = cone(tape, danger.operand);
        let widths = |region: &[Interval]| -> Result<Widths, ShadeError> {
            let inputs = domain.intervals(tape.function(), tape.inputs(), region)?;
            let bounds = tape.bounds(&inputs, coefficients);
            let width = |node: usize| bounds[node].hi - bounds[node].lo;
            Ok((width(danger.operand as usize), cone.iter().map(|&node| width(node)).sum()))
        };
        match divide(&region, &whole, widths)? {
            Some((low, high)) if examined < BOXES => pending.extend([high, low]),
            _ => return Err(irregular(tape, domain, &region, &danger)),
        }
    }
    Ok(())
}

/// An operation that may go wrong.
struct Danger {
    node: Node,
    /// What must be bounded more tightly to exclude it: the divisor, the argument of the root, ...
    operand: Node,
    hazard: &'static str,
}

/// The first operation that may go wrong in a box, and how.
fn examine(
    tape: &Tape,
    coefficients: &[f64],
    domain: &Domain,
    region: &[Interval],
) -> Result<Option<Danger>, ShadeError> {
    let inputs = domain.intervals(tape.function(), tape.inputs(), region)?;
    let bounds = tape.bounds(&inputs, coefficients);
    let needed = tape.needed(&bounds);
    let mut nodes = (0..tape.ops().len()).filter(|&node| needed[node]);
    Ok(nodes.find_map(|node| {
        let (operand, hazard) = hazard(tape, node, &bounds)?;
        Some(Danger { node: node as Node, operand, hazard })
    }))
}

/// How an operation may go wrong, and the operand that decides it.
fn hazard(tape: &Tape, node: usize, bounds: &[Interval]) -> Option<(Node, &'static str)> {
    let of = |n: Node| bounds[n as usize];
    let tiny = f64::from(f32::MIN_POSITIVE);
    let wrong = match tape.ops()[node] {
        Op::Binary(BinaryOp::Divide, _, b) if of(b).may_vanish() => Some((b, "may divide by zero")),
        Op::Unary(UnaryOp::Sqrt, a) if of(a).lo < 0.0 => {
            Some((a, "may take the square root of a negative number"))
        }
        Op::Unary(UnaryOp::InverseSqrt, a) if of(a).lo < tiny => {
            Some((a, "may take the inverse square root of a number that is not positive"))
        }
        Op::Unary(UnaryOp::Log | UnaryOp::Log2, a) if of(a).lo < tiny => {
            Some((a, "may take the logarithm of a number that is not positive"))
        }
        Op::Binary(BinaryOp::Pow, a, _) if of(a).lo < 0.0 => {
            Some((a, "may raise a negative number to a power"))
        }
        Op::Binary(BinaryOp::Pow, a, b) if of(a).lo < tiny && of(b).lo <= 0.0 => {
            Some((a, "may raise zero to a power that is not positive"))
        }
        _ => None,
    };
    let endless = !(bounds[node].lo.is_finite() && bounds[node].hi.is_finite());
    wrong.or(endless.then_some((node as Node, "may overflow")))
}

pub(super) fn middle(x: Interval) -> f64 {
    f64::from((0.5 * (x.lo + x.hi)) as f32)
}

/// The operations that one is computed from, itself included.
pub(super) fn cone(tape: &Tape, node: Node) -> Vec<usize> {
    let mut inside = vec![false; tape.ops().len()];
    inside[node as usize] = true;
    for node in (0..=node as usize).rev() {
        if inside[node] {
            tape.ops()[node].operands().for_each(|n| inside[n as usize] = true);
        }
    }
    (0..inside.len()).filter(|&n| inside[n]).collect()
}

/// Width of the operand in danger, and the sum of the widths of all that it is computed from.
pub(super) type Widths = (f64, f64);

/// A box, halved.
pub(super) type Halves = (Vec<Interval>, Vec<Interval>);

/// The two halves of a box along the axis that bounds the operand in danger best; where that is
/// equal (the operand is clamped, or without bounds), along the one that bounds best what it is
/// computed from; then along the side that is longest against its distance from 0. None if the box
/// is as small as boxes get.
pub(super) fn divide(
    region: &[Interval],
    whole: &[Interval],
    widths: impl Fn(&[Interval]) -> Result<Widths, ShadeError>,
) -> Result<Option<Halves>, ShadeError> {
    let mut best: Option<([f64; 3], Halves)> = None;
    for axis in 0..region.len() {
        let (x, all) = (region[axis], whole[axis]);
        let side = x.hi - x.lo;
        let middle = middle(x);
        if middle <= x.lo || middle >= x.hi || side < SMALLEST * (all.hi - all.lo) {
            continue;
        }
        let (low, high) = halves(region, axis);
        let (left, right) = (widths(&low)?, widths(&high)?);
        let score = [left.0.max(right.0), left.1.max(right.1), -side / x.lo.abs().max(x.hi.abs())];
        if best.as_ref().is_none_or(|(known, _)| score.partial_cmp(known) == Some(Ordering::Less)) {
            best = Some((score, (low, high)));
        }
    }
    Ok(best.map(|(_, halves)| halves))
}

fn halves(region: &[Interval], axis: usize) -> Halves {
    let (mut low, mut high) = (region.to_vec(), region.to_vec());
    let middle = middle(region[axis]);
    low[axis].hi = middle;
    high[axis].lo = middle;
    (low, high)
}

/// A box in the formula's own inputs: `alpha = 0.1 .. 0.2, mu = 0.5`.
pub(super) fn describe(tape: &Tape, domain: &Domain, region: &[Interval]) -> Result<String, ShadeError> {
    let inputs = domain.intervals(tape.function(), tape.inputs(), region)?;
    let range = |(name, x): (&String, &Interval)| {
        if x.lo == x.hi {
            format!("{name} = {}", x.lo as f32)
        } else {
            format!("{name} = {} .. {}", x.lo as f32, x.hi as f32)
        }
    };
    let at: Vec<String> = tape.inputs().iter().zip(&inputs).map(range).collect();
    Ok(if at.is_empty() { "every point".to_string() } else { at.join(", ") })
}

fn irregular(tape: &Tape, domain: &Domain, region: &[Interval], danger: &Danger) -> ShadeError {
    let at = match describe(tape, domain, region) {
        Ok(at) => at,
        Err(error) => return error,
    };
    let place = Box::new(tape.place(danger.node).clone());
    ShadeError::Irregular { place, function: tape.function().to_string(), hazard: danger.hazard, at }
}
