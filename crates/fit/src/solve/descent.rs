//! Sequential programs in a trust region: the largest residual, or a p-norm within constraints,
//! from a start.
//!
//! What descends is weight * norm + violation, the exact penalty: with a small enough weight its
//! minimum keeps every constraint that can be kept.

use super::affine::affine;
use super::bounds::{Bounds, LinearBounds};
use super::objective::{Linear, Objective, Refused, largest, rms};
use super::power::{Model, PNorm};
use super::program::{Aim, Program, Step};

/// A trust region smaller than this part of the largest error has collapsed.
const COLLAPSED: f64 = 1e-9;

/// A step must gain this part of what the model promises.
const WORTH: f64 = 0.05;

/// A step that gains less than this part leaves the linear model: the trust region shrinks, unless the
/// affine parameters bring more.
const GOOD: f64 = 0.4;

/// In a trust region smaller than this part of the largest error a descent crawls along a curved
/// valley. Mostly the formula is affine in all but one or two parameters, and a step in these takes
/// the others along: measured on the normalisation at one roughness, 3 to 60 steps for 800 and more.
const NARROW: f64 = 0.02;

/// What is minimised, under which constraints.
pub(super) struct Problem<'a> {
    pub objective: &'a Objective<'a>,
    pub bounds: Option<&'a Bounds<'a>>,
    /// None: the largest residual.
    pub norm: Option<PNorm>,
    /// Weight of the norm against violations; 1 without constraints.
    pub weight: f64,
    pub iterations: u64,
}

/// The outcome of one descent.
#[derive(Clone, Debug)]
pub(super) struct Descent {
    pub coefficients: Vec<f64>,
    /// weight * norm + violation, the norm of a p-norm being its mean power in units of `max`.
    pub merit: f64,
    pub max: f64,
    pub rms: f64,
    /// The norm that was asked for.
    pub value: f64,
    /// Largest violation of a constraint, in units of residuals.
    pub violation: f64,
    /// What the last program could still have gained, as a part of the merit.
    pub gap: f64,
    /// Whether the programs found nothing more to gain, or next to nothing.
    pub optimal: bool,
    /// Whether a constraint stands in the way of less.
    pub bounded: bool,
    /// Whether the iterations were used up.
    pub capped: bool,
    pub evaluations: u64,
}

/// Everything at a point.
struct Here {
    linear: Linear,
    bounds: Option<LinearBounds>,
    model: Option<Model>,
}

impl<'a> Problem<'a> {
    /// A predicted decrease below this part of the merit is none. The programs' solutions are good
    /// to some 1e-6 of the largest error; the powers of a p-norm are flat at their minimum, so that
    /// coefficients are as good as the root of this.
    fn least_gain(&self) -> f64 {
        if self.norm.is_some() { 1e-13 } else { 1e-6 }
    }

    /// A descent that comes to a halt with no more than this left to gain, by the programs' own
    /// bound, has arrived: steps that promise less cannot be told from noise.
    fn arrived(&self) -> f64 {
        if self.norm.is_some() { 1e-9 } else { 1e-4 }
    }

    fn here(&self, p: &[f64]) -> Result<Here, Refused> {
        let linear = self.objective.linearise(p)?;
        let bounds = self.bounds.map(|b| b.linearise(p)).transpose()?;
        let model = self.norm.map(|norm| norm.scaled_model(&linear));
        Ok(Here { linear, bounds, model })
    }

    /// weight * norm + violation, powers in units of the model.
    fn merit(&self, here: &Here, residuals: &[f64], values: &[f64]) -> f64 {
        let norm = match (self.norm, &here.model) {
            (Some(norm), Some(model)) => norm.mean_power(model, residuals),
            _ => largest(residuals),
        };
        let worst = here.bounds.as_ref().map_or(0.0, |b| b.worst(values));
        if self.weight == 0.0 { worst } else { self.weight * norm + worst }
    }

    fn descent(&self, p: Vec<f64>, here: &Here) -> Descent {
        let residuals = &here.linear.residuals;
        let values = here.bounds.as_ref().map_or(&[][..], |b| &b.values);
        let (max, merit) = (largest(residuals), self.merit(here, residuals, values));
        Descent {
            coefficients: p,
            merit,
            max,
            rms: rms(residuals),
            value: self.norm.map_or(max, |norm| norm.of(residuals)),
            violation: here.bounds.as_ref().map_or(0.0, |b| b.worst(values)),
            gap: f64::INFINITY,
            optimal: merit == 0.0,
            bounded: false,
            capped: false,
            evaluations: 1,
        }
    }

