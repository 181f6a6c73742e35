//! The page of times on a graphics processor.

use super::{SCREEN, time_against_error, words};
use crate::report::numbers::{grouped, significant};
use crate::report::{
    Block, Dot, GpuClock, GpuKind, GpuRecord, GpuRow, GpuSpread, Origin, Page, ReportError, Section,
    TextTable, bar_from,
};

pub(super) fn page(record: &GpuRecord, hash: &str) -> Result<Page, ReportError> {
    let mut sections = vec![measured(record, hash)];
    let of = |kinds: &[GpuKind]| -> Vec<&GpuRow> {
        record.rows.iter().filter(|row| kinds.contains(&row.kind)).collect()
    };
    let lookups = of(&[GpuKind::CubemapFetch, GpuKind::Lookup, GpuKind::LookupFetches]);
    if !lookups.is_empty() {
        sections.push(plain("lookups", "Lookups of probes", LOOKUPS, &lookups));
    }
    let tables = of(&[GpuKind::Fetch, GpuKind::Table]);
    if !tables.is_empty() {
        sections.push(plain("tables", "Fetches and lookups of tables", TABLES, &tables));
    }
    let fits = of(&[GpuKind::Fit]);
    if !fits.is_empty() {
        sections.push(charted(&fits)?);
    }
    let levels = of(&[GpuKind::Level]);
    if !levels.is_empty() {
        sections.push(plain("levels", "Levels of chains", LEVELS, &levels));
    }
    if !record.left_out.is_empty() {
        sections.push(left_out(record));
    }
    let of_every_formula = record.origin.scene == EVERY_FORMULA;
    let is_own = record.origin.scene == "default" || of_every_formula;
    let device = record.device.adapter.to_lowercase().replace(' ', "-");
    let every = format!("{device}-every-formula");
    let mut pages = if is_own { bar_from("../")? } else { Vec::new() };
    let known = pages.iter().any(|(_, page)| *page == format!("../gpu/{device}.html"));
    pages.extend(known.then(|| ("times of every formula".into(), format!("../gpu/{every}.html"))));
    let file = if of_every_formula { every } else { device };
    let origin = Origin { pages, ..record.origin.clone() };
    Ok(Page::new(
        format!("lobefit on {}", record.device.adapter),
        if known { origin.with_figures(&format!("{file}.json")) } else { origin },
        conclusion(record) + LEAD,
        sections,
    ))
}

/// The scene of the repository with every formula, whose record lies beside that of the built-in one.
const EVERY_FORMULA: &str = "every formula, under its own name";

const LEAD: &str = "Time per evaluation of the emitted WGSL on one graphics processor. A time holds for the code of its function, whatever the \
    scene; `lobefit check` says which functions have changed since.";

/// The least and the most expensive function, in one sentence.
fn conclusion(record: &GpuRecord) -> String {
    let timed = || record.rows.iter().filter(|row| row.function.is_some() && row.resolved());
    let by_time = |a: &&GpuRow, b: &&GpuRow| a.nanoseconds.median.total_cmp(&b.nanoseconds.median);
    let Some((least, most)) = timed().min_by(by_time).zip(timed().max_by(by_time)) else {
        return String::new();
    };
    let [from, to] = [least, most].map(|row| format!("{} µs ({})", significant(frame(row), 3), name(row)));
    format!("A call for each pixel of 3840 × 2160 takes {from} to {to} on {}.\n", record.device.adapter)
}

/// What a shader calls, or what is fetched.
fn name(row: &GpuRow) -> String {
    let name = row.function.as_ref().unwrap_or(&row.name);
    if row.kind == GpuKind::LookupFetches { format!("{name}, with its fetches") } else { name.clone() }
}

/// Microseconds of a call for each pixel of a screen.
fn frame(row: &GpuRow) -> f64 {
    1e-3 * row.nanoseconds.median * SCREEN
}

const LOOKUPS: &str = "From the shading point and the reflected ray to what is fetched, and the same with its fetches from a cubemap of 128 texels \
    and 7 levels, filtered between levels. Beside them, one fetch of that cubemap along the uncorrected ray.";

const TABLES: &str = "Plain fetches, at coordinates that need no arithmetic, and the lookups of tables: coordinates, the fetch, decoding.";

const FITS: &str = "Formulas alone, without a fetch.";

const LEVELS: &str =
    "From roughness to the level that holds it, back, and to the level that a corrected fetch takes.";

