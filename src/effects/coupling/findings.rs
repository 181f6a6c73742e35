//! What the bake of the couplings found out, for their page.

use super::bake::Lobe;
use super::grid::Grid;
use crate::approximate::Fit;
use crate::data::Use;
use crate::effects::context::Context;
use crate::effects::coupling::results::{
    AnyF0Finding, CouplingCurves, CouplingFindings, CouplingFurnace, CouplingLobe, CouplingPanel,
    CouplingReciprocity,
};
use crate::effects::reflection::bake::{Selected, chosen, grazing, left_out, selected};
use crate::effects::{BakeError, origin};
use crate::plan::Effect;
use crate::report::{ApproximationFinding, EffectFinding, FitFinding, FurnaceRow, Ruler};
use crate::scene::Scene;
use lobefit_shade::code::{self, Language};
use lobefit_truth::integrate::coupling::Specular;

/// Side of the maps' grids.
const MAP: usize = 64;

/// Cosines of curves, and of spheres.
const COSINES: usize = 64;
const RADII: usize = 40;

/// Roughness of the curves, and of the furnace's spheres, as far as they lie in the region.
const CURVES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 1.0];
const SPHERES: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

/// f0 of the furnaces: water, glass, a gem, and a metal's limit.
const FURNACES: [f64; 4] = [0.02, 0.04, 0.2, 1.0];

/// Published factors that have rows of spheres.
const SHOWN: [&str; 4] = ["coupling_none", "coupling_fresnel", "coupling_gltf", "coupling_pesce"];

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 10.0;

/// The findings of the effect.
pub fn findings(
    scene: &Scene,
    lobes: &[Lobe],
    called: &Effect,
    context: &Context,
) -> Result<CouplingFindings, BakeError> {
    let first = lobes.first().ok_or_else(|| BakeError::Internal("a coupling without a job".into()))?;
    Ok(CouplingFindings {
        origin: origin(scene, context),
        effect: effect(called, lobes),
        left_out: lobes.iter().flat_map(|lobe| left_out(&lobe.dropped)).collect(),
        curves: curves(first, context),
        lobes: lobes.iter().map(|lobe| of_lobe(lobe, context)).collect::<Result<_, _>>()?,
    })
}

/// The factors under every kind of lobe beside 1 - Fresnel, at the middle f0.
fn curves(lobe: &Lobe, context: &Context) -> CouplingCurves {
    let (region, f0) = (&lobe.spec.region, 0.5 * (lobe.spec.f0[0] + lobe.spec.f0[1]));
    let grid = Grid::new(lobe.spec.smith, region, chosen(region, &CURVES), grazing(region, COSINES), context);
    let factors = Specular::ALL.map(|s| (s.name(), grid.by_roughness(&grid.factors(s, f0))));
    let panel = |(k, roughness): (usize, &f64)| CouplingPanel {
        roughness: *roughness,
        factors: factors.iter().map(|(name, all)| (name.to_string(), all[k].clone())).collect(),
    };
    let fresnel = |mu: &f64| {
        let x = 1.0 - mu;
        (1.0 - f0) * (1.0 - x * x * x * x * x)
    };
    CouplingCurves {
        f0,
        mu: grid.mu.values.clone(),
        fresnel: grid.mu.values.iter().map(fresnel).collect(),
        panels: grid.roughness.values.iter().enumerate().map(panel).collect(),
    }
}

