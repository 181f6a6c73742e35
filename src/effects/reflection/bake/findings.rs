//! What the bake found out, for the report.

use super::pictures::Exact;
use crate::approximate::{Dropped, Fit, Region};
use crate::data::{Smith, Source, Use};
use crate::effects::context::Context;
use crate::effects::reflection::Reflection;
use crate::effects::selection::{Selected, selected};
use crate::effects::table::{BakedTable, finding};
use crate::effects::{BakeError, Made, Part, grid, page};
use crate::report::numbers::brief;
use crate::report::sections::words;
use crate::report::{ApproximationFinding, AverageFinding, Field, Findings, Furnace, Ruler, TableFinding};
use lobefit_truth::quantity::{GgxAverage, Quantity};

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 10.0;

/// f0 of the curves of a blend: a dielectric of index 1.5.
const DIELECTRIC: f64 = 0.04;

/// The findings of the effect; `region` is that of the fits.
pub fn findings(
    of: &Reflection,
    (made, region): (&Made, Option<Region>),
    (fits, dropped): (&[Fit], &[Dropped]),
    context: &Context,
) -> Result<Findings, BakeError> {
    let (smith, tables, effect) = (context.scene.smith, &made.tables[..], &made.part.finding);
    let lobe = (of.lobe, smith);
    let shown = selected(fits, "E", Use::NORMALISATION, context);
    let blends = selected(fits, "E", Use::F0_BLEND, context);
    let mut found = Findings::new(context.origin());
    if let Some(region) = &region {
        let map = Exact::map(lobe, region, false, context)?;
        let curves = Exact::curves(lobe, region, context)?;
        found.truths.push(map.albedo());
        for one in &shown {
            found.fits.push(page::fit(
                one,
                "N = 1/E".into(),
                curves.fit_curves(one.fit)?,
                map.furnace_error(one.fit)?,
            )?);
        }
        if !blends.is_empty() {
            let (map, curves) = (Exact::split_map(&map, context)?, Exact::split_map(&curves, context)?);
            let value = format!("f0 A + B at f0 = {DIELECTRIC}");
            // Curves are those of a dielectric, errors those at the worse end of f0.
            for one in &blends {
                let curves = curves.blend_curves(one.fit, DIELECTRIC)?;
                found.fits.push(page::fit(one, value.clone(), curves, map.blend_error(one.fit)?)?);
            }
        }
        found.averages = average_finding(smith, region, fits, context)?;
    } else if let Some(baked) = tables.first() {
        found.truths.push(Exact::map(lobe, &baked.region.flat(), false, context)?.albedo());
    }
    found.caption = found.truths.first().map_or_else(String::new, |field| landscape(of.ndf.name(), field));
    if let Some(region) = region {
        found.caption = format!("{} {}", found.caption, grid::beside_text(&region)).trim().into();
    }
    if let Some(region) = region.or_else(|| tables.first().map(|t| t.region.flat())) {
        found.furnace = Some(furnace_of(&Exact::furnace(lobe, &region, context)?, tables, &shown)?);
    }
    found.effects = vec![effect.clone()];
    found.left_out = page::left_out(dropped);
    found.tables = tables
        .iter()
        .filter_map(|t| table(of, t, &made.part, context).transpose())
        .collect::<Result<_, _>>()?;
    found.approximations = approximations(tables, fits);
    Ok(found)
}

/// What to see in the maps of the truth; a part of the domain need not show it.
fn landscape(ndf: &str, field: &Field) -> String {
    let ends = |r: &Ruler| [r.values[0], r.values[r.values.len() - 1]];
    let (roughness, mu) = (ends(&field.x), ends(&field.y));
    let valley = "1 for a smooth surface and at grazing view; between the two lies a valley along the diagonal where mu is \
                  about alpha, which never closes however smooth the surface. Polynomials cannot follow it.";
    if roughness[0] <= 0.1 && roughness[1] >= 0.9 && mu[0] <= 0.05 && mu[1] >= 0.9 {
        return format!("For the {ndf} lobe: E is {valley}");
    }
    format!(
        "The part of the domain that the scene spans: {} {} to {}, {} {} to {}. Over the whole domain E of the {ndf} lobe is \
         {valley} How much of that is seen here depends on the part.",
        words::symbol(&field.x.name),
        brief(roughness[0], 3),
        brief(roughness[1], 3),
        words::symbol(&field.y.name),
        brief(mu[0], 3),
        brief(mu[1], 3),
    )
}

