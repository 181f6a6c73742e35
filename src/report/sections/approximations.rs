//! Every approximation with its error and cost, and the chart of one against the other.

use std::collections::BTreeSet;

use super::{figures, words};
use crate::data::Use;
use crate::report::{
    ApproximationFinding, Block, Dot, Names, ReportError, Scatter, Section, Spread, TextTable, check,
    figures_of,
};

const COLUMNS: &str = "name|ops>|max>|RMS>|where|fetches>|bytes>|use|norm|source";

/// All of them; names lead to the figures of those that the page shows, by name, and are places but for
/// those that the page has known before.
pub(crate) fn section(
    all: &[ApproximationFinding],
    shown: &[&str],
    known: &mut BTreeSet<String>,
) -> Result<Option<Section>, ReportError> {
    if all.is_empty() {
        return Ok(None);
    }
    unique(all)?;
    let mut blocks = Vec::new();
    for group in groups(all) {
        blocks.extend(chart(&group)?);
    }
    blocks.push(Block::Table(list(all, shown, known)));
    Ok(Some(Section::new(
        "approximations",
        "What accuracy costs at run time",
        lead(all, blocks.len() > 1),
        blocks,
    )))
}

/// What is listed, and how to read the charts if there are any.
fn lead(all: &[ApproximationFinding], charts: bool) -> String {
    let has = |kind: fn(&ApproximationFinding) -> bool| all.iter().any(kind);
    let kinds = [
        (has(|a| a.table), "tables"),
        (has(|a| !a.table && !a.published), "our fits"),
        (has(|a| a.published), "published formulas"),
    ];
    let there: Vec<&str> = kinds.iter().filter(|k| k.0).map(|k| k.1).collect();
    let (of, how) =
        (there.join(", "), if there.len() > 1 { ", all measured the same way" } else { ", measured" });
    let read = if charts { " In a chart, lower is more accurate, further left is cheaper." } else { "" };
    format!("What there is: {of}{how} against the truth.{read}")
}

/// Fits and timings refer to approximations by name.
fn unique(all: &[ApproximationFinding]) -> Result<(), ReportError> {
    let twice = all.iter().enumerate().find(|(i, a)| all[..*i].iter().any(|b| a.name == b.name));
    twice.map_or(Ok(()), |(_, a)| {
        Err(check::domain("approximations", &format!("name {}", a.name), "is used twice"))
    })
}

/// Approximations of the same column of the same quantity for the same use: what may share a chart.
fn groups(all: &[ApproximationFinding]) -> Vec<Vec<&ApproximationFinding>> {
    let groups = lobefit_math::groups(all, |a| (&a.quantity, &a.column, a.used_as, a.smith));
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Cost against error of a group; nothing where the table says as much, and none that is exact (a
/// log axis has no 0).
fn chart(group: &[&ApproximationFinding]) -> Result<Option<Block>, ReportError> {
    let dots: Vec<Dot> = group.iter().filter(|a| a.certificate.max_abs > 0.0).map(|a| dot(a)).collect();
    if !words::worth_a_chart(&dots) {
        return Ok(None);
    }
    let has = |kind: fn(&ApproximationFinding) -> bool| group.iter().any(|a| kind(a));
    let first = group[0];
    let (used_as, metric) = (first.used_as, first.used_as.metric);
    let smith = first.smith.map_or_else(String::new, |smith| format!(", {} Smith", smith.name()));
    let title = format!("{} as {}{smith}", first.quantity, used_as.name);
    let scatter = Scatter {
        title,
        x: ("operations (square-root scale; fetches not counted)".into(), Spread::Root),
        y: (format!("largest {metric}"), Spread::Log),
        dots,
        size: (1060.0, if group.len() > 8 { 460.0 } else { 300.0 }),
    };
    let exact: Vec<&str> =
        group.iter().filter(|a| a.certificate.max_abs == 0.0).map(|a| a.name.as_str()).collect();
    let caption = format!(
        "Largest {metric} over the domain against operations per evaluation. The stairs join our formulas that no other \
         formula of ours beats in both{}{}{}.{}",
        if has(|a| a.table) { "; tables (squares) also fetch, which operations do not count" } else { "" },
        if has(|a| a.published) { "; published ones are rings" } else { "" },
        if used_as == Use::NORMALISATION {
            ", judged as the factor N that should make E\u{a0}N\u{a0}=\u{a0}1"
        } else {
            ""
        },
        if exact.is_empty() {
            String::new()
        } else {
            format!(" Exact, so not on a logarithmic axis: {}.", exact.join(", "))
        },
    );
    figures(&[scatter], &caption).map(Some)
}

fn dot(a: &ApproximationFinding) -> Dot {
    Dot {
        name: a.name.clone(),
        x: f64::from(a.cost.ops),
        y: a.certificate.max_abs,
        published: a.published,
        table: a.table,
    }
}

fn list(all: &[ApproximationFinding], shown: &[&str], known: &mut BTreeSet<String>) -> TextTable {
    let caption = format!(
        "ops by the project's operation model (add, mul, fma, min, max, compare, select 1; reciprocal, sqrt, exp2 4; exp 5; \
         pow 9). Maxima are rounded up; where: the place of the maximum.{}",
        if all.iter().any(|a| a.published) { " Published constants are set back in grey." } else { "" },
    );
    let mut table = words::table(COLUMNS, all.iter().map(row).collect(), &caption);
    table.muted = all.iter().map(|a| a.published).collect();
    let link = |a: &ApproximationFinding| {
        shown.contains(&a.name.as_str()).then(|| format!("#{}", figures_of(&a.name)))
    };
    table.names = Some(Names {
        column: 0,
        places: all.iter().map(|a| known.insert(a.name.clone())).collect(),
        links: all.iter().map(link).collect(),
    });
    table
}

fn row(a: &ApproximationFinding) -> Vec<String> {
    vec![
        a.name.clone(),
        a.cost.ops.to_string(),
        words::max(a.certificate.max_abs),
        words::mean(a.certificate.rms),
        words::place(&a.certificate.at),
        a.cost.fetches.to_string(),
        crate::report::numbers::grouped(a.cost.bytes),
        a.used_as.name.into(),
        if a.norm.is_empty() { "–".into() } else { a.norm.clone() },
        a.source.clone(),
    ]
}
