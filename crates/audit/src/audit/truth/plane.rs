//! Truths over alpha and mu: interpolated in ln(alpha) and ln(mu), in which they are analytic with
//! singularities no nearer than i pi/2 (alpha^2 or mu^2 negative), so that Chebyshev nodes converge
//! geometrically; what lies below the interpolant is integrated.

use rayon::prelude::*;

use super::{Lobe, Once, Truth, Values, once, place_of};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit::data::Smith;
use lobefit_math::{chebyshev, ops};
use lobefit_truth::integrate::reflection::{Effort, SMALLEST_ALPHA, split_of};
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::optics::distribution::{Distribution, Ggx};
use lobefit_truth::quantity::{BECKMANN_REFLECTION, GGX_REFLECTION, Quantity};

/// Least alpha and mu of the interpolant.
const LEAST: f64 = 1e-6;

/// Nodes along each axis. Measured over [1e-6, 1]^2: 56 nodes leave 1e-6, 72 leave 3e-8, a factor
/// of 9 for every 8 more.
const NODES: usize = 88;

/// What [`NODES`] leave, and the rule of sixteen nodes a panel: of GGX, and of Beckmann, whose tail
/// bends more.
const BOUNDS: [f64; 2] = [1e-9, 1e-5];

/// E and B of one point.
type Point = fn(Smith, f64, f64) -> [f64; 2];

/// A truth over alpha and mu.
pub(super) struct Plane {
    quantity: &'static str,
    point: Point,
    bound: f64,
    lobes: Vec<Lobe>,
    /// ln of the nodes, and for each lobe the values, alpha fastest.
    nodes: Vec<f64>,
    values: Vec<&'static Values>,
}

/// The interpolants' values of either form, of GGX and of Beckmann.
static KEPT: [[Once<Values>; 2]; 2] = [const { [const { Once::new() }; 2] }; 2];

/// `ggx-reflection`: E and B.
pub(crate) fn ggx(smiths: &[Smith]) -> Result<impl Truth + use<>, AuditError> {
    plane(GGX_REFLECTION.name(), |smith, alpha, mu| point(smith, Ggx, alpha, mu), 0, smiths)
}

/// `beckmann-reflection`: E and B.
pub(crate) fn beckmann(smiths: &[Smith]) -> Result<impl Truth + use<>, AuditError> {
    plane(BECKMANN_REFLECTION.name(), |smith, alpha, mu| point(smith, Beckmann, alpha, mu), 1, smiths)
}

fn plane(quantity: &'static str, point: Point, which: usize, smiths: &[Smith]) -> Result<Plane, AuditError> {
    let nodes = chebyshev::nodes(ops::log(LEAST), 0.0, NODES);
    let at: Vec<f64> = nodes.iter().map(|x| ops::exp(*x).clamp(LEAST, 1.0)).collect();
    let table = |smith: Smith| -> Values {
        let rows = at.par_iter().map(|mu| at.iter().map(|alpha| point(smith, *alpha, *mu)).collect());
        rows.collect::<Vec<Values>>().into_iter().flatten().collect()
    };
    let of = |smith: &Smith| once(&KEPT[which][place_of(*smith)], || Ok(table(*smith)));
    let values = smiths.iter().map(of).collect::<Result<_, _>>()?;
    let lobes = smiths.iter().map(|s| Lobe { smith: Some(*s), side: None }).collect();
    Ok(Plane { quantity, point, bound: BOUNDS[which], lobes, nodes, values })
}

/// E and B of a point; an alpha that is not integrated is a mirror to 1e-8.
fn point<D: Distribution>(smith: Smith, lobe: fn(f64) -> D, alpha: f64, mu: f64) -> [f64; 2] {
    let alpha = if alpha < SMALLEST_ALPHA { 0.0 } else { alpha };
    split_of(smith, lobe(alpha), mu, &Effort::ladder()[1 + usize::from(D::REACH.is_finite())]).into()
}

impl Plane {
    fn smith(&self, lobe: usize) -> Smith {
        self.lobes[lobe].smith.unwrap_or_default()
    }

    /// The interpolant at inputs moved into its square.
    fn interpolated(&self, lobe: usize, alphas: &[f64], mus: &[f64]) -> Values {
        let weights = |x: &f64| chebyshev::weights(&self.nodes, ops::log(x.clamp(LEAST, 1.0)));
        let across: Vec<Vec<f64>> = alphas.par_iter().map(weights).collect();
        let values = self.values[lobe];
        let row = |mu: &f64| -> Values {
            let down = weights(mu);
            let mut line = vec![[0.0; 2]; NODES];
            for (weight, row) in down.iter().zip(values.chunks(NODES)) {
                for (sum, value) in line.iter_mut().zip(row) {
                    sum[0] += weight * value[0];
                    sum[1] += weight * value[1];
                }
            }
            across.iter().map(|weights| blend(weights, &line)).collect()
        };
        mus.par_iter().map(row).collect::<Vec<Values>>().into_iter().flatten().collect()
    }
}

fn blend(weights: &[f64], line: &[[f64; 2]]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (weight, value) in weights.iter().zip(line) {
        sum[0] += weight * value[0];
        sum[1] += weight * value[1];
    }
    sum
}

impl Truth for Plane {
    fn quantity(&self) -> &'static str {
        self.quantity
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Alpha, Input::Mu]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::REFLECTION
    }

    fn range(&self, _: Input) -> [f64; 2] {
        [0.0, 1.0]
    }

    fn quick(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        Ok(self.interpolated(lobe, at[0], at[1]))
    }

    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        let mut values = self.interpolated(lobe, at[0], at[1]);
        for (row, mu) in values.chunks_mut(at[0].len()).zip(at[1]) {
            for (value, alpha) in row.iter_mut().zip(at[0]) {
                if *alpha < LEAST || *mu < LEAST {
                    *value = (self.point)(self.smith(lobe), *alpha, *mu);
                }
            }
        }
        Ok(values)
    }

    fn bound(&self) -> f64 {
        self.bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interpolant_keeps_its_bound() {
        let smiths = [Smith::Correlated, Smith::Separable];
        keeps(&smiths, &ggx(&smiths).unwrap(), |smith, alpha, mu| point(smith, Ggx, alpha, mu));
        keeps(&smiths, &beckmann(&smiths).unwrap(), |smith, alpha, mu| point(smith, Beckmann, alpha, mu));
    }

    fn keeps(smiths: &[Smith], truth: &impl Truth, point: Point) {
        let (name, truth_bound) = (truth.quantity(), truth.bound());
        let spread = |n: usize, step: f64| -> Vec<f64> {
            (0..n).map(|i| ops::exp(-13.7 * ((0.11 + step * i as f64) % 1.0))).collect()
        };
        let (alphas, mus) = ([spread(40, 0.618), vec![0.0, 1e-9, 1.0]].concat(), spread(41, 0.414));
        let mus = [mus, vec![0.0, 3e-7, 1.0]].concat();
        for (lobe, smith) in smiths.iter().enumerate() {
            let values = truth.exact(lobe, &[&alphas, &mus]).unwrap();
            for (row, mu) in values.chunks(alphas.len()).zip(&mus) {
                for (value, alpha) in row.iter().zip(&alphas) {
                    let truth = point(*smith, *alpha, *mu);
                    let gap = (value[0] - truth[0]).abs().max((value[1] - truth[1]).abs());
                    assert!(gap < truth_bound, "{name} {smith:?} alpha {alpha:e} mu {mu:e}: {gap:e}");
                }
            }
        }
    }
}