/// Spheres of everything that compensates the lobe and is ours.
pub fn furnaces(
    of: &Reflection,
    tables: &[BakedTable],
    (region, fits): (Option<Region>, &[Fit]),
    context: &Context,
) -> Result<Vec<Furnace>, BakeError> {
    let Some(region) = region.or_else(|| tables.first().map(|t| t.region.flat())) else {
        return Ok(Vec::new());
    };
    let ours =
        |f: &&Fit| f.approximation.used_as == Use::NORMALISATION && f.approximation.source == Source::Fitted;
    let all: Vec<Selected> = fits.iter().filter(ours).map(|fit| Selected { fit, because: "" }).collect();
    Ok(vec![furnace_of(&Exact::furnace((of.lobe, context.scene.smith), &region, context)?, tables, &all)?])
}

fn furnace_of(grid: &Exact, tables: &[BakedTable], shown: &[Selected]) -> Result<Furnace, BakeError> {
    let mut rows = vec![grid.uncompensated()];
    for table in tables {
        rows.extend(grid.furnace_of_table(table)?);
    }
    for one in shown {
        rows.push(grid.furnace_of_fit(one.fit)?);
    }
    Ok(Furnace {
        roughness: grid.grid.roughness.values.clone(),
        mu: grid.grid.mu.values.clone(),
        rows,
        amplification: AMPLIFICATION,
    })
}

/// The fits of E_avg over roughness; none where the scene wants none.
fn average_finding(
    smith: Smith,
    region: &Region,
    fits: &[Fit],
    context: &Context,
) -> Result<Option<AverageFinding>, BakeError> {
    let ours: Vec<&Fit> = fits.iter().filter(|f| f.approximation.quantity == "ggx-average").collect();
    if ours.is_empty() {
        return Ok(None);
    }
    let of = (&GgxAverage as &dyn Quantity, "E_avg", smith.into());
    page::over_roughness(of, (region, &[]), &ours, context).map(Some)
}

fn approximations(tables: &[BakedTable], fits: &[Fit]) -> Vec<ApproximationFinding> {
    let fits = fits.iter().map(|f| &f.approximation);
    tables.iter().map(|t| &t.approximation).chain(fits).map(ApproximationFinding::from).collect()
}

fn table(
    of: &Reflection,
    baked: &BakedTable,
    part: &Part,
    context: &Context,
) -> Result<Option<TableFinding>, BakeError> {
    let map =
        Exact::map((of.lobe, context.scene.smith), &baked.region.flat(), baked.decode.has_bias(), context)?;
    Ok(finding(baked, part, map.lookup_errors(baked)?))
}

/// The error of what was baked, and what error that is.
pub fn measured(tables: &[BakedTable], fits: &[Fit]) -> (Option<f64>, &'static str) {
    let of_tables = tables.iter().map(|t| t.errors.lookup.max).reduce(f64::max);
    let of_fits = fits
        .iter()
        .filter(|f| f.emitted && f.approximation.used_as == Use::NORMALISATION)
        .map(|f| f.approximation.certificate.max_abs)
        .reduce(f64::min);
    match (of_tables, of_fits) {
        (Some(table), Some(fit)) => (
            Some(table.max(fit)),
            "the larger of the worst table's lookup error and the best normalisation's furnace error |E N − 1|",
        ),
        (Some(table), None) => (Some(table), "lookup error of the worst table"),
        (None, Some(fit)) => (Some(fit), "furnace error |E N − 1| of the best normalisation"),
        (None, None) => (None, "neither a table nor a normalisation was made"),
    }
}
