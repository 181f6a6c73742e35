//! The best width and the formulas beside it.

use crate::effects::parallax::results::{ParallaxCurve, ParallaxLobe};
use crate::report::sections::{figures, words};
use crate::report::{Block, Curves, HeatMap, ReportError, Section, Series, Spread, Style, check, numbers};

pub(super) fn section(lobe: &ParallaxLobe) -> Result<Section, ReportError> {
    for curve in &lobe.curves {
        check::increasing("widths", "rho", &curve.rho)?;
        for (name, values) in &curve.fits {
            check::size("widths", name, values.len(), curve.rho.len())?;
        }
    }
    let charts: Vec<Curves> = lobe.curves.iter().map(chart).collect();
    let caption = "α′ over ρ: the best width heavy, formulas in colour. At ρ = 1 nothing is to be corrected; α′ = 1 is the widest \
                   lobe that there is.";
    let mut blocks = vec![figures(&charts, caption)?];
    let fields: Vec<_> = lobe.maps.iter().map(|map| words::labelled(&map.error)).collect();
    let maps: Vec<HeatMap> = lobe
        .maps
        .iter()
        .zip(&fields)
        .map(|(map, field)| HeatMap {
            marks: lobe.saturated.clone(),
            size: (330.0, 250.0),
            ..HeatMap::of(&map.name, field)
        })
        .collect();
    let caption = "Relative error of α′ against the best width: red is too blurred, blue too sharp; each map has a scale of its own. \
                   Rings: saturated, excluded from every fit.";
    blocks.push(figures(&maps, caption)?);
    for map in lobe.maps.iter().filter(|map| !map.formula.is_empty()) {
        blocks.push(Block::Code { text: map.formula.clone() });
    }
    Ok(Section::new(
        "widths",
        "The width to fetch",
        "The best width makes the expected squared error least over images whose spectrum falls as 1/f²: the L2 norm, over the \
               logarithm of the wall radius, of the difference of the energies within that radius.",
        blocks,
    ))
}

fn chart(curve: &ParallaxCurve) -> Curves {
    let points = |values: &[f64]| curve.rho.iter().copied().zip(values.iter().copied()).collect();
    let line = |name: &str, values: &[f64], style: Style| Series::line(name, points(values), style);
    let mut series = vec![line("best width", &curve.best, Style::Truth)];
    let fits = curve.fits.iter().enumerate();
    series.extend(fits.map(|(i, (name, values))| line(name, values, Style::Line(i))));
    let title = format!("roughness {}", numbers::place(curve.roughness));
    Curves::new(title, [("ρ", Spread::Log), ("α′", Spread::Log)], series, (340.0, 220.0))
}
