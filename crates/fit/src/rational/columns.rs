//! A problem's numbers, column by column and scaled: the residual's numerator R = scale n - target
//! d and the denominator D, both affine in the coefficients.

use super::Rational;
use crate::FitError;
use lobefit_shade::ShadeError;

/// R / magnitude and D of every sample: constants, then one column per coefficient.
pub(crate) struct Columns {
    pub samples: usize,
    /// `1 + parameters` columns of R.
    pub residual: Vec<Vec<f64>>,
    /// `1 + parameters` columns of D.
    pub divisor: Vec<Vec<f64>>,
    /// Columns of D that are not 0.
    pub free: Vec<usize>,
    /// Size of a sample's denominator: its largest entry.
    pub size: Vec<f64>,
    /// What each column was divided by; coefficient = (x_j / unit_j) / (x_0 / unit_0) of
    /// homogeneous, scaled x.
    pub unit: Vec<f64>,
    /// What residuals were divided by: the largest target.
    pub magnitude: f64,
    /// Whether the first column has the coefficient 1: else any coefficients will do, up to a
    /// factor.
    pub affine: bool,
}

/// Residuals below this part of the largest target are rounding.
pub(super) const NOISE: f64 = 4e-15;

impl Columns {
    /// Checks shapes and numbers, and scales the columns.
    pub fn new(problem: &Rational) -> Result<Columns, FitError> {
        check(problem)?;
        let (m, width) = (problem.target.len(), 1 + problem.parameters);
        let column = |matrix: &[f64], j: usize| (0..m).map(|i| matrix[i * width + j]).collect::<Vec<f64>>();
        let divisor: Vec<Vec<f64>> = (0..width).map(|j| column(&problem.denominator, j)).collect();
        let largest = problem.target.iter().fold(0.0_f64, |top, t| top.max(t.abs()));
        let magnitude = if largest > 0.0 { largest } else { 1.0 };
        let residual: Vec<Vec<f64>> = (0..width)
            .map(|j| {
                let numerator = column(&problem.numerator, j);
                let part = |i: usize| problem.scale[i] * numerator[i] - problem.target[i] * divisor[j][i];
                (0..m).map(|i| part(i) / magnitude).collect()
            })
            .collect();
        Columns::assemble(residual, divisor, magnitude, true)
    }

    /// Columns of R / magnitude and of D, one pair or more, all of one length.
    pub fn assemble(
        residual: Vec<Vec<f64>>,
        divisor: Vec<Vec<f64>>,
        magnitude: f64,
        affine: bool,
    ) -> Result<Columns, FitError> {
        let (samples, width) = (residual[0].len(), residual.len());
        let mut columns = Columns {
            samples,
            free: Vec::new(),
            size: vec![0.0; samples],
            unit: vec![1.0; width],
            magnitude,
            affine,
            residual,
            divisor,
        };
        columns.scale()?;
        Ok(columns)
    }

    /// Makes the largest entry of every column, relative to the sample's denominator, 1.
    fn scale(&mut self) -> Result<(), FitError> {
        let largest = |columns: &[Vec<f64>], i: usize| columns.iter().fold(0.0_f64, |t, c| t.max(c[i].abs()));
        self.size = (0..self.samples).map(|i| largest(&self.divisor, i)).collect();
        if let Some(sample) = self.size.iter().position(|s| *s == 0.0) {
            return Err(FitError::NoDenominator { sample: Some(sample) });
        }
        for j in 0..self.residual.len() {
            let part = |column: &[f64]| {
                column.iter().zip(&self.size).fold(0.0_f64, |top, (v, size)| top.max(v.abs() / size))
            };
            let unit = part(&self.residual[j]).max(part(&self.divisor[j]));
            if unit == 0.0 && j > 0 {
                return Err(FitError::Degenerate { parameter: j - 1 });
            }
            // A form without constant terms has a first column of zeros.
            let unit = if unit == 0.0 { 1.0 } else { unit };
            self.unit[j] = unit;
            self.residual[j].iter_mut().for_each(|v| *v /= unit);
            self.divisor[j].iter_mut().for_each(|v| *v /= unit);
            if self.divisor[j].iter().any(|v| *v != 0.0) {
                self.free.push(j);
            }
        }
        Ok(())
    }

    /// R and D at homogeneous coefficients.
    pub fn at(&self, x: &[f64], residual: &mut Vec<f64>, divisor: &mut Vec<f64>) {
        let reset = |into: &mut Vec<f64>| {
            into.clear();
            into.resize(self.samples, 0.0);
        };
        let add = |into: &mut [f64], column: &[f64], x: f64| {
            into.iter_mut().zip(column).for_each(|(into, v)| *into += x * v);
        };
        reset(residual);
        reset(divisor);
        for (column, x) in self.residual.iter().zip(x) {
            add(residual, column, *x);
        }
        for &j in &self.free {
            add(divisor, &self.divisor[j], x[j]);
        }
    }

    /// Homogeneous coefficients of given ones.
    pub fn homogeneous(&self, coefficients: &[f64]) -> Vec<f64> {
        let all = std::iter::once(&1.0).chain(coefficients);
        all.zip(&self.unit).map(|(p, unit)| p * unit).collect()
    }

    /// The coefficients of homogeneous ones.
    pub fn coefficients(&self, x: &[f64]) -> Vec<f64> {
        let one = x[0] / self.unit[0];
        x[1..].iter().zip(&self.unit[1..]).map(|(x, unit)| x / unit / one).collect()
    }

    /// The first coefficient whose column the earlier ones can replace, by Gram-Schmidt on the
    /// columns of (R, D).
    pub fn dependent(&self) -> Option<usize> {
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for j in 1..self.residual.len() {
            let stacked =
                |c: &[Vec<f64>]| c[j].iter().zip(&self.size).map(|(v, s)| v / s).collect::<Vec<f64>>();
            let mut column = stacked(&self.residual);
            column.extend(stacked(&self.divisor));
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let before = dot(&column, &column).sqrt();
            // Twice is enough.
            for _ in 0..2 {
                for direction in &basis {
                    let part = dot(&column, direction);
                    column.iter_mut().zip(direction).for_each(|(c, d)| *c -= part * d);
                }
            }
            let after = dot(&column, &column).sqrt();
            if after <= DEPENDENT * before {
                return Some(j - 1);
            }
            column.iter_mut().for_each(|c| *c /= after);
            basis.push(column);
        }
        None
    }
}

/// A column of which less than this part is new adds nothing.
const DEPENDENT: f64 = 1e-11;

fn check(problem: &Rational) -> Result<(), FitError> {
    let (m, width) = (problem.target.len(), 1 + problem.parameters);
    if m == 0 {
        return Err(ShadeError::Shape { what: "samples".to_string(), found: 0, expected: 1 }.into());
    }
    let parts = [
        ("numerator", &problem.numerator, m * width),
        ("denominator", &problem.denominator, m * width),
        ("scale", &problem.scale, m),
        ("target", &problem.target, m),
    ];
    for (name, column, expected) in parts {
        if column.len() != expected {
            return Err(ShadeError::Shape { what: name.to_string(), found: column.len(), expected }.into());
        }
        if let Some(at) = column.iter().position(|v| !v.is_finite()) {
            let index = at / (expected / m);
            return Err(ShadeError::NotFinite { column: name.to_string(), index, value: column[at] }.into());
        }
    }
    Ok(())
}
