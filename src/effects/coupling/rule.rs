//! What the emitted average of a factor is off its integral.

use crate::approximate::{Fit, FitStageError, Region};
use crate::effects::BakeError;
use crate::effects::coupling::emitted::{AverageRule, RuleError};
use lobefit_math::chebyshev;
use lobefit_math::gauss::Gauss;
use lobefit_shade::round_up;
use lobefit_truth::points::Points;

/// Places of roughness, values of f0, and nodes of the rule that takes the integral's place: the
/// emitted one has four.
const ROUGHNESS: usize = 33;
const F0: usize = 33;
const NODES: usize = 64;

/// Largest errors over the region's roughness, for these f0 and for all.
pub fn error(region: &Region, f0: [f64; 2], fit: &Fit) -> Result<RuleError, BakeError> {
    let stated = largest(region, f0, fit)?;
    let any = largest(region, [0.0, 1.0], fit)?;
    let [average, energy, any_energy] =
        [stated[0].max(any[0]), stated[1], any[1]].map(|error| round_up(error, 2));
    Ok(RuleError { average, energy, any_energy })
}

/// Largest errors of the average, and of the base's light.
fn largest(region: &Region, f0: [f64; 2], fit: &Fit) -> Result<[f64; 2], BakeError> {
    let rule = Gauss::new(NODES);
    let cosines: Vec<f64> = rule.nodes.iter().map(|x| 0.5 * (1.0 + x)).collect();
    let emitted = AverageRule::new().map_err(FitStageError::from)?;
    let (least, nodes) = (f64::from(emitted.least), emitted.nodes.map(f64::from));
    let [low, high] = region.roughness;
    let (mut of_average, mut energy) = (0.0_f64, 0.0_f64);
    for roughness in chebyshev::nodes(low, high, ROUGHNESS) {
        for f0 in chebyshev::nodes(f0[0], f0[1], F0) {
            let values = values(region, fit, roughness, f0, &cosines)?;
            let weighted = values.iter().zip(&rule.weights).zip(&cosines);
            // 2 mu over half the range of the rule
            let integral: f64 = weighted.map(|((v, w), mu)| w * mu * v).sum();
            let at_nodes = self::values(region, fit, roughness, f0, &nodes)?;
            let stated = f64::from(emitted.average([0, 1, 2, 3].map(|i| at_nodes[i] as f32)));
            of_average = of_average.max((stated - integral).abs());
            let scale = integral / stated.max(least) - 1.0;
            // Below the least average the base only fades, which another figure states.
            let scale = if stated < least { scale.max(0.0) } else { scale.abs() };
            energy = values.iter().fold(energy, |most, v| most.max(v * scale));
        }
    }
    Ok([of_average, energy])
}

/// The factor as the average takes it, not below 0, at cosines.
fn values(
    region: &Region,
    fit: &Fit,
    roughness: f64,
    f0: f64,
    cosines: &[f64],
) -> Result<Vec<f64>, BakeError> {
    let mut points = Points::default();
    cosines.iter().for_each(|mu| region.push(&mut points, roughness, *mu));
    let values = fit.values_for(&points, f0 as f32).map_err(FitStageError::from)?;
    Ok(values.into_iter().map(|v| f64::from(v.max(0.0))).collect())
}
