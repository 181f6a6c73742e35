//! Rough glass over index of refraction, alpha and mu: R and T of either side.

use super::solid::{Knots, Solid};
use super::{Lobe, Once, Truth, Values, once, place_of};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit::data::Smith;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::GgxGlass;

/// Least alpha that is judged, beside 0: that of the kernel of tables.
const KERNEL_ALPHA: f64 = 4e-4;

/// Least mu that is judged.
const LEAST_MU: f64 = 2e-4;

/// Largest index of refraction that is judged.
const MOST_IOR: f64 = 3.0;

/// Tolerance of exact values.
const EXACT: f64 = 1e-6;

/// Tolerance at the knots.
const QUICK: f64 = 1e-3;

struct Glass {
    lobes: Vec<Lobe>,
    solid: Solid,
}

/// The values at the knots, of either form from either side.
static KEPT: [Once<[Values; 2]>; 2] = [Once::new(), Once::new()];

/// `ggx-glass`: R and T.
pub(crate) fn glass(lobes: Vec<Lobe>) -> Result<impl Truth + use<>, AuditError> {
    let knots = [
        Knots { coordinate: f64::sqrt, input: |u| u * u, range: [1.0, MOST_IOR], count: 20 },
        Knots { coordinate: f64::sqrt, input: |u| u * u, range: [KERNEL_ALPHA, 1.0], count: 20 },
        Knots { coordinate: f64::sqrt, input: |u| u * u, range: [1e-3, 1.0], count: 40 },
    ];
    let at = knots.map(|k| k.inputs());
    let mut values = Vec::new();
    for Lobe { smith, side } in &lobes {
        let smith = smith.unwrap_or_default();
        let sides = || energies(smith, [&at[0], &at[1], &at[2]], QUICK);
        values.push(&once(&KEPT[place_of(smith)], sides)?[place_among(*side)]);
    }
    Ok(Glass { lobes, solid: Solid { knots, values } })
}

fn place_among(side: Option<Side>) -> usize {
    usize::from(side == Some(Side::Inside))
}

/// R and T of either side at every combination, the index of refraction fastest, then alpha.
fn energies(
    smith: Smith,
    [iors, alphas, mus]: [&[f64]; 3],
    tolerance: f64,
) -> Result<[Values; 2], AuditError> {
    // Narrower lobes are not judged, and stand as the smooth interface.
    let alphas: Vec<f64> = alphas.iter().map(|a| if *a < KERNEL_ALPHA { 0.0 } else { *a }).collect();
    let points = Points::product(&[("ior", iors), ("alpha", &alphas), ("mu", mus)]);
    let sides = GgxGlass.both_sides(smith, &points, tolerance)?;
    Ok(sides.map(|side| {
        let [r, t, _] = side.arrays();
        r.into_iter().zip(t).map(<[f64; 2]>::from).collect()
    }))
}

impl Truth for Glass {
    fn quantity(&self) -> &'static str {
        "ggx-glass"
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Ior, Input::Alpha, Input::Mu]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::GLASS
    }

    fn range(&self, input: Input) -> [f64; 2] {
        match input {
            Input::Ior => [1.0, MOST_IOR],
            Input::Mu => [LEAST_MU, 1.0],
            _ => [0.0, 1.0],
        }
    }

    fn judges(&self, input: Input, x: f64) -> bool {
        let [low, high] = self.range(input);
        let gap = input == Input::Alpha && x > 0.0 && x < KERNEL_ALPHA;
        (low..=high).contains(&x) && !gap
    }

    fn quick(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        Ok(self.solid.at(lobe, at))
    }

    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        let Lobe { smith, side } = self.lobes[lobe];
        let [outside, inside] = energies(smith.unwrap_or_default(), [at[0], at[1], at[2]], EXACT)?;
        Ok(if place_among(side) == 0 { outside } else { inside })
    }

    fn bound(&self) -> f64 {
        EXACT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobefit_truth::integrate::glass;

    #[test]
    fn exact_values_are_the_quantity_and_quick_ones_are_near() {
        let lobes = Side::ALL.map(|side| Lobe { smith: Some(Smith::Separable), side: Some(side) }).to_vec();
        let truth = glass(lobes).unwrap();
        let (iors, alphas, mus) = ([1.2, 1.5], [0.0, 5e-4, 0.09, 0.7], [0.2, 0.83]);
        for (lobe, side) in Side::ALL.into_iter().enumerate() {
            let exact = truth.exact(lobe, &[&iors, &alphas, &mus]).unwrap();
            let quick = truth.quick(lobe, &[&iors, &alphas, &mus]).unwrap();
            for (i, value) in exact.iter().enumerate() {
                let (ior, alpha, mu) = (iors[i % 2], alphas[i / 2 % 4], mus[i / 8]);
                let truth = glass::glass(Smith::Separable, alpha, mu, ior, side, 1e-7).unwrap();
                let gap = (value[0] - truth.r).abs().max((value[1] - truth.t).abs());
                assert!(gap < 2.0 * EXACT, "alpha {alpha} mu {mu} ior {ior} {side:?}: {gap:e}");
                let off = (value[0] - quick[i][0]).abs().max((value[1] - quick[i][1]).abs());
                assert!(off < 0.03, "alpha {alpha} mu {mu} ior {ior} {side:?}: {off:e}");
            }
        }
    }
}
