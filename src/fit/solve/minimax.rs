//! Smallest largest error: sequential linear programming in a trust region, from a least-squares fit.

use super::chebyshev::{Chebyshev, Step};
use super::objective::{Objective, Refused, largest, rms};

/// A predicted decrease below this part of the largest error is none.
const GAP: f64 = 1e-6;

/// A descent that comes to a halt with no more than this left to gain, by the linear programs' own bound, has arrived: their
/// solutions are good to some 1e-6 of the largest error, and steps that promise less cannot be told from noise.
const ARRIVED: f64 = 1e-4;

/// A trust region smaller than this part of the largest error has collapsed.
const COLLAPSED: f64 = 1e-9;

/// A step must gain this part of what the linear model promises.
const WORTH: f64 = 0.05;

/// The outcome of one descent.
#[derive(Clone, Debug)]
pub(super) struct Descent {
    pub coefficients: Vec<f64>,
    pub max: f64,
    pub rms: f64,
    /// What the last linear program could still have gained, as a part of `max`.
    pub gap: f64,
    /// Whether the linear programs found nothing more to gain, or next to nothing.
    pub optimal: bool,
    /// Whether the iterations were used up.
    pub capped: bool,
    pub evaluations: u64,
}

/// Descends from `start`.
///
/// # Errors
/// The start is refused.
pub(super) fn descend(objective: &Objective, start: &[f64], iterations: u64) -> Result<Descent, Refused> {
    let mut linear = objective.linearise(start)?;
    let max = largest(&linear.residuals);
    let mut best = Descent {
        coefficients: start.to_vec(),
        max,
        rms: rms(&linear.residuals),
        gap: f64::INFINITY,
        optimal: max == 0.0,
        capped: false,
        evaluations: 1,
    };
    let mut radius = max;
    let mut steps = 0;
    while !best.optimal && steps < iterations {
        let mut programs = Chebyshev::new(&linear);
        let moved = loop {
            steps += 1;
            let Some(step) = programs.step(radius) else { break None };
            // Only a step that the box does not hold back says how much is left to gain.
            best.gap = if step.held { best.gap } else { ((best.max - step.bound) / best.max).max(0.0) };
            if best.max - step.bound <= GAP * best.max && !step.held {
                best.optimal = true;
                break None;
            }
            best.evaluations += 1;
            let (next, ratio) = attempt(objective, &best, &step);
            radius = next_radius(radius, ratio, &step);
            if let Some(next) = next {
                break Some(next);
            }
            if radius < COLLAPSED * best.max || steps >= iterations {
                break None;
            }
        };
        let Some((coefficients, max)) = moved else { break };
        linear = objective.linearise(&coefficients)?;
        best.evaluations += 1;
        best = Descent { coefficients, max, rms: rms(&linear.residuals), ..best };
    }
    best.optimal |= best.gap <= ARRIVED;
    best.capped = !best.optimal && steps >= iterations;
    Ok(best)
}

/// Where a step leads, if it is worth taking, and the part of the predicted gain that it brought.
fn attempt(objective: &Objective, best: &Descent, step: &Step) -> (Option<(Vec<f64>, f64)>, f64) {
    let next: Vec<f64> = best.coefficients.iter().zip(&step.step).map(|(p, d)| p + d).collect();
    let Ok(residuals) = objective.residuals(&next) else { return (None, -1.0) };
    let max = largest(&residuals);
    let promised = best.max - step.predicted;
    if promised <= 0.0 {
        return (None, -1.0);
    }
    let ratio = (best.max - max) / promised;
    ((ratio > WORTH).then_some((next, max)), ratio)
}

/// Larger after good steps, smaller after bad ones.
fn next_radius(radius: f64, ratio: f64, step: &Step) -> f64 {
    if ratio > 0.75 && step.held {
        2.0 * radius
    } else if ratio < 0.0 {
        0.25 * radius
    } else if ratio < 0.4 {
        0.5 * radius
    } else {
        radius
    }
}
