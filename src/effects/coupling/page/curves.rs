//! The factor beside 1 - Fresnel, with and without light that is scattered more than once.

use crate::effects::coupling::results::{CouplingCurves, CouplingPanel};
use crate::report::sections::{figures, words};
use crate::report::{Curves, Panel, ReportError, Section, Series, Style, check, numbers};

pub(super) fn section(curves: &CouplingCurves) -> Result<Section, ReportError> {
    let (section, mu) = ("coupling curves", &curves.mu);
    check::increasing(section, "mu", mu)?;
    check::size(section, "fresnel", curves.fresnel.len(), mu.len())?;
    for (name, factors) in curves.panels.iter().flat_map(|panel| &panel.factors) {
        check::size(section, name, factors.len(), mu.len())?;
    }
    let panels = curves.panels.iter().enumerate();
    let charts = panels.map(|(i, panel)| Panel { chart: chart(curves, panel), legend: i == 0 });
    let charts: Vec<Panel> = charts.collect();
    let caption = format!(
        "True factors at f0 = {}, against 1 − F(μ) (heavy), which sees the macroscopic normal alone and is what a smooth surface \
         leaves. The rougher the surface, the flatter the factor: facets are never seen at grazing. Under a bare lobe \
         (single) the factor is larger, since the base also gets what that lobe loses between facets: larger than under a compensated one by less \
         than f0 (1 − E), so that at small f0 the two lines coincide.",
        numbers::place(curves.f0)
    );
    Ok(Section::new(
        "factor",
        "The factor against 1 − Fresnel",
        "A lobe that is divided by its albedo E (normalised) leaves (1 − f0)(1 − B/E); one that is multiplied by 1 + f0 (1/E − 1) \
               (compensated) and a bare one (single) leave more.",
        vec![figures(&charts, &caption)?],
    ))
}

fn chart(curves: &CouplingCurves, panel: &CouplingPanel) -> Curves {
    let points = |values: &[f64]| curves.mu.iter().copied().zip(values.iter().copied()).collect();
    let line = |name: &str, values: &[f64], style: Style| Series::line(name, points(values), style);
    let mut series = vec![line("1 − F(μ)", &curves.fresnel, Style::Truth)];
    let factors = panel.factors.iter().enumerate();
    series.extend(factors.map(|(i, (name, values))| line(name, values, Style::Line(i))));
    let title = format!("roughness {}", numbers::place(panel.roughness));
    let chart = Curves::linear(title, [&words::axis("mu"), "factor"], series, (300.0, 190.0));
    Curves { y_limits: Some((0.0, 1.0)), ..chart }
}
