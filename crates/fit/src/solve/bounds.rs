//! Constraints as rows g(p) >= 0 or g(p) = 0, with their derivatives.

use super::constraint::{Condition, Constraint};
use super::fitted::Held;
use super::objective::{Objective, Refused, columns};
use super::round_to_f32;
use super::samples::{Samples, digits};
use crate::FitError;
use lobefit_shade::Tape;

/// Rounding of a coefficient to f32 moves it by at most this part; twice, for what derivatives at
/// one point leave out.
const ROUNDING: f64 = 2.0 / 16_777_216.0;

/// Beyond rounding, solvers leave at most this part of max(|value|, 1).
const SOLVED: f64 = 1e-9;

/// One row: sign (f(at) - f(other) - value).
struct Row {
    constraint: usize,
    index: usize,
    at: usize,
    other: Option<usize>,
    sign: f64,
    value: f64,
    equal: bool,
}

/// Where constraints ask for the formula's value, as samples; its owner lends them to [`Bounds`].
pub(super) fn points(constraints: &[Constraint], inputs: usize) -> Samples {
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); inputs];
    let mut count = 0;
    for constraint in constraints {
        let (points, _) = constraint.condition.columns();
        let to = match &constraint.condition {
            Condition::Rising { to, .. } => Some(to.as_slice()),
            _ => None,
        };
        for points in std::iter::once(points).chain(to) {
            columns.iter_mut().zip(points).for_each(|(column, new)| column.extend(new));
            count += constraint.len();
        }
    }
    Samples { inputs: columns, scale: vec![1.0; count], target: vec![0.0; count] }
}

/// All constraints' rows on a formula.
pub(super) struct Bounds<'a> {
    constraints: &'a [Constraint],
    objective: Objective<'a>,
    rows: Vec<Row>,
    /// Units of residuals per unit of the formula's value, of each constraint.
    scales: Vec<f64>,
}

/// Rows at a set of coefficients.
pub(super) struct LinearBounds {
    /// g of each row, in units of residuals.
    pub values: Vec<f64>,
    /// Row by row, the same units.
    pub jacobian: Vec<f64>,
    pub equal: Vec<bool>,
}

