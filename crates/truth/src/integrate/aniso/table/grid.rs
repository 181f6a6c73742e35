//! Where the texels of an anisotropic table lie, and the texels and nodes that a tolerance takes.

use crate::integrate::{IntegrateError, aniso};

/// Cosines of the view along a table's columns.
#[derive(Clone, Copy)]
pub enum Columns<'a> {
    /// The same in every row and slice.
    Fixed(&'a [f64]),
    /// mu of (column, row, aspect).
    Varying {
        /// Number of columns.
        count: usize,
        /// Cosine at a column, the index of a row and an aspect.
        mu: &'a (dyn Fn(usize, usize, f64) -> f64 + Sync),
    },
}

/// A table's texels: columns over mu, rows over alpha, slices over aspect.
///
/// alpha_x = max(floor, alpha/aspect) and alpha_y = max(floor, alpha aspect), both in [1e-4, 4];
/// aspect in [0.1, 10]; mu in [1e-4, 1].
#[derive(Clone, Copy)]
pub struct Grid<'a> {
    /// Cosines of the view.
    pub columns: Columns<'a>,
    /// sqrt(alpha_x alpha_y) of each row, where the floor does not raise it.
    pub alphas: &'a [f64],
    /// sqrt(alpha_y/alpha_x) of each slice, likewise.
    pub aspects: &'a [f64],
    /// Least alpha_x and alpha_y; 0 for none.
    pub floor: f64,
}

/// Range of an aspect.
pub const ASPECT: [f64; 2] = [0.1, 10.0];

/// Range of a cosine.
pub const MU: [f64; 2] = [1e-4, 1.0];

impl Grid<'_> {
    /// Columns, rows and slices.
    pub fn size(&self) -> [usize; 3] {
        let columns = match self.columns {
            Columns::Fixed(mu) => mu.len(),
            Columns::Varying { count, .. } => count,
        };
        [columns, self.alphas.len(), self.aspects.len()]
    }

    /// alpha_x and alpha_y of an alpha and an aspect.
    pub fn alpha(&self, alpha: f64, aspect: f64) -> [f64; 2] {
        [(alpha / aspect).max(self.floor), (alpha * aspect).max(self.floor)]
    }

    /// The cosine at a column, a row and an aspect.
    pub fn mu(&self, column: usize, row: usize, aspect: f64) -> f64 {
        match self.columns {
            Columns::Fixed(mu) => mu[column],
            Columns::Varying { mu, .. } => mu(column, row, aspect),
        }
    }

    /// alpha and mu of a texel.
    pub fn texel(&self, [column, row, slice]: [usize; 3]) -> ([f64; 2], f64) {
        let (alpha, aspect) = (self.alphas[row], self.aspects[slice]);
        (self.alpha(alpha, aspect), self.mu(column, row, aspect))
    }

    /// Whether the floor raises alpha_x or alpha_y in a row.
    pub fn raised(&self, row: usize) -> bool {
        let alpha = self.alphas[row];
        self.aspects.iter().any(|aspect| alpha / aspect < self.floor || alpha * aspect < self.floor)
    }

    /// Least and greatest cosine of all texels.
    pub fn cosines(&self) -> [f64; 2] {
        let [columns, ..] = self.size();
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for &aspect in self.aspects {
            for row in 0..self.alphas.len() {
                for column in 0..columns {
                    let mu = self.mu(column, row, aspect);
                    range = [range[0].min(mu), range[1].max(mu)];
                }
            }
        }
        range
    }

    /// Refuses an empty grid and values outside their domains.
    pub fn check(&self) -> Result<(), IntegrateError> {
        let size = self.size();
        if size.contains(&0) {
            return Err(IntegrateError::Option {
                option: "table size",
                value: format!("{size:?}"),
                must: "an anisotropic table has at least one column, row and slice",
            });
        }
        for &aspect in self.aspects {
            if !(ASPECT[0]..=ASPECT[1]).contains(&aspect) {
                return Err(domain("aspect", aspect, "is not in [0.1, 10]"));
            }
            for (row, &alpha) in self.alphas.iter().enumerate() {
                let [x, y] = self.alpha(alpha, aspect);
                for (input, value) in [("alpha_x", x), ("alpha_y", y)] {
                    check_alpha(input, value)?;
                }
                if alpha.is_nan() || alpha <= 0.0 {
                    return Err(domain("alpha", alpha, "is not above 0"));
                }
                for column in 0..size[0] {
                    let mu = self.mu(column, row, aspect);
                    if !(MU[0]..=MU[1]).contains(&mu) {
                        return Err(domain("mu", mu, "is not in [1e-4, 1]"));
                    }
                }
            }
        }
        Ok(())
    }
}

/// Refuses alpha_x or alpha_y outside its domain.
pub(super) fn check_alpha(input: &'static str, value: f64) -> Result<(), IntegrateError> {
    if (aniso::ALPHA[0]..=aniso::ALPHA[1]).contains(&value) {
        return Ok(());
    }
    Err(domain(input, value, "is not in [1e-4, 4]"))
}

/// An input outside its domain.
pub(super) fn domain(input: &'static str, value: f64, domain: &'static str) -> IntegrateError {
    IntegrateError::Domain { quantity: super::super::QUANTITY, input, value, domain }
}

/// Digits of a tolerance, refused outside [1e-10, 1e-2].
pub(super) fn digits(tolerance: f64) -> Result<f64, IntegrateError> {
    if (1e-10..=1e-2).contains(&tolerance) {
        return Ok(-lobefit_math::ops::log(tolerance) / std::f64::consts::LN_10);
    }
    Err(IntegrateError::Option {
        option: "tolerance",
        value: format!("{tolerance:e}"),
        must: "a table's tolerance lies in [1e-10, 1e-2]",
    })
}
