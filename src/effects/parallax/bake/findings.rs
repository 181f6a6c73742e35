//! What the bake of lookups found out, for their page.

use super::Lobe;
use super::entries::place;
use super::lookups::Lookup;
use crate::approximate::{Fit, FitStageError};
use crate::data::Source;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::page::left_out;
use crate::effects::parallax::results::{
    ChainFinding, ParallaxCurve, ParallaxFindings, ParallaxLobe, ParallaxMap, VariationFinding, VariationRow,
};
use crate::effects::parallax::{Cell, LevelFunction, Spread, Variation};
use crate::report::{ApproximationFinding, EffectFinding, Field, Ruler};
use lobefit_shade::code::{self, Language};
use lobefit_truth::quantity::footprint::Measures;

/// Published formulas that have maps and curves.
const SHOWN: [&str; 2] = ["parallax_frostbite", "parallax_scaled"];

/// Rows of the grid that have curves: every fourth or so of nineteen.
const CURVES: [usize; 5] = [0, 4, 8, 12, 18];

/// The name of the best widths where formulas stand.
const BEST: &str = "best width";

/// The findings of the effect.
pub(super) fn findings(
    effect: &EffectFinding,
    lobes: &[Lobe],
    context: &Context,
) -> Result<ParallaxFindings, BakeError> {
    Ok(ParallaxFindings {
        origin: context.origin(),
        effect: effect.clone(),
        left_out: lobes.iter().flat_map(|lobe| left_out(&lobe.dropped)).collect(),
        lobes: lobes.iter().map(of_lobe).collect::<Result<_, _>>()?,
    })
}

fn of_lobe(lobe: &Lobe) -> Result<ParallaxLobe, BakeError> {
    let shown = shown(lobe);
    let widths =
        |fit: &Fit| lobe.grid.widths(&fit.hypothesis, &fit.coefficients()).map_err(FitStageError::from);
    let widths = shown.iter().map(|fit| widths(fit)).collect::<Result<Vec<_>, _>>()?;
    let named: Vec<(&Fit, &[f64])> = shown.iter().copied().zip(widths.iter().map(Vec::as_slice)).collect();
    let mut variations: Vec<VariationFinding> = lobe.measured().map(|(fit, v)| of_fit(fit, v)).collect();
    variations.push(VariationFinding {
        name: BEST.into(),
        published: false,
        ops: None,
        nearer: lobe.least.nearer.map(row),
        farther: lobe.least.farther.map(row),
    });
    let saturated = lobe.grid.cells.iter().filter(|cell| cell.saturated);
    Ok(ParallaxLobe {
        kernel: lobe.spec.kernel.name().into(),
        formula: lobe.spec.kernel.formula().into(),
        approximations: lobe.fits.iter().map(|f| ApproximationFinding::from(&f.approximation)).collect(),
        variations,
        saturated: saturated.map(|cell| (cell.roughness, cell.rho)).collect(),
        least: least(lobe),
        maps: named.iter().map(|(fit, widths)| map(lobe, fit, widths)).collect::<Result<_, _>>()?,
        curves: CURVES.into_iter().map(|r| curve(lobe, r, &named)).collect(),
        chains: lobe.functions.iter().map(chain).collect(),
        lookups: lobe.lookups.iter().map(Lookup::finding).collect(),
    })
}

/// Published formulas that people know, and the best of ours; without any, the one of lookups.
fn shown<'a>(lobe: &'a Lobe) -> Vec<&'a Fit> {
    let of_published = |name: &&str| lobe.fits.iter().find(|fit| fit.approximation.name == **name);
    let published: Vec<&Fit> = SHOWN.iter().filter_map(of_published).collect();
    let cheapest = lobe.fits.iter().filter(|fit| fit.emitted).min_by_key(|fit| fit.approximation.cost.ops);
    let best = lobe.best().filter(|best| {
        cheapest.is_none_or(|cheapest| cheapest.approximation.name != best.approximation.name)
    });
    let flow = lobe.flow().filter(|_| cheapest.is_none()).map(|(fit, _)| fit);
    published.into_iter().chain(cheapest).chain(best).chain(flow).collect()
}

fn of_fit(fit: &Fit, variation: &Variation) -> VariationFinding {
    VariationFinding {
        name: fit.approximation.name.clone(),
        published: fit.approximation.source != Source::Fitted,
        ops: Some(fit.approximation.cost.ops),
        nearer: variation.nearer.map(row),
        farther: variation.farther.map(row),
    }
}

fn row(spread: Spread) -> VariationRow {
    let Spread { mean, max, l2, largest, encircled, .. } = spread;
    VariationRow { mean, max, at: place(&spread), l2, largest, encircled }
}

/// What the best width leaves, in every measure.
fn least(lobe: &Lobe) -> Vec<Field> {
    let plane = |name: &str, of: fn(&Measures) -> f64| field(lobe, name, false, |_, cell| of(&cell.least));
    vec![
        plane("total variation", |least| least.tv),
        plane("root mean square difference", |least| least.l2),
        plane("largest difference", |least| least.max),
        plane("encircled energy", |least| least.encircled),
    ]
}

/// A field over the grid, roughness along x and rho along y.
fn field(lobe: &Lobe, name: &str, signed: bool, value: impl Fn(usize, &Cell) -> f64) -> Field {
    let (cells, columns) = (&lobe.grid.cells, super::GRID[0]);
    let rows = super::GRID[1];
    let at = |k: usize| (k % columns) * rows + k / columns;
    Field {
        name: name.into(),
        unit: String::new(),
        signed,
        x: Ruler {
            name: "roughness".into(),
            values: (0..columns).map(|i| cells[i * rows].roughness).collect(),
        },
        y: Ruler { name: "rho".into(), values: cells[..rows].iter().map(|cell| cell.rho).collect() },
        values: (0..cells.len()).map(at).map(|i| value(i, &cells[i]) as f32).collect(),
    }
}

fn map(lobe: &Lobe, fit: &Fit, widths: &[f64]) -> Result<ParallaxMap, BakeError> {
    let error = |i: usize, cell: &Cell| if cell.saturated { 0.0 } else { widths[i] / cell.best - 1.0 };
    let formula = match fit.emitted {
        true => code::print(Language::Wgsl, &fit.hypothesis, &fit.coefficients(), &[])?.text,
        false => String::new(),
    };
    Ok(ParallaxMap {
        name: fit.approximation.name.clone(),
        formula: formula.trim_end().to_string(),
        error: field(lobe, "relative error", true, error),
    })
}

fn curve(lobe: &Lobe, row: usize, named: &[(&Fit, &[f64])]) -> ParallaxCurve {
    let range = row * super::GRID[1]..(row + 1) * super::GRID[1];
    let cells = &lobe.grid.cells[range.clone()];
    ParallaxCurve {
        roughness: cells[0].roughness,
        rho: cells.iter().map(|cell| cell.rho).collect(),
        best: cells.iter().map(|cell| cell.best).collect(),
        fits: named
            .iter()
            .map(|(fit, widths)| (fit.approximation.name.clone(), widths[range.clone()].to_vec()))
            .collect(),
    }
}

fn chain(function: &LevelFunction) -> ChainFinding {
    ChainFinding {
        function: function.hypothesis.name().to_string(),
        chain: function.chain.text(),
        gives: function.gives.name().into(),
        ops: function.hypothesis.tape().cost_ops(),
        max: function.error.max,
        at: function.error.at.clone(),
    }
}