impl<'a> Bounds<'a> {
    /// The rows of constraints, `points` being those of [`points`].
    pub fn new(
        constraints: &'a [Constraint],
        tape: &'a Tape,
        points: &'a Samples,
        scale: f64,
    ) -> Result<Bounds<'a>, FitError> {
        let (mut rows, mut start) = (Vec::new(), 0);
        for (constraint, Constraint { condition, .. }) in constraints.iter().enumerate() {
            let count = constraints[constraint].len();
            for index in 0..count {
                let at = start + index;
                let row = Row { constraint, index, at, other: None, sign: 1.0, value: 0.0, equal: false };
                rows.push(match condition {
                    Condition::Equal { values, .. } => Row { value: values[index], equal: true, ..row },
                    Condition::AtLeast { values, .. } => Row { value: values[index], ..row },
                    Condition::AtMost { values, .. } => Row { value: values[index], sign: -1.0, ..row },
                    Condition::Rising { .. } => Row { at: at + count, other: Some(at), ..row },
                });
            }
            start += if matches!(condition, Condition::Rising { .. }) { 2 * count } else { count };
        }
        let scales = vec![scale; constraints.len()];
        Ok(Bounds { constraints, objective: Objective::new(tape, points)?, rows, scales })
    }

    /// Brings each constraint's rows to the size of the formula's own gradients there, `norms`
    /// being the sizes of its columns: the differences of a monotone formula between near points
    /// are small, and would need large multipliers.
    ///
    /// Where p is refused at a constraint's point, nothing is known there and the rows stay as they
    /// are.
    pub fn balance(&mut self, p: &[f64], norms: &[f64]) {
        let (Ok(f), Ok(g)) = (self.objective.linearise(p), self.linearise(p)) else { return };
        let (f, g) = (f.jacobian, g.jacobian);
        let n = p.len();
        let size = |rows: &[f64]| {
            let sizes =
                rows.iter().enumerate().map(|(i, x)| if norms[i % n] > 0.0 { x / norms[i % n] } else { 0.0 });
            (sizes.map(|x| x * x).sum::<f64>() * n as f64 / rows.len().max(1) as f64).sqrt()
        };
        for (constraint, scale) in self.scales.iter_mut().enumerate() {
            let rows = (0..self.rows.len()).filter(|&i| self.rows[i].constraint == constraint);
            let (mut own, mut points) = (Vec::new(), Vec::new());
            for i in rows {
                let at = self.rows[i].at;
                own.extend_from_slice(&g[i * n..(i + 1) * n]);
                points.extend(f[at * n..(at + 1) * n].iter().map(|x| *scale * x));
            }
            let (own, points) = (size(&own), size(&points));
            if own > 0.0 && points > 0.0 {
                *scale *= points / own;
            }
        }
    }

    /// g of each row, in units of residuals.
    pub fn values(&self, p: &[f64]) -> Result<Vec<f64>, Refused> {
        let f = self.objective.residuals(p)?;
        Ok(self.rows.iter().map(|row| self.scales[row.constraint] * row.of(&f)).collect())
    }

    /// g and its derivatives.
    pub fn linearise(&self, p: &[f64]) -> Result<LinearBounds, Refused> {
        let linear = self.objective.linearise(p)?;
        let n = p.len();
        let gradient = |point: usize| &linear.jacobian[point * n..(point + 1) * n];
        let mut jacobian = Vec::with_capacity(self.rows.len() * n);
        for row in &self.rows {
            let factor = self.scales[row.constraint] * row.sign;
            match row.other {
                None => jacobian.extend(gradient(row.at).iter().map(|g| factor * g)),
                Some(other) => {
                    let pairs = gradient(row.at).iter().zip(gradient(other));
                    jacobian.extend(pairs.map(|(a, b)| factor * (a - b)));
                }
            }
        }
        let value = |row: &Row| self.scales[row.constraint] * row.of(&linear.residuals);
        let values = self.rows.iter().map(value).collect();
        Ok(LinearBounds { values, jacobian, equal: self.rows.iter().map(|row| row.equal).collect() })
    }

    /// The formula.
    pub fn tape(&self) -> &Tape {
        self.objective.tape
    }

    /// Where the formula's value is asked for.
    pub fn points(&self) -> &Samples {
        self.objective.samples
    }

    /// Each row's point, other point, sign, value, and whether it is an equation: sign
    /// (f(point) - f(other) - value) >= 0.
    pub fn asked(&self) -> impl Iterator<Item = (usize, Option<usize>, f64, f64, bool)> {
        self.rows.iter().map(|row| (row.at, row.other, row.sign, row.value, row.equal))
    }

    /// How each constraint holds once the coefficients are rounded to f32.
    ///
    /// # Errors
    /// Coefficients that are no f32, or at which the formula leaves the reals at a constraint's
    /// point.
    pub fn held(&self, p: &[f64]) -> Result<Vec<Held>, FitError> {
        let rounded: Vec<f64> = round_to_f32(p)?.into_iter().map(f64::from).collect();
        let refused = |_| super::route::refused(&self.objective, &rounded);
        let linear = self.linearise(&rounded).map_err(refused)?;
        let n = p.len();
        let fresh = |c: &Constraint| Held {
            name: c.name.clone(),
            worst: 0.0,
            tolerance: SOLVED,
            at: 0,
            points: c.len(),
        };
        let mut held: Vec<Held> = self.constraints.iter().map(fresh).collect();
        for (i, row) in self.rows.iter().enumerate() {
            let held = &mut held[row.constraint];
            let scale = self.scales[row.constraint];
            let violation = violation(linear.values[i], row.equal) / scale;
            if violation > held.worst {
                (held.worst, held.at) = (violation, row.index);
            }
            let gradient = &linear.jacobian[i * n..(i + 1) * n];
            let moved: f64 = gradient.iter().zip(&rounded).map(|(g, p)| (g * p).abs()).sum();
            let tolerance = ROUNDING * moved / scale + SOLVED * row.value.abs().max(1.0);
            held.tolerance = held.tolerance.max(tolerance);
        }
        Ok(held)
    }

    /// The error that no coefficients keep a constraint, given by its index and how it holds.
    pub fn unsatisfiable(&self, constraint: usize, held: &Held) -> FitError {
        let tape = self.objective.tape;
        let (points, _) = self.constraints[constraint].condition.columns();
        let columns = tape.inputs().iter().zip(points);
        let at: Vec<String> = columns.map(|(name, x)| format!("{name} = {}", digits(x[held.at]))).collect();
        FitError::Unsatisfiable {
            constraint: held.name.clone(),
            function: tape.function().to_string(),
            at: if at.is_empty() { "every point".to_string() } else { at.join(", ") },
            by: held.worst,
        }
    }
}

impl Row {
    fn of(&self, f: &[f64]) -> f64 {
        self.sign * (f[self.at] - self.other.map_or(0.0, |other| f[other]) - self.value)
    }
}

impl LinearBounds {
    /// In some of the parameters, the others fixed.
    pub fn only(&self, parameters: &[usize]) -> LinearBounds {
        let width = self.jacobian.len() / self.values.len().max(1);
        let jacobian = columns(&self.jacobian, width, parameters);
        LinearBounds { values: self.values.clone(), jacobian, equal: self.equal.clone() }
    }

    /// g + A d
    pub fn moved(&self, step: &[f64]) -> Vec<f64> {
        let rows = self.jacobian.chunks(step.len());
        let along = rows.map(|row| row.iter().zip(step).map(|(a, d)| a * d).sum::<f64>());
        self.values.iter().zip(along).map(|(g, along)| g + along).collect()
    }

    /// Largest violation of rows with these values.
    pub fn worst(&self, values: &[f64]) -> f64 {
        values.iter().zip(&self.equal).fold(0.0, |worst, (g, equal)| violation(*g, *equal).max(worst))
    }

    /// Whether a row is within `slack` of being violated.
    pub fn touches(&self, values: &[f64], slack: f64) -> bool {
        values.iter().zip(&self.equal).any(|(g, equal)| *equal || *g <= slack)
    }
}

/// How far a row is from being kept.
pub(super) fn violation(value: f64, equal: bool) -> f64 {
    if equal { value.abs() } else { (-value).max(0.0) }
}
