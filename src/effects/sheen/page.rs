//! What the bake of the sheen found out, for its page.

use rayon::prelude::*;

use crate::approximate::{Dropped, Fit, FitStageError, PointSet, Region};
use crate::data::Use;
use crate::effects::context::Context;
use crate::effects::reflection::bake::{chosen, grazing, left_out, selected};
use crate::effects::{BakeError, origin};
use crate::plan::Effect;
use crate::report::{ApproximationFinding, EffectFinding, Field, Findings, FitCurve, FitFinding, Ruler};
use crate::scene::Scene;
use lobefit_shade::code::{self, Language};
use lobefit_truth::integrate::sheen::albedo;

/// Side of the maps' grids.
const MAP: usize = 64;

/// Roughness of the curves, as far as they lie in the region, and cosines of each.
const CURVES: [f64; 5] = [0.1, 0.2, 0.3, 0.5, 1.0];
const COSINES: usize = 64;

/// The findings of the effect.
pub fn findings(
    scene: &Scene,
    region: &Region,
    called: &Effect,
    fits: &[Fit],
    dropped: &[Dropped],
    context: &Context,
) -> Result<Findings, BakeError> {
    let even = Ruler::even("roughness", region.roughness[0], region.roughness[1], MAP);
    let map = Grid::new(region, even, grazing(region, MAP), context);
    let curves = Grid::new(region, chosen(region, &CURVES), grazing(region, COSINES), context);
    let shown = selected(fits, Use::Value);
    let finding = |one: &crate::effects::reflection::bake::Selected| -> Result<FitFinding, BakeError> {
        let fit = one.fit;
        Ok(FitFinding {
            name: fit.approximation.name.clone(),
            shown_as: one.because.into(),
            formula: code::print(Language::Wgsl, &fit.hypothesis, &fit.coefficients(), &[])?
                .text
                .trim_end()
                .to_string(),
            value: "E".into(),
            curves: curves.curves(fit)?,
            error: map.error(fit)?,
        })
    };
    Ok(Findings {
        origin: origin(scene, context),
        effects: vec![effect(called, fits)],
        left_out: left_out(dropped),
        tables: Vec::new(),
        truths: vec![map.field("E", false, map.truth.iter().copied())],
        approximations: fits.iter().map(|f| ApproximationFinding::from(&f.approximation)).collect(),
        fits: shown.iter().map(finding).collect::<Result<_, _>>()?,
        averages: None,
        furnace: None,
        studies: Vec::new(),
    })
}

fn effect(called: &Effect, fits: &[Fit]) -> EffectFinding {
    let errors = fits.iter().filter(|f| f.emitted).map(|f| f.approximation.certificate.max_abs);
    EffectFinding {
        effect: called.effect.name().into(),
        because: called.because.clone(),
        ranges: called.ranges.iter().map(|(name, range)| (name.to_string(), *range)).collect(),
        approximation: called.approximation.clone(),
        expected_error: called.expected_error,
        measured_error: errors.reduce(f64::min),
        metric: "error of E of the best fit".into(),
    }
}

/// The truth over a grid of roughness and mu.
struct Grid {
    roughness: Ruler,
    mu: Ruler,
    points: PointSet,
    truth: Vec<f64>,
}

impl Grid {
    fn new(region: &Region, roughness: Ruler, mu: Ruler, context: &Context) -> Grid {
        let mut points = PointSet::default();
        for m in &mu.values {
            for r in &roughness.values {
                points.push(region, *r, *m);
            }
        }
        context.counter.add(points.len());
        let inputs: Vec<(f32, f32)> = points.alpha.iter().copied().zip(points.mu.iter().copied()).collect();
        let truth =
            inputs.par_iter().map(|(alpha, mu)| albedo(f64::from(*alpha), f64::from(mu.min(1.0)))).collect();
        Grid { roughness, mu, points, truth }
    }

    /// A field over the grid, roughness along x and mu along y.
    fn field(&self, name: &str, signed: bool, values: impl Iterator<Item = f64>) -> Field {
        Field {
            name: name.into(),
            unit: String::new(),
            signed,
            x: self.roughness.clone(),
            y: self.mu.clone(),
            values: values.map(|v| v as f32).collect(),
        }
    }

    fn error(&self, fit: &Fit) -> Result<Field, BakeError> {
        let values = values(fit, &self.points)?;
        Ok(self.field("E", true, values.iter().zip(&self.truth).map(|(value, truth)| value - truth)))
    }

    /// E and its fit over mu, one per roughness.
    fn curves(&self, fit: &Fit) -> Result<Vec<FitCurve>, BakeError> {
        let values = values(fit, &self.points)?;
        let columns = self.roughness.values.len();
        let column = |all: &[f64], k: usize| all.iter().skip(k).step_by(columns).copied().collect();
        let curve = |k: usize| FitCurve {
            roughness: self.roughness.values[k],
            mu: self.mu.values.clone(),
            truth: column(&self.truth, k),
            fit: column(&values, k),
        };
        Ok((0..columns).map(curve).collect())
    }
}

fn values(fit: &Fit, points: &PointSet) -> Result<Vec<f64>, BakeError> {
    Ok(fit.values(points).map_err(FitStageError::from)?.into_iter().map(f64::from).collect())
}
