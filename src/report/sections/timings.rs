//! The page of measured times.

use super::{figures, study, words};
use crate::report::{
    Bar, Bars, Block, Curves, Dot, Page, ReportError, Scatter, Section, Series, Spread, Style, TimedPoint,
    TimedSeries, Timings, check,
};

pub(super) fn page(timings: &Timings) -> Result<Page, ReportError> {
    let mut sections = Vec::new();
    if !timings.points.is_empty() {
        sections.push(offline(timings)?);
    }
    if !timings.evaluations.is_empty() {
        sections.push(run_time(timings)?);
    }
    Ok(Page {
        title: format!("lobefit timings: {}", timings.origin.scene),
        origin: timings.origin.clone(),
        lead: format!(
            "What accuracy costs in time, measured on {}. Times differ from run to run and from machine to machine: \
             compare them with one another, not with another page.",
            timings.device
        ),
        sections,
    })
}

fn offline(timings: &Timings) -> Result<Section, ReportError> {
    let charts: Vec<Curves> = timings.points.iter().map(chart).collect::<Result<_, _>>()?;
    let caption = "Absolute error against seconds for one point, both logarithmic. A triangle on the foot is an error of \
                   exactly 0.";
    Ok(Section {
        id: "offline".into(),
        title: "Offline: error against seconds".into(),
        lead: "How long each integrator takes to an accuracy, at an easy and at a hard point.".into(),
        blocks: vec![figures(&charts, caption)?],
    })
}

fn chart(point: &TimedPoint) -> Result<Curves, ReportError> {
    let section = format!("timings {}", point.name);
    check::finite(&section, "alpha", point.alpha)?;
    check::finite(&section, "mu", point.mu)?;
    let series = point.series.iter().enumerate();
    let series = series.map(|(i, s)| line(&section, i, s)).collect::<Result<_, _>>()?;
    Ok(Curves {
        title: study::title(&point.name, point.alpha, point.mu),
        x: ("seconds".into(), Spread::Log),
        y: ("absolute error of E".into(), Spread::Log),
        series,
        annotations: Vec::new(),
        guides: study::guides(),
        y_limits: None,
        size: (440.0, 340.0),
    })
}

fn line(section: &str, i: usize, s: &TimedSeries) -> Result<Series, ReportError> {
    check::size(section, &format!("{}: error", s.name), s.error.len(), s.seconds.len())?;
    study::errors(section, &s.name, &s.error)?;
    let points = s.seconds.iter().copied().zip(s.error.iter().copied()).collect();
    Ok(Series { name: s.name.clone(), points, style: Style::Marked(i), end: None })
}

fn run_time(timings: &Timings) -> Result<Section, ReportError> {
    let all = &timings.evaluations;
    let bars = all
        .iter()
        .map(|e| Bar { name: e.name.clone(), value: e.nanoseconds, published: e.published })
        .collect();
    let bars = Bars { title: "time per evaluation".into(), unit: "ns".into(), bars };
    let mut blocks = vec![figures(&[bars], "Nanoseconds per evaluation; published approximations in grey.")?];
    let dots: Vec<Dot> = all.iter().filter(|e| e.max_error > 0.0).map(dot).collect();
    if dots.len() > 1 {
        let scatter = Scatter {
            title: "time against error".into(),
            x: ("nanoseconds per evaluation".into(), Spread::Linear),
            y: ("largest error of its use".into(), Spread::Log),
            dots,
            size: (760.0, if all.len() > 8 { 460.0 } else { 300.0 }),
        };
        blocks.push(figures(&[scatter], "Lower is more accurate, further left is faster.")?);
    }
    blocks.push(Block::Table(table(timings)));
    Ok(Section {
        id: "run-time".into(),
        title: "Run time: nanoseconds per evaluation".into(),
        lead: "Every approximation on one core of this machine, beside the operations that the model counts. Formulas run \
               through the evaluator in blocks of points, tables through a scalar bilinear fetch: compare like with like. \
               A GPU's times are others."
            .into(),
        blocks,
    })
}

fn dot(e: &crate::report::TimedApproximation) -> Dot {
    Dot { name: e.name.clone(), x: e.nanoseconds, y: e.max_error, published: e.published, table: e.table }
}

fn table(timings: &Timings) -> crate::report::TextTable {
    let columns = [("name", false), ("ns", true), ("ops", true), ("max error", true)];
    let row = |e: &crate::report::TimedApproximation| {
        vec![e.name.clone(), words::mean(e.nanoseconds), e.ops.to_string(), words::max(e.max_error)]
    };
    let mut table =
        words::table(&columns, timings.evaluations.iter().map(row).collect(), "Maxima are rounded up.");
    table.muted = timings.evaluations.iter().map(|e| e.published).collect();
    table
}
