//! What each pass buys and costs, at every resolution.

use super::{RATES, Rate, by, milliseconds, own, percent, rates, with_times};
use crate::measure::{TOLERANCE, Tally, Trial, part};
use crate::passes::{Passes, Work};
use crate::study::{ALL, CHOSEN, Results, Row, SAFE};
use crate::times::Timed;
use lobefit::report::numbers::{brief, grouped};
use lobefit::report::{
    Block, Curves, Panel, ReportError, Section, Series, Spread, Style, TextTable, figures, folded, words,
};

const KEPT: Rate = ("wrongly kept, %", Tally::wrongly_kept);
const CULLED: Rate = ("wrongly culled, %", Tally::wrongly_culled);

/// Size of the plotted area of a chart of a sheet in pixels, and of one of a pair: a telephone makes them
/// smaller, and their text is still read there.
const SMALL: (f64, f64) = (280.0, 150.0);
const LARGE: (f64, f64) = (320.0, 200.0);

/// What buffers are made from, in the order of the table.
const SOURCES: [&str; 6] =
    ["depth", "depth of twice the resolution", "voxels", "depth and voxels", SAFE, CHOSEN];

/// Passes in their order, and what each took.
fn each<T: Copy>(work: &Work<T>) -> [(&'static str, T); 5] {
    let Work { reproject, median, accumulate, voxels, dilation } = *work;
    [
        ("points", reproject),
        ("medians", median),
        ("accumulation", accumulate),
        ("splats of voxels", voxels),
        ("dilation", dilation),
    ]
}

/// Work and time of each pass.
fn split(results: &Results, timed: Option<&[&Timed]>) -> Vec<Vec<String>> {
    let half = Passes { half: Some(true), ..Passes::NONE };
    let shown = [Passes::POINTS, half, ALL, Passes::CONSERVATIVE].map(Trial::usual);
    let shown = shown.into_iter().chain([results.choices.best.trial]);
    let rows = shown.filter_map(|trial| by(results, timed, trial));
    let of_row = |(row, timed): (&Row, Option<&Timed>)| {
        let spent = timed.map(|timed| each(&timed.milliseconds).map(|(_, ms)| ms));
        let own = each(&row.tally.work).into_iter().enumerate().filter(|(_, (_, work))| *work > 0);
        let cells = |(i, (pass, work)): (usize, (&str, u64))| {
            let first = [row.name.clone(), pass.into(), brief(part(work, row.tally.texels), 3)];
            first.into_iter().chain(spent.map(|spent| brief(spent[i], 3))).collect()
        };
        own.map(cells).collect::<Vec<_>>()
    };
    rows.flat_map(of_row).collect()
}

/// Which fills holes of the points for less: a median, or depth of twice the resolution.
fn holes_for_less(results: &Results, timed: Option<&[&Timed]>) -> String {
    let median = Passes { median: 1, ..Passes::POINTS };
    let half = Passes { half: Some(true), ..Passes::NONE };
    let [Some(points), Some(median), Some(half)] =
        [Passes::POINTS, median, half].map(|passes| by(results, timed, Trial::usual(passes)))
    else {
        return String::new();
    };
    let cost = |(row, timed): (&Row, Option<&Timed>)| {
        timed.map_or(row.tally.work_per_texel(), |timed| timed.milliseconds.total())
    };
    let (unit, of) = if timed.is_some() { (" ms", "time") } else { ("", "work") };
    let more = |way: (&Row, Option<&Timed>)| {
        let filled = points.0.tally.holes as f64 - way.0.tally.holes as f64;
        [filled / way.0.tally.texels as f64, cost(way) - cost(points)]
    };
    let worded = |way: (&Row, Option<&Timed>)| {
        let [filled, cost] = more(way);
        let kept = percent(way.0.tally.wrongly_kept());
        format!(
            "{} of the texels for {}{unit} more, and leaves {kept} wrongly kept",
            percent(filled),
            brief(cost, 2)
        )
    };
    format!(
        "Which hides holes for less? Of the points alone a median fills {}; depth of twice the resolution fills {}: {}. {}",
        worded(median),
        worded(half),
        cheaper(more(median), more(half), of),
        dangers([points, median, half].map(|(row, _)| row.tally.wrongly_culled())),
    )
}

/// Which of a median and depth of twice the resolution takes less for each hole; both by what they fill
/// and what that costs.
fn cheaper(median: [f64; 2], half: [f64; 2], of: &str) -> String {
    if median[0] <= 0.0 || half[0] <= 0.0 {
        return "one of them fills none".into();
    }
    if median[1] <= 0.0 || half[1] <= 0.0 {
        return format!("in one of them the {of} of filling is less than its clock can tell");
    }
    let [of_median, of_half] = [median, half].map(|[filled, cost]| cost / filled);
    let (name, times) = match of_median < of_half {
        true => ("the median", of_half / of_median),
        false => ("depth of twice the resolution", of_median / of_half),
    };
    match brief(times, 2).as_str() {
        "1" => format!("they take as much {of} for each hole"),
        times => format!("{name} takes {times} times less {of} for each hole"),
    }
}

/// What the points, a median on them and depth of twice the resolution cull of what is seen.
fn dangers(culled: [f64; 3]) -> String {
    let [points, median, half] = culled.map(percent);
    let safer = match culled[1].total_cmp(&culled[2]) {
        _ if median == half => "neither is safer than the other",
        std::cmp::Ordering::Less => "the median is the safer of the two",
        _ => "depth of twice the resolution is the safer of the two",
    };
    format!(
        "The danger: of the boxes that are seen the points alone cull {points}, with a median {median}, depth of twice the resolution {half}, so that {safer}."
    )
}

/// The section; `timed` is why there are no times, or those of each row, measured on a device.
pub(super) fn passes(
    results: &Results,
    timed: Result<&[&Timed], &str>,
    device: &str,
) -> Result<Section, ReportError> {
    let measured = match timed {
        Ok(_) => format!(
            "Milliseconds: {device}; fastest of five runs of each pass, mean over the frames (times.json)."
        ),
        Err(why) => {
            format!("Without milliseconds: {why}; the command with `--times` measures them.")
        }
    };
    let timed = timed.ok();
    let first = results.rows.first().map(|row| row.tally).unwrap_or_default();
    let caption = format!(
        "Over {} frames, with {} boxes that the true depth shows and {} that it hides, by the same test of a box's rectangle. Too near: by more than {} of the depth. \
         The conservative mode reprojects depth of four times the resolution, keeps the farthest point, and knows nothing at edges. {measured}",
        first.frames,
        grouped(first.seen),
        grouped(first.hidden),
        percent(f64::from(TOLERANCE)),
    );
    let split = words::table(
        &with_times("buffer|pass|work per texel>", timed),
        split(results, timed),
        "Work of each pass for each texel of the buffer, beside its time. Accumulation adds the depth of a frame to the voxels.",
    );
    let points = "Points of old depth leave cracks, most of which a median closes, and what they never saw, which only voxels know. A voxel is as thick as it is \
                  wide: it closes the holes of fences.";
    let charts = "What accuracy costs. A source has four marks: alone, with the median, with the dilation, with both; lines join marks that differ by one pass; \
                  the conservative mode and the chosen parameters have one. Lower is better. Other resolutions: at the end of this page.";
    let culling = &results.culling;
    let one = |rate| chart(results, timed, (culling.grid, culling.buffer.map(|n| n as usize)), (rate, LARGE));
    Ok(Section::new(
        "passes",
        "What each pass buys",
        format!("{points} {}", holes_for_less(results, timed)),
        vec![
            Block::Table(table(results, timed, &own(results), &caption)),
            figures(&[one(KEPT), one(CULLED)], charts)?,
            folded("Work of each pass", vec![Block::Table(split)]),
        ],
    ))
}

/// Rows of results with their rates and what they take.
fn table(
    results: &Results,
    timed: Option<&[&Timed]>,
    keep: &dyn Fn(&Row) -> bool,
    caption: &str,
) -> TextTable {
    let columns = with_times(&format!("buffer|{RATES}"), timed);
    let rows = results.rows.iter().enumerate().filter(|(_, row)| keep(row)).map(|(i, row)| {
        let cells = rates(&row.tally).into_iter().chain(milliseconds(timed.map(|timed| timed[i])));
        std::iter::once(row.name.clone()).chain(cells).collect()
    });
    words::table(&columns, rows.collect(), caption)
}

/// Sizes in words.
fn sized<const N: usize>(sizes: [impl ToString; N]) -> String {
    sizes.map(|n| n.to_string()).join(" x ")
}

/// A rate over cost, with a grid and a buffer.
fn chart(
    results: &Results,
    timed: Option<&[&Timed]>,
    (grid, buffer): ([u32; 3], [usize; 2]),
    (rate, size): (Rate, (f64, f64)),
) -> Curves {
    let of = |source: &str, fill: &str| {
        let name = format!("{source}{fill}");
        let is_here = |row: &Row| row.buffer == buffer && row.voxels.is_none_or(|voxels| voxels == grid);
        let i = results.rows.iter().position(|row| row.name == name && is_here(row))?;
        let tally = &results.rows[i].tally;
        let work = || 1e-3 * part(tally.work.total(), tally.frames);
        let cost = timed.map_or_else(work, |timed| timed[i].milliseconds.total());
        Some((cost, 100.0 * rate.1(tally)))
    };
    let lines = SOURCES.iter().enumerate().flat_map(|(k, source)| {
        let fills = [["", ", median", ", median, dilation"], ["", ", dilation", ", median, dilation"]];
        fills.map(|fills| {
            Series::line(
                *source,
                fills.iter().filter_map(|fill| of(source, fill)).collect(),
                Style::Marked(k),
            )
        })
    });
    let label = if timed.is_some() { "ms a frame" } else { "thousands of texels and voxels" };
    let title = format!("{}, {} voxels", sized(buffer), sized(grid));
    let axes = [(label, Spread::Log), (rate.0, Spread::Root)];
    let most = results.rows.iter().map(|row| 100.0 * rate.1(&row.tally)).fold(1.0, f64::max);
    Curves { y_limits: Some((0.0, 1.05 * most)), ..Curves::new(title, axes, lines.collect(), size) }
}

/// A rate over cost, a chart for each size of the grid and of the buffer.
fn sheet(results: &Results, timed: Option<&[&Timed]>, rate: Rate) -> Vec<Panel> {
    let mut grids: Vec<[u32; 3]> = results.rows.iter().filter_map(|row| row.voxels).collect();
    grids.sort();
    grids.dedup();
    let mut buffers: Vec<[usize; 2]> = results.rows.iter().map(|row| row.buffer).collect();
    buffers.sort();
    buffers.dedup();
    let all = grids.iter().flat_map(|grid| buffers.iter().map(|buffer| (*grid, *buffer)));
    let panel =
        |(i, sizes)| Panel { chart: chart(results, timed, sizes, (rate, SMALL)), legend: i < buffers.len() };
    all.enumerate().map(panel).collect()
}

/// Every row of the other resolutions.
pub(super) fn resolutions(results: &Results, timed: Option<&[&Timed]>) -> Result<Section, ReportError> {
    let own = own(results);
    let columns = with_times(&format!("size|voxels|buffer|{RATES}"), timed);
    let rows = results.rows.iter().enumerate().filter(|(_, row)| !own(row)).map(|(i, row)| {
        let first = [sized(row.buffer), row.voxels.map_or("-".into(), sized), row.name.clone()];
        let ms = milliseconds(timed.map(|timed| timed[i]));
        first.into_iter().chain(rates(&row.tally)).chain(ms).collect()
    });
    let lead = "A grid of twice the voxel takes an eighth of the memory; texels that are too near grow with the size of voxels and of texels.";
    let caption = "Buffers and grids of other sizes than the scene's.";
    let sheets = "What accuracy costs, as above. Columns: buffers of half, of one and of one and a half times the size. Rows: grids of a quarter, a half and \
                  all of the voxels along each axis.";
    Ok(Section::new(
        "resolutions",
        "Resolutions",
        lead,
        vec![
            figures(&sheet(results, timed, KEPT), sheets)?,
            figures(&sheet(results, timed, CULLED), "The same of what vanishes.")?,
            Block::Table(words::table(&columns, rows.collect(), caption)),
        ],
    ))
}
