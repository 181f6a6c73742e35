//! Averages over alpha: E_avg, and E at normal incidence, which is taken for one.

use rayon::prelude::*;

use super::{Lobe, Once, Truth, Values, once, place_of};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit::data::Smith;
use lobefit_math::{chebyshev, ops};
use lobefit_truth::integrate::reflection::{self, Effort, albedo};

/// Least alpha of the interpolant in ln(alpha); below it the lobe is a mirror to 1e-8.
const LEAST: f64 = 1e-6;

/// Nodes.
const NODES: usize = 88;

/// What they leave.
const BOUND: f64 = 1e-8;

/// Tolerance of a node.
const TOLERANCE: f64 = 1e-9;

struct Average {
    lobes: Vec<Lobe>,
    nodes: Vec<f64>,
    values: Vec<&'static Values>,
}

/// The interpolants' values of either form.
static KEPT: [Once<Values>; 2] = [Once::new(), Once::new()];

/// `ggx-average`: E_avg and E(mu = 1).
pub(crate) fn average(smiths: &[Smith]) -> Result<impl Truth + use<>, AuditError> {
    let nodes = chebyshev::nodes(ops::log(LEAST), 0.0, NODES);
    let mut values = Vec::new();
    for smith in smiths {
        let at = |x: &f64| point(*smith, ops::exp(*x).clamp(LEAST, 1.0));
        let made = || nodes.par_iter().map(at).collect::<Result<Values, AuditError>>();
        values.push(once(&KEPT[place_of(*smith)], made)?);
    }
    let lobes = smiths.iter().map(|s| Lobe { smith: Some(*s), side: None }).collect();
    Ok(Average { lobes, nodes, values })
}

fn point(smith: Smith, alpha: f64) -> Result<[f64; 2], AuditError> {
    let e_avg = reflection::average(smith, alpha, TOLERANCE)?.e_avg;
    Ok([e_avg, albedo(smith, alpha, 1.0, &Effort::ladder()[1].outer)])
}

impl Average {
    fn at(&self, lobe: usize, alpha: f64) -> [f64; 2] {
        if alpha < LEAST {
            return [1.0; 2];
        }
        let weights = chebyshev::weights(&self.nodes, ops::log(alpha));
        let pairs = weights.iter().zip(self.values[lobe]);
        pairs.fold([0.0; 2], |sum, (w, v)| [sum[0] + w * v[0], sum[1] + w * v[1]])
    }
}

impl Truth for Average {
    fn quantity(&self) -> &'static str {
        "ggx-average"
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Alpha]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::AVERAGE
    }

    fn range(&self, _: Input) -> [f64; 2] {
        [0.0, 1.0]
    }

    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        Ok(at[0].par_iter().map(|alpha| self.at(lobe, alpha.min(1.0))).collect())
    }

    fn bound(&self) -> f64 {
        BOUND
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interpolant_keeps_its_bound() {
        let smiths = [Smith::Correlated, Smith::Separable];
        let truth = average(&smiths).unwrap();
        for (lobe, smith) in smiths.into_iter().enumerate() {
            for alpha in [1e-6, 3.3e-5, 0.0017, 0.081, 0.44, 0.97, 1.0] {
                let (value, truth) =
                    (truth.exact(lobe, &[&[alpha]]).unwrap()[0], point(smith, alpha).unwrap());
                let gap = (value[0] - truth[0]).abs().max((value[1] - truth[1]).abs());
                assert!(gap < BOUND, "{smith:?} {alpha:e}: {gap:e}");
            }
        }
        assert!(
            (truth.exact(0, &[&[1.0]]).unwrap()[0][0] - 4.0 / 3.0 * (1.0 - std::f64::consts::LN_2)).abs()
                < BOUND
        );
    }
}
