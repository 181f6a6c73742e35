//! Whole tables: error against seconds, ours and the path tracer's.

use super::{figures, offline, words};
use crate::report::numbers::{grouped, significant};
use crate::report::{
    Block, Curves, ReportError, Section, Series, Spread, Style, TimedTableRun, TimedTables, check,
};

const COLUMNS: &str = "asked for>|smith|instructions|worst checked>|texels checked>|evaluations>|reflection, s>|glass, s>|all, s>|sources / ours>";

pub(super) fn section(tables: &TimedTables) -> Result<Section, ReportError> {
    let positive = |r: &TimedTableRun| r.seconds() > 0.0 && r.worst > 0.0;
    if !tables.runs.iter().all(positive) {
        return Err(check::domain("tables", "runs", "must have positive times and errors"));
    }
    let rows = tables.runs.iter().map(|r| row(r, tables)).collect();
    let e = &tables.estimator;
    let caption = format!(
        "All {} texels of the three tables on {} threads. The path tracer draws {} random samples a texel; the same estimator in f64 \
         makes {} (reflection) and {} (glass) samples a second here, so their tables would take {} s, extrapolated, with an \
         error of {} (one standard deviation, reflection) where ours has the one in the table.",
        grouped(tables.texels),
        tables.threads,
        grouped(e.samples_per_texel as u64),
        significant(e.samples_per_second[0], 2),
        significant(e.samples_per_second[1], 2),
        significant(e.seconds, 3),
        significant(e.deviation[0] / e.samples_per_texel.sqrt(), 2),
    );
    Ok(Section::new(
        "tables",
        "Offline: whole tables",
        "The path tracer's three tables, every texel: reflection 64 × 64 × 32 and rough glass 128 × 128 × 32 from outside and \
               from inside.",
        vec![
            Block::Table(words::table(COLUMNS, rows, &caption)),
            figures(
                &[chart(tables)],
                "Error against seconds for all three tables, both logarithmic; the path tracer's estimator is \
                                       extrapolated from its rate.",
            )?,
        ],
    ))
}

fn row(run: &TimedTableRun, tables: &TimedTables) -> Vec<String> {
    vec![
        significant(run.tolerance, 1),
        run.smith.name().into(),
        run.instructions.into(),
        words::max(run.worst),
        grouped(run.checked),
        grouped(run.evaluations),
        significant(run.reflection_seconds, 3),
        significant(run.glass_seconds, 3),
        significant(run.seconds(), 3),
        grouped((tables.estimator.seconds / run.seconds()) as u64),
    ]
}

fn chart(tables: &TimedTables) -> Curves {
    let mut series: Vec<Series> = Vec::new();
    for run in tables.runs.iter().filter(|run| run.instructions == tables.runs[0].instructions) {
        let name = format!("lobefit, {} Smith: worst texel checked", run.smith.name());
        let point = (run.seconds(), run.worst);
        match series.iter_mut().find(|s| s.name == name) {
            Some(known) => known.points.push(point),
            None => {
                let style = Style::Marked(series.len());
                series.push(Series::line(name, vec![point], style));
            }
        }
    }
    let e = &tables.estimator;
    let error = |seconds: f64| {
        let samples = e.samples_per_texel * seconds / e.seconds;
        (seconds, e.deviation[0].max(e.deviation[1]) / samples.sqrt())
    };
    series.push(Series::line(
        "the path tracer's estimator: standard deviation",
        [0.1, 1.0, 10.0, 1e3, 1e5, e.seconds].into_iter().map(error).collect(),
        Style::Marked(series.len()),
    ));
    let axes = [("seconds", Spread::Log), ("absolute error of E", Spread::Log)];
    Curves { guides: offline::guides(), ..Curves::new("three tables", axes, series, (560.0, 360.0)) }
}