fn measured(record: &GpuRecord, hash: &str) -> Section {
    let (device, origin) = (&record.device, &record.origin);
    let clock = match record.clock {
        GpuClock::Timestamps => "the device's time stamps at the beginning and the end of a dispatch",
        GpuClock::Wall => "wall time from submission to completion: the driver offers no time stamps",
    };
    let rows = vec![
        ("Device".to_string(), format!("{} ({})", device.adapter, device.kind)),
        ("Driver".into(), format!("{}, {}", device.driver, device.backend)),
        ("Clock".into(), clock.into()),
        (
            "Work".into(),
            format!(
                "{} threads, {} pairs of dispatches a row{}",
                grouped(u64::from(record.threads)),
                record.repeats,
                if record.reduced { "; reduced: to try out, not to quote" } else { "" }
            ),
        ),
        ("Record".into(), hash.into()),
        ("Method".into(), format!("version {}, lobefit {}", record.method, origin.tool)),
    ];
    Section::new(
        "measured",
        "What was measured, and how",
        "Each thread is a pixel of a square picture and evaluates a function many times in a loop, at inputs that differ from pixel to \
               pixel and drift from turn to turn; results are summed and stored. Right before or after it the same loop runs without \
               the function, and the difference is what an evaluation adds: throughput of a full device, not the time that one \
               pixel waits. What runs beside the making of inputs adds nothing, and a compiler may unroll the shorter loop further: of \
               little weight in lookups, but times of formulas of few operations are rough. Rows take turns, so that a clock that changes meets all alike; figures are medians with quartiles.",
        vec![Block::Facts { rows }, Block::Text { text: COLUMNS.into() }],
    )
}

/// What the columns of every table are.
const COLUMNS: &str = "In the tables: medians, with the quartiles in brackets. `× of the loop`: the loop with the evaluation over the loop without. \
    `× of a fetch`: over what a plain fetch of the kind adds, two-dimensional for formulas. A dash: does not apply. Below noise: the lower quartile \
    is not above 0.";

fn plain(id: &str, title: &str, lead: &str, rows: &[&GpuRow]) -> Section {
    let blocks = vec![Block::Table(table(rows))];
    Section::new(id, title, lead, blocks)
}

/// Rows of a page of which nothing is folded.
const FEW: usize = 40;

fn charted(rows: &[&GpuRow]) -> Result<Section, ReportError> {
    let mut blocks = Vec::new();
    for group in groups(rows) {
        blocks.extend(chart(&group)?);
    }
    blocks.push(Block::Table(table(rows)));
    if rows.len() > FEW {
        let summary = "The other charts, and all figures".into();
        let rest = blocks.split_off(1);
        blocks.push(Block::Fold { summary, blocks: rest });
    }
    Ok(Section::new("fits", "Fits", FITS, blocks))
}

/// Rows that approximate the same column of the same quantity for the same use: what may share a
/// chart.
fn groups<'a>(rows: &[&'a GpuRow]) -> Vec<Vec<&'a GpuRow>> {
    let key = |row: &&'a GpuRow| row.error.as_ref().map(|e| (&e.quantity, &e.column, e.used_as));
    let groups = lobefit_math::groups(rows.iter().copied().filter(|row| row.error.is_some()), key);
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Time against error of a group.
fn chart(group: &[&GpuRow]) -> Result<Option<Block>, ReportError> {
    let Some(first) = group[0].error.as_ref() else { return Ok(None) };
    let dot = |row: &&GpuRow| {
        let error = row.error.as_ref().filter(|error| error.max > 0.0 && row.resolved())?;
        let x = picoseconds(row.nanoseconds.median);
        Some(Dot { name: name(row), x, y: error.max, published: error.published, table: false })
    };
    let dots: Vec<Dot> = group.iter().filter_map(dot).collect();
    time_against_error((&first.quantity, first.used_as), "picoseconds", dots, 1060.0)
}

fn table(rows: &[&GpuRow]) -> TextTable {
    let columns = "name|ops>|fetches>|ps per evaluation>|µs per 3840×2160>|× of the loop>|× of a fetch>";
    let cells = rows.iter().map(|row| cells(row)).collect();
    let mut table = words::table(columns, cells, "");
    table.muted = rows.iter().map(|row| row.error.as_ref().is_some_and(|error| error.published)).collect();
    table
}

fn cells(row: &GpuRow) -> Vec<String> {
    let told = |text: String| if row.resolved() { text } else { "below noise".into() };
    let time = row.nanoseconds;
    let time = GpuSpread {
        low: picoseconds(time.low),
        median: picoseconds(time.median),
        high: picoseconds(time.high),
    };
    vec![
        name(row),
        row.ops.map_or_else(|| "–".into(), |ops| ops.to_string()),
        row.fetches.to_string(),
        told(spread(time)),
        told(significant(frame(row), 3)),
        spread(row.ratio),
        row.against.as_ref().map_or_else(|| "–".into(), |against| told(spread(against.ratio))),
    ]
}

fn spread(spread: GpuSpread) -> String {
    let [low, median, high] = [spread.low, spread.median, spread.high].map(|x| significant(x, 3));
    format!("{median} [{low}, {high}]")
}

fn picoseconds(nanoseconds: f64) -> f64 {
    1e3 * nanoseconds
}

fn left_out(record: &GpuRecord) -> Section {
    let rows = record.left_out.iter().map(|out| vec![out.function.clone(), out.reason.clone()]).collect();
    Section::new(
        "left-out",
        "Not measured",
        "Functions of the manifest that have no time above.",
        vec![Block::Table(words::table("function|why", rows, ""))],
    )
}
