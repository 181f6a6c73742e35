//! What accuracy costs offline: error against evaluations.

use super::figures;
use crate::report::numbers::{brief, grouped, significant};
use crate::report::{
    Annotation, Block, Curves, Marked, ReportError, Section, Series, Spread, Study, StudySeries, Style, check,
};

/// What a mark on the foot of a logarithmic chart means.
pub(super) const TRIANGLE: &str = " A triangle on the foot is an error of exactly 0.";

/// Where those who measure put errors that are only rounding of f64.
pub(super) const FLOOR: f64 = 1e-16;

/// Errors below are rounding of f64, whatever the integrator.
pub(super) const ROUNDED: f64 = 1e-14;

/// What a point there means.
pub(super) const ROUNDING: &str = " A point at 10⁻¹⁶ agrees with the truth but for the rounding of f64.";

pub(super) fn section(studies: &[Study]) -> Result<Option<Section>, ReportError> {
    if studies.is_empty() {
        return Ok(None);
    }
    let charts: Vec<Curves> = studies.iter().map(chart).collect::<Result<_, _>>()?;
    let exact = studies.iter().flat_map(|s| &s.series).any(|s| s.error.contains(&0.0));
    let rounding = studies.iter().flat_map(|s| &s.series).any(|s| s.error.contains(&FLOOR));
    let caption = format!(
        "Absolute error against evaluations of the integrand, both logarithmic. The grey guides fall as plain Monte Carlo \
         (−1/2) and as a perfect low-discrepancy rule (−1): a steeper line buys digits more cheaply.{}{}",
        if exact { TRIANGLE } else { "" },
        if rounding { ROUNDING } else { "" },
    );
    let mut blocks = vec![figures(&charts, &caption)?];
    for study in studies {
        if let Some(marked) = &study.marked {
            blocks.push(Block::Text { text: told(study, marked) });
        }
    }
    Ok(Some(Section {
        id: "accuracy".into(),
        title: "What accuracy costs offline".into(),
        lead: "How fast each integrator approaches the truth at an easy and at a hard point. Seconds differ from machine to \
               machine: the command lobefit cost measures them, and writes timings.html."
            .into(),
        blocks,
    }))
}

fn chart(study: &Study) -> Result<Curves, ReportError> {
    let section = format!("study {}", study.name);
    check::finite(&section, "alpha", study.alpha)?;
    check::finite(&section, "mu", study.mu)?;
    let series = study.series.iter().enumerate();
    let series = series.map(|(i, s)| line(&section, i, s)).collect::<Result<_, _>>()?;
    Ok(Curves {
        title: title(&study.name, study.alpha, study.mu),
        x: ("evaluations of the integrand".into(), Spread::Log),
        y: ("absolute error of E".into(), Spread::Log),
        series,
        annotations: study.marked.iter().flat_map(marks).collect(),
        guides: guides(),
        y_limits: None,
        size: (440.0, 340.0),
    })
}

fn line(section: &str, i: usize, s: &StudySeries) -> Result<Series, ReportError> {
    check::size(section, &format!("{}: error", s.name), s.error.len(), s.evaluations.len())?;
    errors(section, &s.name, &s.error)?;
    let points = s.evaluations.iter().map(|&n| n as f64).zip(s.error.iter().copied()).collect();
    Ok(Series { name: s.name.clone(), points, style: Style::Marked(i), end: None })
}

/// Magnitudes: finite and not negative.
pub(super) fn errors(section: &str, name: &str, errors: &[f64]) -> Result<(), ReportError> {
    check::values(section, &format!("{name}: error"), errors)?;
    match errors.iter().position(|&e| e < 0.0) {
        Some(i) => Err(check::domain(section, &format!("{name}: error[{i}]"), "must not be negative")),
        None => Ok(()),
    }
}

/// `hard point: α 0.01, μ 0.02`.
pub(super) fn title(name: &str, alpha: f64, mu: f64) -> String {
    format!("{name}: α {}, μ {}", brief(alpha, 3), brief(mu, 3))
}

/// The two rates that integrators are compared with.
pub(super) fn guides() -> Vec<(f64, String)> {
    vec![(-0.5, "slope −1/2".into()), (-1.0, "slope −1".into())]
}

fn marks(marked: &Marked) -> Vec<Annotation> {
    let x = marked.evaluations as f64;
    vec![
        Annotation { x, y: marked.noise, text: "path tracer: noise".into() },
        Annotation { x, y: marked.bias, text: "path tracer: bias".into() },
    ]
}

fn told(study: &Study, marked: &Marked) -> String {
    format!(
        "{}, {}: {} evaluations leave {} by noise and {} by bias (ringed).",
        study.name,
        marked.name,
        grouped(marked.evaluations),
        significant(marked.noise, 2),
        significant(marked.bias, 2),
    )
}