    /// Descends from `start`.
    ///
    /// # Errors
    /// The start is refused.
    pub fn descend(&self, start: &[f64]) -> Result<Descent, Refused> {
        let mut here = self.here(start)?;
        let mut best = self.descent(start.to_vec(), &here);
        let mut radius = best.max.max(best.violation);
        let mut steps = 0;
        let affine = affine(self.objective.tape);
        while !best.optimal && steps < self.iterations {
            let aim = match (self.norm, &here.model) {
                (Some(norm), Some(model)) => Aim::Power(norm, model),
                _ => Aim::Largest,
            };
            let mut program = Program::new(aim, &here.linear, here.bounds.as_ref(), self.weight);
            let moved = loop {
                steps += 1;
                let Some(step) = program.step(radius) else { break None };
                best.bounded = step.bounded;
                // Only a step that the box does not hold back says how much is left to gain.
                let left = best.merit - step.bound;
                best.gap = if step.held { best.gap } else { (left / best.merit).max(0.0) };
                if left <= self.least_gain() * best.merit && !step.held {
                    best.optimal = true;
                    break None;
                }
                best.evaluations += 1;
                let affine = if radius < NARROW * best.max.max(best.violation) { &affine[..] } else { &[] };
                let (next, ratio) = self.attempt(&here, &best, &step, affine);
                radius = next_radius(radius, ratio, &step);
                if let Some(next) = next {
                    break Some(next);
                }
                if radius < COLLAPSED * best.max.max(best.violation) || steps >= self.iterations {
                    break None;
                }
            };
            let Some(coefficients) = moved else { break };
            here = self.here(&coefficients)?;
            let next = self.descent(coefficients, &here);
            best = Descent { gap: best.gap, evaluations: best.evaluations + 1, ..next };
        }
        best.optimal |= best.gap <= self.arrived();
        best.capped = !best.optimal && steps >= self.iterations;
        Ok(best)
    }

    /// Where a step leads, if it is worth taking, and the part of the predicted gain that it
    /// brought.
    fn attempt(&self, here: &Here, best: &Descent, step: &Step, affine: &[usize]) -> (Option<Vec<f64>>, f64) {
        let promised = best.merit - step.predicted;
        if promised <= 0.0 {
            return (None, -1.0);
        }
        let next: Vec<f64> = best.coefficients.iter().zip(&step.step).map(|(p, d)| p + d).collect();
        let Some(merit) = self.reached(here, &next) else { return (None, -1.0) };
        let ratio = |merit: f64| (best.merit - merit) / promised;
        let (mut next, mut reached) = (next, ratio(merit));
        if reached < GOOD
            && let Some(lower) = self.lowered(&next, affine)
            && let Some(merit) = self.reached(here, &lower)
            && ratio(merit) > reached
        {
            (next, reached) = (lower, ratio(merit));
        }
        ((reached > WORTH).then_some(next), reached)
    }

    fn reached(&self, here: &Here, p: &[f64]) -> Option<f64> {
        let residuals = self.objective.residuals(p).ok()?;
        let values = self.bounds.map_or(Ok(Vec::new()), |b| b.values(p)).ok()?;
        Some(self.merit(here, &residuals, &values))
    }

    /// The lowest point that differs from another in the parameters alone in which the formula is
    /// affine: the program of a step is exact there. None where there are no others, or the norm is a
    /// power.
    fn lowered(&self, p: &[f64], affine: &[usize]) -> Option<Vec<f64>> {
        if self.norm.is_some() || affine.is_empty() || affine.len() == p.len() {
            return None;
        }
        let here = self.here(p).ok()?;
        let linear = here.linear.only(affine);
        let bounds = here.bounds.as_ref().map(|bounds| bounds.only(affine));
        let violation = bounds.as_ref().map_or(0.0, |b| b.worst(&b.values));
        // Without constraints no step to the lowest point moves a residual farther than from one side to
        // the other.
        let radius = 2.0 * largest(&linear.residuals).max(violation);
        let step = Program::new(Aim::Largest, &linear, bounds.as_ref(), self.weight).step(radius)?.step;
        let mut next = p.to_vec();
        affine.iter().zip(&step).for_each(|(&i, d)| next[i] += d);
        Some(next)
    }
}

/// Larger after good steps, smaller after bad ones.
fn next_radius(radius: f64, ratio: f64, step: &Step) -> f64 {
    if ratio > 0.75 && step.held {
        2.0 * radius
    } else if ratio < 0.0 {
        0.25 * radius
    } else if ratio < GOOD {
        0.5 * radius
    } else {
        radius
    }
}
