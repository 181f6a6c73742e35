//! What the bake of the couplings found out, for their page.

use super::bake::Lobe;
use super::grid::Factors;
use crate::approximate::Fit;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::coupling::results::{
    AnyF0Finding, CouplingCurves, CouplingFindings, CouplingFurnace, CouplingLobe, CouplingPanel,
    CouplingReciprocity,
};
use crate::effects::grid::{Grid, chosen, grazing};
use crate::effects::page::{self, left_out};
use crate::effects::selection::{Selected, selected};
use crate::report::{ApproximationFinding, EffectFinding, FitFinding, FurnaceRow};
use lobefit_truth::quantity::{COUPLING, Specular};

/// Cosines of spheres.
const RADII: usize = 40;

/// Roughness of the curves, and of the furnace's spheres, as far as they lie in the region.
const CURVES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 1.0];
const SPHERES: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

/// f0 of the furnaces: water, glass, a gem, and a metal's limit.
const FURNACES: [f64; 4] = [0.02, 0.04, 0.2, 1.0];

/// The factor 1: the base added to the lobe.
const NONE: &str = "coupling_none";

/// Published factors that have rows of spheres.
const SHOWN: [&str; 4] = [NONE, "coupling_fresnel", "coupling_gltf", "coupling_pesce"];

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 10.0;

/// The findings of the effect.
pub fn findings(
    effect: &EffectFinding,
    lobes: &[Lobe],
    context: &Context,
) -> Result<CouplingFindings, BakeError> {
    let first = lobes.first().ok_or_else(|| BakeError::Internal("a coupling without a job".into()))?;
    Ok(CouplingFindings {
        origin: context.origin(),
        effect: effect.clone(),
        left_out: lobes.iter().flat_map(|lobe| left_out(&lobe.dropped)).collect(),
        curves: curves(first, context)?,
        lobes: lobes.iter().map(|lobe| of_lobe(lobe, context)).collect::<Result<_, _>>()?,
    })
}

/// The factors under every kind of lobe beside 1 - Fresnel, at the middle f0.
fn curves(lobe: &Lobe, context: &Context) -> Result<CouplingCurves, BakeError> {
    let (region, f0) = (&lobe.spec.region, 0.5 * (lobe.spec.f0[0] + lobe.spec.f0[1]));
    let truth = Factors::new(lobe.spec.smith, Grid::curves(region, &CURVES), context)?;
    let grid = &truth.grid;
    let factors = Specular::ALL.map(|s| (s.name(), grid.by_roughness(&truth.at(s, f0))));
    let panel = |(k, roughness): (usize, &f64)| CouplingPanel {
        roughness: *roughness,
        factors: factors.iter().map(|(name, all)| (name.to_string(), all[k].clone())).collect(),
    };
    let fresnel = |mu: &f64| {
        let x = 1.0 - mu;
        (1.0 - f0) * (1.0 - x * x * x * x * x)
    };
    Ok(CouplingCurves {
        f0,
        mu: grid.mu.values.clone(),
        fresnel: grid.mu.values.iter().map(fresnel).collect(),
        panels: grid.roughness.values.iter().enumerate().map(panel).collect(),
    })
}

fn of_lobe(lobe: &Lobe, context: &Context) -> Result<CouplingLobe, BakeError> {
    let (spec, region) = (&lobe.spec, &lobe.spec.region);
    let map = Factors::new(spec.smith, Grid::map(region), context)?;
    let lines = Factors::new(spec.smith, Grid::curves(region, &CURVES), context)?;
    let shown = selected(&lobe.fits, "factor", COUPLING, context);
    let any = |(fit, any): (&Fit, &crate::effects::coupling::AnyF0)| AnyF0Finding {
        name: fit.approximation.name.clone(),
        max: any.max,
        at: any.at.clone(),
        places: any.places,
        looked_at: any.f0.words(),
    };
    let f0 = spec.f0[0];
    let truth = map.at(spec.specular, f0);
    let fits = shown.iter().map(|one| fit_finding(lobe, one, (&map, &truth), &lines));
    let (table, table_anywhere) = super::table::of_published(lobe, context)?;
    let formulas = lobe.fits.iter().map(|f| ApproximationFinding::from(&f.approximation));
    Ok(CouplingLobe {
        specular: spec.specular.name().into(),
        multiplier: spec.specular.formula().into(),
        f0,
        truth: map.grid.field("factor", false, truth.iter().copied()),
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
    (map, truth): (&Factors, &[f64]),
    lines: &Factors,
) -> Result<FitFinding, BakeError> {
    let (specular, f0, map) = (lobe.spec.specular, lobe.spec.f0[0], &map.grid);
    let errors = map.values(one.fit, f0)?.into_iter().zip(truth).map(|(value, truth)| value - truth);
    let curves = lines.grid.lines(&lines.at(specular, f0), &lines.grid.values(one.fit, f0)?);
    page::fit(one, format!("factor at f0 = {f0}"), curves, map.field("factor", true, errors))
}

/// Spheres of lobe and white base together, the lobe exact: without coupling, with published
/// factors, and with ours of the frontier.
fn furnace(lobe: &Lobe, shown: &[Selected], context: &Context) -> Result<CouplingFurnace, BakeError> {
    let (spec, region) = (&lobe.spec, &lobe.spec.region);
    let spheres = Grid::new(region, chosen(region, &SPHERES), grazing(region, RADII));
    let exact = Factors::new(spec.smith, spheres, context)?;
    let grid = &exact.grid;
    let of_published = |name: &&str| lobe.fits.iter().find(|f| f.approximation.name == **name);
    let published = SHOWN.iter().filter_map(of_published);
    let ours = [shown.first(), shown.last()];
    let ours = ours.into_iter().take(shown.len()).flatten().map(|one| one.fit);
    let rows: Vec<&Fit> = published.chain(ours).collect();
    let at = |f0: &f64| -> Result<(f64, Vec<FurnaceRow>), BakeError> {
        let truth = exact.at(spec.specular, *f0);
        let row = |fit: &&Fit| {
            let total: Vec<f64> =
                grid.values(fit, *f0)?.into_iter().zip(&truth).map(|(v, t)| 1.0 + v - t).collect();
            let of = fit.approximation.name.clone();
            let name = if of == NONE { "uncoupled".into() } else { of.clone() };
            Ok(FurnaceRow { of, name, factors: grid.by_roughness(&total) })
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