fn of_lobe(lobe: &Lobe, context: &Context) -> Result<CouplingLobe, BakeError> {
    let (spec, region) = (&lobe.spec, &lobe.spec.region);
    let even = Ruler::even("roughness", region.roughness[0], region.roughness[1], MAP);
    let map = Grid::new(spec.smith, region, even, grazing(region, MAP), context);
    let lines = Grid::new(spec.smith, region, chosen(region, &CURVES), grazing(region, COSINES), context);
    let shown = selected(&lobe.fits, Use::Coupling);
    let any = |(fit, any): (&Fit, &crate::effects::coupling::AnyF0)| AnyF0Finding {
        name: fit.approximation.name.clone(),
        max: any.max,
        at: any.at.clone(),
        places: any.places,
        looked_at: any.f0.words(),
    };
    let f0 = spec.f0[0];
    let truth = map.factors(spec.specular, f0);
    let fits = shown.iter().map(|one| fit_finding(lobe, one, (&map, &truth), &lines));
    let (table, table_anywhere) = super::table::rival(lobe, context)?;
    let formulas = lobe.fits.iter().map(|f| ApproximationFinding::from(&f.approximation));
    Ok(CouplingLobe {
        specular: spec.specular.name().into(),
        multiplier: spec.specular.formula().into(),
        f0,
        truth: map.field("factor", false, truth.iter().copied()),
        approximations: formulas.chain([table]).collect(),
        anywhere: lobe.measured().map(any).chain([table_anywhere]).collect(),
        fits: fits.collect::<Result<_, _>>()?,
        furnace: furnace(lobe, &shown, context)?,
        reciprocity: super::reciprocity::rows(lobe)?
            .map(|(places, rows)| CouplingReciprocity { places, rows }),
    })
}

/// A fit at the smallest f0 of the scene, where a factor is largest.
fn fit_finding(
    lobe: &Lobe,
    one: &Selected,
    (map, truth): (&Grid, &[f64]),
    lines: &Grid,
) -> Result<FitFinding, BakeError> {
    let (fit, specular, f0) = (one.fit, lobe.spec.specular, lobe.spec.f0[0]);
    let errors = map.values(fit, f0)?.into_iter().zip(truth).map(|(value, truth)| value - truth);
    let formula = code::print(Language::Wgsl, &fit.hypothesis, &fit.coefficients(), &[])?;
    Ok(FitFinding {
        name: fit.approximation.name.clone(),
        shown_as: one.because.into(),
        formula: formula.text.trim_end().to_string(),
        value: format!("factor at f0 = {f0}"),
        curves: lines.curves(fit, specular, f0)?,
        error: map.field("factor", true, errors),
    })
}

/// Spheres of lobe and white base together, the lobe exact: without coupling, with published factors, and with ours of the frontier.
fn furnace(lobe: &Lobe, shown: &[Selected], context: &Context) -> Result<CouplingFurnace, BakeError> {
    let (spec, region) = (&lobe.spec, &lobe.spec.region);
    let grid = Grid::new(spec.smith, region, chosen(region, &SPHERES), grazing(region, RADII), context);
    let of_rival = |name: &&str| lobe.fits.iter().find(|f| f.approximation.name == **name);
    let rivals = SHOWN.iter().filter_map(of_rival);
    let ours = [shown.first(), shown.last()];
    let ours = ours.into_iter().take(shown.len()).flatten().map(|one| one.fit);
    let rows: Vec<&Fit> = rivals.chain(ours).collect();
    let at = |f0: &f64| -> Result<(f64, Vec<FurnaceRow>), BakeError> {
        let truth = grid.factors(spec.specular, *f0);
        let row = |fit: &&Fit| {
            let total: Vec<f64> =
                grid.values(fit, *f0)?.into_iter().zip(&truth).map(|(v, t)| 1.0 + v - t).collect();
            Ok(FurnaceRow { name: fit.approximation.name.clone(), factors: grid.by_roughness(&total) })
        };
        Ok((*f0, rows.iter().map(row).collect::<Result<_, BakeError>>()?))
    };
    Ok(CouplingFurnace {
        roughness: grid.roughness.values.clone(),
        mu: grid.mu.values.clone(),
        amplification: AMPLIFICATION,
        panels: FURNACES.iter().map(at).collect::<Result<_, _>>()?,
    })
}

fn effect(called: &Effect, lobes: &[Lobe]) -> EffectFinding {
    let best = |lobe: &Lobe| {
        let emitted = lobe.fits.iter().filter(|f| f.emitted);
        emitted.map(|f| f.approximation.certificate.max_abs).reduce(f64::min)
    };
    EffectFinding {
        effect: called.effect.name().into(),
        because: called.because.clone(),
        ranges: called.ranges.iter().map(|(name, range)| (name.to_string(), *range)).collect(),
        approximation: called.approximation.clone(),
        expected_error: called.expected_error,
        measured_error: lobes.iter().filter_map(best).reduce(f64::max),
        metric: "error of the factor of the best fit, under the lobe where that is largest".into(),
    }
}
