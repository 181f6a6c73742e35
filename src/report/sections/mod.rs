//! The sections of the pages: which figures show which findings, and the words around them.

pub(crate) mod answers;
pub(crate) mod approximations;
mod averages;
pub(crate) mod called_for;
mod cost;
mod explore;
pub(crate) mod fits;
pub(crate) mod furnace;
mod gpu;
mod index;
pub mod offline;
mod selection;
mod sky;
pub(crate) mod tables;
mod timed_tables;
mod timings;
pub mod words;

use std::collections::BTreeSet;

use super::{
    Answer, Block, Costs, Dot, Figure, Findings, GpuRecord, Origin, Page, ReportError, Scatter, Spread,
    Timings,
};
use crate::data::Use;
use crate::emit::manifest::Manifest;
use crate::report::explore::{EXPLORE, ExplorePage};
use lobefit_shade::code::Language;

/// Pixels of a screen of 3840 by 2160.
const SCREEN: f64 = 3840.0 * 2160.0;

/// The page of an effect. Sections that the scene called for nothing in are left out.
pub(crate) fn of_findings(effect: &str, findings: &Findings) -> Result<Page, ReportError> {
    let mut sections = vec![called_for::section(findings)?];
    let tables = findings.tables.iter().map(|table| table.name.as_str());
    let shown: Vec<&str> = tables.chain(findings.fits.iter().map(|fit| fit.name.as_str())).collect();
    sections.extend(approximations::section(&findings.approximations, &shown, &mut BTreeSet::new())?);
    sections.extend(furnace::section(findings)?);
    sections.extend(sky::section(findings)?);
    sections.extend(tables::truths(&findings.truths, &findings.caption)?);
    sections.extend(tables::section(&findings.tables)?);
    sections.extend(fits::section(&findings.fits, findings.averages.as_ref(), &findings.approximations)?);
    Ok(Page::new(
        findings.origin.title("lobefit report", effect),
        findings.origin.clone(),
        format!(
            "What the scene called for, every approximation made for it with its measured error and its cost, \
             and the truth beside it. Figures in full digits: {effect}.json, in this folder."
        ),
        sections,
    ))
}

/// The overview of a bake.
pub(crate) fn of_index(
    origin: Origin,
    answers: &[Answer],
    drawn: &answers::Drawn,
) -> Result<Page, ReportError> {
    let mut sections = Vec::new();
    if answers.iter().any(|answer| !answer.purposes.is_empty()) {
        let mut cards = answers::cards(answers, drawn)?;
        let live = origin.pages.iter().find(|(_, file)| EXPLORE.ends_with(file.as_str()));
        let link = |(_, file): &(String, String)| {
            (format!("Spheres drawn by {}, beside the truth", live_code(drawn.manifest)), file.clone())
        };
        let rows: Vec<_> = live.map(link).into_iter().collect();
        cards.blocks.splice(0..0, (!rows.is_empty()).then_some(Block::Links { rows }));
        sections.push(cards);
        sections.extend(answers::frontier(answers)?);
    }
    sections.extend(index::sections(drawn.manifest));
    Ok(Page::new(origin.title("lobefit report", ""), origin, index::conclusion(drawn.manifest), sections))
}

/// What a browser draws with, whether the bake emits it or not.
const LIVE: Language = Language::Glsl;

/// What the live page runs.
fn live_code(manifest: &Manifest) -> &'static str {
    let emitted = manifest.includes.iter().any(|include| include.language == LIVE.name());
    if emitted { "the emitted GLSL" } else { "the emitted functions, here in GLSL" }
}

/// The live page.
pub(crate) fn of_explore(page: ExplorePage, drawn: &answers::Drawn) -> Result<Page, ReportError> {
    explore::page(page, live_code(drawn.manifest), drawn)
}

/// The page of a measurement of time.
pub(crate) fn of_timings(timings: &Timings) -> Result<Page, ReportError> {
    timings::page(timings)
}

/// The page of times on a graphics processor, whose record has this hash.
pub(crate) fn of_gpu(record: &GpuRecord, hash: &str) -> Result<Page, ReportError> {
    gpu::page(record, hash)
}

/// The page of what accuracy costs.
pub(crate) fn of_costs(costs: &Costs) -> Result<Page, ReportError> {
    cost::page(costs)
}

/// Times of approximations of one use of a quantity against their errors, in a chart of a width; none of
/// dots that a table tells as well.
fn time_against_error(
    (quantity, used_as): (&str, Use),
    unit: &str,
    dots: Vec<Dot>,
    width: f64,
) -> Result<Option<Block>, ReportError> {
    if !words::worth_a_chart(&dots) {
        return Ok(None);
    }
    let metric = used_as.metric;
    let scatter = Scatter {
        title: format!("{quantity} as {}", used_as.name),
        x: (format!("{unit} per evaluation (square-root scale)"), Spread::Root),
        y: (format!("largest {metric}"), Spread::Log),
        size: (width, if dots.len() > 8 { 460.0 } else { 300.0 }),
        dots,
    };
    let caption = format!(
        "Largest {metric} against {unit}: lower is more accurate, further left is faster. The stairs join our \
         formulas that no other formula of ours beats in both; the pointer and the table name the others."
    );
    figures(&[scatter], &caption).map(Some)
}

/// Figures side by side under one caption, drawn in parallel and kept in order.
///
/// # Errors
/// What a figure says of its data.
pub fn figures<F: Figure + Sync>(figures: &[F], caption: &str) -> Result<Block, ReportError> {
    use rayon::prelude::*;
    let svg: Vec<Result<String, ReportError>> = figures.par_iter().map(Figure::svg).collect();
    Ok(Block::Figures { svg: svg.into_iter().collect::<Result<_, _>>()?, caption: caption.into() })
}
