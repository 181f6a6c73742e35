//! The smallest largest residual of a form, by linear programs.

use super::form::{Form, Term};
use super::helper::multiply;
use super::space::{SearchSamples, Space};
use crate::rational::{Columns, Descent};

/// Samples with what every form needs of them.
pub(super) struct Data<'a> {
    samples: &'a SearchSamples,
    /// The anchor's value; 0 without one.
    anchor: f64,
    /// scale anchor - target, over the magnitude.
    offset: Vec<f64>,
    /// scale, over the magnitude.
    scale: Vec<f64>,
    magnitude: f64,
}

/// Best coefficients of a form: terms of Q (1 for a polynomial), then of P, up to a common factor.
#[derive(Clone, Debug)]
pub(super) struct Score {
    pub coefficients: Vec<f64>,
    pub max: f64,
}

impl<'a> Data<'a> {
    pub fn new(space: &'a Space, samples: &'a SearchSamples) -> Data<'a> {
        let largest = samples.target.iter().fold(0.0_f64, |top, t| top.max(t.abs()));
        let magnitude = if largest > 0.0 { largest } else { 1.0 };
        let anchor = space.base().map_or(0.0, f64::from);
        let pairs = samples.scale.iter().zip(&samples.target);
        Data {
            samples,
            anchor,
            offset: pairs.map(|(s, t)| (s * anchor - t) / magnitude).collect(),
            scale: samples.scale.iter().map(|s| s / magnitude).collect(),
            magnitude,
        }
    }

    /// The form's best coefficients, if their largest residual is below `cutoff`. `start`:
    /// coefficients of a form like it, by term.
    pub fn score(&self, form: &Form, start: Option<&Known>, cutoff: f64) -> Option<Score> {
        let columns = self.columns(form)?;
        let n = columns.unit.len();
        let scaled = |k: &Known| -> Vec<f64> {
            let own = k.of(form);
            own.iter().zip(&columns.unit).map(|(p, unit)| p * unit).collect()
        };
        let ones = || (0..n).map(|k| if k < form.under.len().max(1) { 1.0 } else { 0.0 }).collect();
        let mut descent =
            start.and_then(|k| Descent::at(&columns, scaled(k))).or_else(|| Descent::at(&columns, ones()))?;
        if cutoff.is_finite() && !descent.falls_below(cutoff / self.magnitude) {
            return None;
        }
        descent.run().ok()?;
        let (x, level) = descent.reached();
        let coefficients = x.iter().zip(&columns.unit).map(|(x, unit)| x / unit).collect();
        Some(Score { coefficients, max: level * self.magnitude })
    }

    /// The form's best coefficients from known ones, and what no others can be below.
    pub fn prove(&self, form: &Form, known: &Known) -> Option<(Score, f64)> {
        let columns = self.columns(form)?;
        let start = known.of(form).iter().zip(&columns.unit).map(|(p, unit)| p * unit).collect();
        let mut descent = Descent::at(&columns, start)?;
        descent.run().ok()?;
        let bound = descent.prove().ok()?.bound;
        let (x, level) = descent.reached();
        let coefficients = x.iter().zip(&columns.unit).map(|(x, unit)| x / unit).collect();
        Some((Score { coefficients, max: level * self.magnitude }, bound))
    }

    /// A form's values at the samples. None where they are not finite.
    pub fn values(&self, form: &Form, score: &Score) -> Option<Vec<f64>> {
        let helpers = self.helpers(form)?;
        let below = form.under.len().max(1);
        let (under, over) = score.coefficients.split_at(below);
        let sum = |terms: &[Term], coefficients: &[f64]| {
            let mut sum = vec![0.0; self.samples.len()];
            for (term, c) in terms.iter().zip(coefficients) {
                let column = self.product(term, &helpers);
                sum.iter_mut().zip(column).for_each(|(s, x)| *s += c * x);
            }
            sum
        };
        let over = sum(&form.over, over);
        let under = if form.under.is_empty() { vec![under[0]; over.len()] } else { sum(&form.under, under) };
        let values: Vec<f64> = over.iter().zip(under).map(|(p, q)| self.anchor + p / q).collect();
        values.iter().all(|v| v.is_finite()).then_some(values)
    }

    fn helpers(&self, form: &Form) -> Option<Vec<Vec<f64>>> {
        form.helpers.iter().map(|h| h.column(&self.samples.axes)).collect()
    }

    fn product(&self, term: &Term, helpers: &[Vec<f64>]) -> Vec<f64> {
        let mut column = vec![1.0; self.samples.len()];
        let factors = self.samples.axes.iter().chain(helpers);
        for (factor, power) in factors.zip(term).filter(|(_, power)| **power > 0) {
            multiply(&mut column, factor, *power);
        }
        column
    }

    /// Columns of (R, D): a term t of Q gives ((scale anchor - target) t, t), one of P (scale t,
    /// 0).
    fn columns(&self, form: &Form) -> Option<Columns> {
        let helpers = self.helpers(form)?;
        let product = |term: &Term| self.product(term, &helpers);
        let by = |column: &[f64], factor: &[f64]| column.iter().zip(factor).map(|(a, b)| a * b).collect();
        let (mut residual, mut divisor): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        let one = [[0; super::space::SLOTS]];
        let under = if form.under.is_empty() { one.as_slice() } else { &form.under };
        for term in under {
            let column = product(term);
            residual.push(by(&column, &self.offset));
            divisor.push(column);
        }
        for term in &form.over {
            residual.push(by(&product(term), &self.scale));
            divisor.push(vec![0.0; self.samples.len()]);
        }
        Columns::assemble(residual, divisor, self.magnitude, false).ok()
    }
}

/// A form with its coefficients: where a search among its neighbours starts.
pub(super) struct Known<'a> {
    pub form: &'a Form,
    pub coefficients: &'a [f64],
}

impl Known<'_> {
    /// The coefficients of another form: those of the terms that it shares, 0 for the others.
    fn of(&self, form: &Form) -> Vec<f64> {
        let below = self.form.under.len().max(1);
        let find = |terms: &[Term], term: &Term, first: usize| {
            terms.iter().position(|t| t == term).map_or(0.0, |k| self.coefficients[first + k])
        };
        let mut own: Vec<f64> = form.under.iter().map(|t| find(&self.form.under, t, 0)).collect();
        if form.under.is_empty() {
            own.push(1.0);
        }
        own.extend(form.over.iter().map(|t| find(&self.form.over, t, below)));
        own
    }
}
