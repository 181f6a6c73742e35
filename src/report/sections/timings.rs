//! The page of measured times.

use super::{figures, time_against_error, words};
use crate::report::{
    Bar, Bars, Block, Dot, Page, ReportError, Section, TimedApproximation, TimedEffects, TimedLookup, Timings,
};

pub(super) fn page(timings: &Timings) -> Result<Page, ReportError> {
    let mut sections = Vec::new();
    if let Some(effects) = &timings.effects {
        sections.push(alone(effects)?);
    }
    if let Some(tables) = &timings.tables {
        sections.push(super::timed_tables::section(tables)?);
    }
    if !timings.evaluations.is_empty() {
        sections.push(run_time(timings)?);
    }
    if !timings.lookups.is_empty() {
        sections.push(lookups(timings));
    }
    Ok(Page::new(
        format!("lobefit timings: {}", timings.origin.scene),
        timings.origin.clone(),
        format!(
            "What accuracy costs in time, measured on {}. Times differ from run to run and from machine to machine: \
             compare them with one another, not with another page.",
            timings.device
        ),
        sections,
    ))
}

fn alone(effects: &TimedEffects) -> Result<Section, ReportError> {
    let TimedEffects { alone, all } = effects;
    let bar = |name: &str, value: f64, published| Bar { name: name.into(), value, published };
    let each = alone.iter().map(|one| bar(&one.effect, one.seconds, false));
    let bars = each.chain([bar("all effects", *all, true)]).collect();
    let bars = Bars { title: "bake".into(), unit: "s".into(), bars };
    let longest = alone.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let longest = longest.map_or_else(String::new, |one| {
        let share = (100.0 * one.seconds / all).round();
        format!(
            "The longest, {}, takes {} s by itself, {share} % of the bake of all. ",
            one.effect,
            words::mean(one.seconds)
        )
    });
    Ok(Section::new(
        "effects",
        "A bake of one effect, and of all",
        format!(
            "{longest}Each bar is a process of its own without the cache, as `lobefit bake --only EFFECT --no-cache`: what a scene \
             with this effect alone would take. What two effects share is in the bars of both."
        ),
        vec![figures(&[bars], "Seconds of whole processes; all effects in grey.")?],
    ))
}

fn run_time(timings: &Timings) -> Result<Section, ReportError> {
    let all = &timings.evaluations;
    let bars = all
        .iter()
        .map(|e| Bar { name: e.name.clone(), value: e.nanoseconds, published: e.published })
        .collect();
    let bars = Bars { title: "time per evaluation".into(), unit: "ns".into(), bars };
    let mut blocks = vec![figures(&[bars], "Nanoseconds per evaluation; published approximations in grey.")?];
    for group in groups(all) {
        let dots = group.iter().filter(|e| e.max_error > 0.0).map(|e| dot(e)).collect();
        let of = (group[0].quantity.as_str(), group[0].used_as);
        blocks.extend(time_against_error(of, "nanoseconds", dots, 760.0)?);
    }
    blocks.push(Block::Table(table(timings)));
    Ok(Section::new(
        "run-time",
        "Run time: nanoseconds per evaluation",
        "Every approximation on one core of this machine, beside the operations that the model counts. Formulas run \
               through the evaluator in blocks of points, tables through a scalar bilinear fetch: compare like with like. \
               A GPU's times are others.",
        blocks,
    ))
}

fn lookups(timings: &Timings) -> Section {
    let columns = "lookup|fetches>|ns per pixel>";
    let row = |l: &TimedLookup| vec![l.lookup.clone(), l.fetches.to_string(), words::mean(l.nanoseconds)];
    let rows = timings.lookups.iter().map(row).collect();
    Section::new(
        "lookups",
        "Lookups of probes: nanoseconds per pixel",
        "From shading point and view to directions, widths and weights, on one core of this machine in f64, one pixel after the other, with \
               the rational width and the rule of half-cosine chains where an emitted lookup may have others. The texture's \
               fetches come on top; operations of the emitted functions are in the manifest.",
        vec![Block::Table(words::table(
            columns,
            rows,
            "Mean over places, normals, views and widths at random.",
        ))],
    )
}

/// Approximations of the same column of the same quantity for the same use: what may share a chart.
fn groups(all: &[TimedApproximation]) -> Vec<Vec<&TimedApproximation>> {
    lobefit_math::groups(all, |e| (&e.quantity, &e.column, e.used_as))
        .into_iter()
        .map(|(_, group)| group)
        .collect()
}

fn dot(e: &TimedApproximation) -> Dot {
    Dot { name: e.name.clone(), x: e.nanoseconds, y: e.max_error, published: e.published, table: e.table }
}

fn table(timings: &Timings) -> crate::report::TextTable {
    let columns = "name|ns>|ops>|max error>";
    let row = |e: &TimedApproximation| {
        vec![e.name.clone(), words::mean(e.nanoseconds), e.ops.to_string(), words::max(e.max_error)]
    };
    let mut table =
        words::table(columns, timings.evaluations.iter().map(row).collect(), "Maxima are rounded up.");
    table.muted = timings.evaluations.iter().map(|e| e.published).collect();
    table
}
