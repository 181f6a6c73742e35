//! A quantity or an error over a grid of two inputs: what a heat map shows.

use lobefit_math::numbers::rounded;
use serde::{Serialize, Serializer};

use crate::{ReportError, check};

/// One input of a grid: what it is and where it was sampled.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ruler {
    /// Name of the input: `mu`, `roughness`, `column`.
    pub name: String,
    /// Sample positions, strictly increasing; any spacing.
    pub values: Vec<f64>,
}

impl Ruler {
    /// `n` evenly spaced samples of [min, max], both ends included.
    pub fn even(name: &str, min: f64, max: f64, n: usize) -> Ruler {
        let last = n.saturating_sub(1).max(1) as f64;
        let values = (0..n).map(|i| min + (max - min) * (i as f64 / last)).collect();
        Ruler { name: name.into(), values }
    }

    /// Position in cells, 0 at the first cell's centre, of a physical value, clamped to the cells.
    pub(crate) fn position(&self, x: f64) -> f64 {
        let next = self.values.partition_point(|&v| v < x);
        if next == 0 {
            return 0.0;
        }
        if next >= self.values.len() {
            return self.values.len().saturating_sub(1) as f64;
        }
        let (a, b) = (self.values[next - 1], self.values[next]);
        (next - 1) as f64 + (x - a) / (b - a)
    }
}

/// Values over a grid. They are pictures and need f32; figures that carry a promise are f64
/// elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Field {
    /// What it is: `E`, `E N - 1`, `lookup error of E`.
    pub name: String,
    /// Unit of the values; empty for a pure number.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// Whether the values are signed errors (zero is white) or magnitudes.
    pub signed: bool,
    /// Input along columns.
    pub x: Ruler,
    /// Input along rows.
    pub y: Ruler,
    /// `values[j * x.values.len() + i]` at `x.values[i]`, `y.values[j]`.
    #[serde(serialize_with = "drawn")]
    pub values: Vec<f32>,
}

impl Field {
    /// Samples a function of (x, y), row by row.
    pub fn sample(name: &str, signed: bool, x: Ruler, y: Ruler, f: impl Fn(f64, f64) -> f64) -> Field {
        let values = y.values.iter().flat_map(|&b| x.values.iter().map(move |&a| (a, b)));
        let values = values.map(|(a, b)| f(a, b) as f32).collect();
        Field { name: name.into(), unit: String::new(), signed, x, y, values }
    }

    /// Largest magnitude; 0 of an empty field.
    pub fn peak(&self) -> f64 {
        self.values.iter().fold(0.0, |m: f64, &v| m.max(f64::from(v).abs()))
    }

    /// Place and value of the largest magnitude, the first of equals: (x, y, value).
    pub fn worst(&self) -> Option<(f64, f64, f64)> {
        let columns = self.x.values.len();
        let peak = self.peak();
        let i = self.values.iter().position(|&v| f64::from(v).abs() == peak)?;
        let (x, y) = (self.x.values.get(i % columns)?, self.y.values.get(i / columns)?);
        Some((*x, *y, f64::from(self.values[i])))
    }

    /// Value of the node nearest to a place, clamped to the grid; 0 of an empty field.
    pub fn nearest(&self, x: f64, y: f64) -> f64 {
        let (i, j) = (self.x.position(x).round() as usize, self.y.position(y).round() as usize);
        self.values.get(j * self.x.values.len() + i).map_or(0.0, |&v| f64::from(v))
    }

    /// Rulers increase, the values are as many as the grid has nodes, and finite.
    ///
    /// # Errors
    /// The field that is not so, with the section that would show it.
    pub fn check(&self, section: &str) -> Result<(), ReportError> {
        check::increasing(section, &format!("{}: {}", self.name, self.x.name), &self.x.values)?;
        check::increasing(section, &format!("{}: {}", self.name, self.y.name), &self.y.values)?;
        let values = format!("{}: values", self.name);
        check::size(section, &values, self.values.len(), self.x.values.len() * self.y.values.len())?;
        let bad = self.values.iter().position(|v| !v.is_finite());
        bad.map_or(Ok(()), |i| check::finite(section, &format!("{values}[{i}]"), f64::NAN))
    }
}

/// Digits of a number that a picture is drawn from: a pixel tells no more.
const DRAWN: usize = 4;

/// What pictures are drawn from, in the digits that they show: a serializer of lists of numbers.
pub fn drawn<S: Serializer>(values: &[impl Copy + Into<f64>], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|&x| rounded(x.into(), DRAWN)))
}

/// [`drawn`] of several lists.
pub fn drawn_lists<S: Serializer>(lists: &[Vec<f64>], serializer: S) -> Result<S::Ok, S::Error> {
    let list = |values: &Vec<f64>| values.iter().map(|&x| rounded(x, DRAWN)).collect::<Vec<f64>>();
    serializer.collect_seq(lists.iter().map(list))
}
