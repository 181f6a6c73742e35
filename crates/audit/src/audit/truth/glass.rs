//! Rough glass over index of refraction, alpha and mu: R and T of either side.

use rayon::prelude::*;

use super::solid::{Knots, Solid};
use super::{Lobe, Once, Truth, Values, once, place_of};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit::data::Smith;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};
use lobefit_truth::integrate::glass::{self, Side};

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

const SIDES: [Side; 2] = [Side::Outside, Side::Inside];

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
        let both = || energies(smith, [&at[0], &at[1], &at[2]], QUICK);
        let sides = || both().map(|both| SIDES.map(|side| of_side(&both, Some(side))));
        values.push(&once(&KEPT[place_of(smith)], sides)?[place_among(*side)]);
    }
    Ok(Glass { lobes, solid: Solid { knots, values } })
}

fn place_among(side: Option<Side>) -> usize {
    usize::from(side == Some(Side::Inside))
}

fn of_side(both: &[Energies], side: Option<Side>) -> Values {
    let k = place_among(side);
    both.iter().map(|e| [e.r[k], e.t[k]]).collect()
}

/// R and T at every combination, the index of refraction fastest, then alpha.
fn energies(
    smith: Smith,
    [iors, alphas, mus]: [&[f64]; 3],
    tolerance: f64,
) -> Result<Vec<Energies>, AuditError> {
    let kernel = Kernel::new(smith, tolerance)?;
    let pairs: Vec<(f64, f64)> = mus.iter().flat_map(|mu| alphas.iter().map(|a| (*a, *mu))).collect();
    let lines: Vec<Vec<Energies>> = pairs
        .par_iter()
        .map(|(alpha, mu)| {
            let mut out = vec![Energies::default(); iors.len()];
            if *alpha >= KERNEL_ALPHA {
                kernel.energies(*alpha, *mu, iors, &mut out)?;
            } else {
                smooth(smith, *mu, iors, &mut out)?;
            }
            Ok(out)
        })
        .collect::<Result<_, IntegrateError>>()?;
    Ok(lines.into_iter().flatten().collect())
}

/// The smooth interface.
fn smooth(smith: Smith, mu: f64, iors: &[f64], out: &mut [Energies]) -> Result<(), IntegrateError> {
    for (ior, energies) in iors.iter().zip(out) {
        for (k, side) in SIDES.into_iter().enumerate() {
            let value = glass::glass(smith, 0.0, mu, *ior, side, EXACT)?;
            (energies.r[k], energies.t[k]) = (value.r, value.t);
        }
    }
    Ok(())
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
        Ok(of_side(&energies(smith.unwrap_or_default(), [at[0], at[1], at[2]], EXACT)?, side))
    }

    fn bound(&self) -> f64 {
        EXACT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_values_are_the_quantity_and_quick_ones_are_near() {
        let lobes = SIDES.map(|side| Lobe { smith: Some(Smith::Separable), side: Some(side) }).to_vec();
        let truth = glass(lobes).unwrap();
        let (iors, alphas, mus) = ([1.2, 1.5], [0.0, 5e-4, 0.09, 0.7], [0.2, 0.83]);
        for (lobe, side) in SIDES.into_iter().enumerate() {
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
