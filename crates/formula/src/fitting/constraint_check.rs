//! Whether demands hold where the coefficients were not fitted to them: at the points of the
//! certificate, on finer lattices, and by proof.

use super::{Demand, FittingError};
use lobefit::approximate::target::{Sampled, Target};
use lobefit_fit::{Condition, Constraint, FitError, Held};
use lobefit_shade::{Domain, Hypothesis, RangeProof, Tape, prove_range};

/// A violation below this part of the values is that of f32's own rounding, a few units in the last
/// place of a value of 1.
const ROUNDING: f64 = 1e-6;

/// Points that one round adds to a constraint.
const ADDED: usize = 32;

/// How a constraint holds with the coefficients as emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstraintCheck {
    /// At all points that were looked at.
    pub held: Held,
    /// The inputs at the point of the largest violation: `alpha = 0.5, mu = 1`.
    pub at: String,
    /// Whether it is proven over the whole domain, by interval arithmetic. Only ranges can be.
    pub proven: bool,
}

impl ConstraintCheck {
    /// Whether nothing was found that rounding does not account for.
    pub fn is_kept(&self) -> bool {
        self.held.worst <= self.held.tolerance
    }
}

/// The constraints at more places than they are fitted at: a range at the points of the
/// certificate, a slope on a finer lattice; equations as they are.
pub(super) fn finer(
    constraints: &[Constraint],
    demands: &[Demand],
    target: &Target,
    formula: &Hypothesis,
    measured: &Sampled,
) -> Result<Vec<Constraint>, FittingError> {
    let (names, function) = (formula.inputs(), formula.name());
    let everywhere = || -> Result<Vec<Vec<f64>>, FitError> {
        let columns = measured.inputs(function, names)?;
        Ok(columns.into_iter().map(|c| c.into_iter().map(f64::from).collect()).collect())
    };
    let same = |values: &[f64]| values.first().map_or(Vec::new(), |v| vec![*v; measured.target.len()]);
    let one = |constraint: &Constraint| {
        let condition = match &constraint.condition {
            Condition::Equal { .. } => constraint.condition.clone(),
            Condition::AtLeast { values, .. } => {
                Condition::AtLeast { points: everywhere()?, values: same(values) }
            }
            Condition::AtMost { values, .. } => {
                Condition::AtMost { points: everywhere()?, values: same(values) }
            }
            Condition::Rising { .. } => {
                match demands.iter().find(|demand| demand.words() == constraint.name) {
                    Some(Demand::Rising(input)) => {
                        let (from, to) = target.fine_steps(names, function, "rising", input)?;
                        Condition::Rising { from, to }
                    }
                    Some(Demand::Falling(input)) => {
                        let (to, from) = target.fine_steps(names, function, "falling", input)?;
                        Condition::Rising { from, to }
                    }
                    _ => constraint.condition.clone(),
                }
            }
        };
        Ok(Constraint { name: constraint.name.clone(), condition })
    };
    constraints.iter().map(one).collect()
}

/// How the finer constraints hold; `held` tells how the ones hold that were fitted to, in the same
/// order.
pub(super) fn kept(
    finer: &[Constraint],
    held: &[Held],
    tape: &Tape,
    coefficients: &[f64],
    domain: &Domain,
) -> Result<Vec<ConstraintCheck>, FitError> {
    let one = |(constraint, held): (&Constraint, &Held)| {
        if matches!(constraint.condition, Condition::Equal { .. }) {
            let at = place(tape, constraint, held.at);
            return Ok(ConstraintCheck { held: held.clone(), at, proven: false });
        }
        let violations = violations(constraint, tape, coefficients)?;
        let (mut worst, mut at) = (0.0, 0);
        for (i, violation) in violations.iter().enumerate() {
            if *violation > worst {
                (worst, at) = (*violation, i);
            }
        }
        let size = match &constraint.condition {
            Condition::AtLeast { values, .. } | Condition::AtMost { values, .. } => {
                values.iter().fold(1.0_f64, |size, v| size.max(v.abs()))
            }
            _ => 1.0,
        };
        let mut all = Held {
            name: constraint.name.clone(),
            worst,
            tolerance: held.tolerance.max(ROUNDING * size),
            at,
            points: violations.len(),
        };
        let mut at = place(tape, constraint, at);
        let proof = proof(constraint, tape, coefficients, domain)?;
        if let Some((RangeProof::Violated { at: found, value }, bound)) = &proof
            && (value - bound).abs() > all.worst
        {
            (all.worst, at) = ((value - bound).abs(), found.clone());
        }
        let proven = matches!(proof, Some((RangeProof::Proven, _)));
        Ok(ConstraintCheck { held: all, at, proven })
    };
    finer.iter().zip(held).map(one).collect()
}

/// Whether equations hold within their tolerances with these coefficients.
pub(super) fn equations_hold(
    finer: &[Constraint],
    held: &[Held],
    tape: &Tape,
    coefficients: &[f64],
) -> Result<bool, FitError> {
    let equations = finer.iter().zip(held).filter(|(c, _)| matches!(c.condition, Condition::Equal { .. }));
    for (constraint, held) in equations {
        if violations(constraint, tape, coefficients)?.iter().any(|v| *v > held.tolerance) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The finer constraints' points of the largest violations, added to the constraints that are
/// fitted to. Whether there were any.
pub(super) fn add_broken(
    constraints: &mut [Constraint],
    finer: &[Constraint],
    kept: &[ConstraintCheck],
    tape: &Tape,
    coefficients: &[f64],
) -> Result<bool, FitError> {
    let mut any = false;
    for ((constraint, finer), kept) in constraints.iter_mut().zip(finer).zip(kept) {
        if kept.is_kept() || matches!(finer.condition, Condition::Equal { .. }) {
            continue;
        }
        let violations = violations(finer, tape, coefficients)?;
        let mut broken: Vec<usize> = (0..violations.len()).filter(|i| violations[*i] > 0.0).collect();
        broken.sort_by(|a, b| violations[*b].total_cmp(&violations[*a]));
        broken.truncate(ADDED);
        any |= !broken.is_empty();
        match (&mut constraint.condition, &finer.condition) {
            (Condition::AtLeast { points, values }, Condition::AtLeast { points: more, values: bounds })
            | (Condition::AtMost { points, values }, Condition::AtMost { points: more, values: bounds }) => {
                extend(points, more, &broken);
                values.extend(broken.iter().map(|i| bounds[*i]));
            }
            (Condition::Rising { from, to }, Condition::Rising { from: more, to: after }) => {
                extend(from, more, &broken);
                extend(to, after, &broken);
            }
            _ => {}
        }
    }
    Ok(any)
}

fn extend(columns: &mut [Vec<f64>], more: &[Vec<f64>], rows: &[usize]) {
    for (column, more) in columns.iter_mut().zip(more) {
        column.extend(rows.iter().map(|i| more[*i]));
    }
}

/// How far each point is from obeying, 0 where it does.
fn violations(constraint: &Constraint, tape: &Tape, coefficients: &[f64]) -> Result<Vec<f64>, FitError> {
    let finite = |points: &Vec<Vec<f64>>| -> Result<Vec<f64>, FitError> {
        let values = tape.evaluate(points, coefficients)?;
        match values.iter().position(|v| !v.is_finite()) {
            None => Ok(values),
            Some(index) => Err(FitError::Constrained {
                function: tape.function().into(),
                constraint: constraint.name.clone(),
                value: values[index],
                at: at(tape, points, index),
            }),
        }
    };
    let pairs = |low: Vec<f64>, high: &[f64]| -> Vec<f64> {
        low.iter().zip(high).map(|(low, high)| (low - high).max(0.0)).collect()
    };
    Ok(match &constraint.condition {
        Condition::Equal { points, values } => {
            finite(points)?.iter().zip(values).map(|(f, v)| (f - v).abs()).collect()
        }
        Condition::AtLeast { points, values } => pairs(values.clone(), &finite(points)?),
        Condition::AtMost { points, values } => pairs(finite(points)?, values),
        Condition::Rising { from, to } => pairs(finite(from)?, &finite(to)?),
    })
}

/// What interval arithmetic says of a range, and its end.
fn proof(
    constraint: &Constraint,
    tape: &Tape,
    coefficients: &[f64],
    domain: &Domain,
) -> Result<Option<(RangeProof, f64)>, FitError> {
    let (low, high, end) = match &constraint.condition {
        Condition::AtLeast { values, .. } => match values.first() {
            Some(low) => (*low, f64::INFINITY, *low),
            None => return Ok(None),
        },
        Condition::AtMost { values, .. } => match values.first() {
            Some(high) => (f64::NEG_INFINITY, *high, *high),
            None => return Ok(None),
        },
        _ => return Ok(None),
    };
    Ok(Some((prove_range(tape, coefficients, domain, low, high)?, end)))
}

fn place(tape: &Tape, constraint: &Constraint, index: usize) -> String {
    let points = match &constraint.condition {
        Condition::Equal { points, .. }
        | Condition::AtLeast { points, .. }
        | Condition::AtMost { points, .. } => points,
        Condition::Rising { from, .. } => from,
    };
    at(tape, points, index)
}

/// The inputs of a point: `alpha = 0.5, mu = 1`.
fn at(tape: &Tape, points: &[Vec<f64>], index: usize) -> String {
    let columns = tape.inputs().iter().zip(points);
    let at = columns.filter_map(|(name, x)| x.get(index).map(|x| format!("{name} = {}", *x as f32)));
    at.collect::<Vec<_>>().join(", ")
}
