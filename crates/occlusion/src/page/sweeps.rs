//! What latency, speed and free parameters do, and why texels are never written.

use super::{RATES, Rate, by, milliseconds, path, percent, rates, with_times, worded};
use crate::choice::{ALLOWED, COST, Choice, Choices, OnShots};
use crate::measure::{Tally, part};
use crate::passes::Work;
use crate::study::{Causes, MEASURED, Point, Results, SAFE};
use crate::times::Timed;
use lobefit::report::{Block, Curves, ReportError, Section, Series, Spread, Style, figures, words};
use lobefit::scene::CameraPath;

/// Size of the plotted area of a chart in pixels: four stand side by side.
const CHART: (f64, f64) = (208.0, 150.0);

/// A way to make the buffer: its name, and what a point of a sweep has of it.
type Way = (&'static str, fn(&Point) -> &Tally);
/// A horizontal axis: its label, and where a point lies on it, if it does.
type Axis<'a> = (&'a str, &'a dyn Fn(&Point) -> Option<f64>);

/// Ways that a chart compares.
const WAYS: [Way; 4] = [
    ("points", |point| &point.points),
    ("all passes", |point| &point.all),
    (SAFE, |point| &point.conservative),
    ("chosen", |point| &point.chosen),
];

/// A rate on a path, over an axis.
fn chart(results: &Results, (path, of): (CameraPath, Rate), (label, x): Axis) -> Curves {
    let on_path: Vec<(f64, &Point)> = results
        .sweep
        .iter()
        .filter(|point| point.path == path)
        .filter_map(|point| Some((x(point)?, point)))
        .collect();
    let line = |(i, (name, tally)): (usize, &Way)| {
        let mut points: Vec<(f64, f64)> =
            on_path.iter().map(|(x, point)| (*x, 100.0 * of.1(tally(point)))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Series::line(*name, points, Style::Marked(i))
    };
    let most = results.sweep.iter().flat_map(|point| WAYS.map(|(_, tally)| 100.0 * of.1(tally(point))));
    let y_limits = Some((0.0, 1.05 * most.fold(1.0, f64::max)));
    let (axes, lines) = ([(label, Spread::Linear), (of.0, Spread::Root)], WAYS.iter().enumerate().map(line));
    Curves { y_limits, ..Curves::new(super::path(path), axes, lines.collect(), CHART) }
}

/// What latency and speed do to each way that the page recommends or warns of.
pub(super) fn sweeps(results: &Results) -> Result<Section, ReportError> {
    let latency = results.culling.latency as usize;
    let by_latency = |point: &Point| (point.speed == 1.0).then_some(point.latency as f64);
    let by_speed = |point: &Point| (point.latency == latency).then_some(3.0 * point.speed);
    let rates: [Rate; 2] =
        [("wrongly kept, %", Tally::wrongly_kept), ("wrongly culled, %", Tally::wrongly_culled)];
    let row = |x: Axis| {
        rates.map(|rate| [CameraPath::Turn, CameraPath::Strafe].map(|path| chart(results, (path, rate), x)))
    };
    let caption =
        "Points: old depth alone. All passes: those of the scene. Conservative, chosen: as in the tables.";
    Ok(Section::new(
        "sweeps",
        "Latency and speed",
        format!(
            "Latency at 3 degrees a frame (sideways 0.25 m a frame), speed at a latency of {latency} frames; a step sideways grows as the turn does, \
             by 0.083 m for each degree.{}",
            farthest(results)
        ),
        vec![
            figures(row(("latency, frames", &by_latency)).as_flattened(), caption)?,
            figures(row(("degrees a frame", &by_speed)).as_flattened(), "The same by speed.")?,
        ],
    ))
}

/// The most that the conservative mode and the chosen parameters cull in the whole sweep.
fn farthest(results: &Results) -> String {
    let most = |tally: fn(&Point) -> &Tally| {
        let rate = |point: &Point| tally(point).wrongly_culled();
        results.sweep.iter().map(|point| (rate(point), point)).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let (Some(safe), Some(chosen)) = (most(WAYS[2].1), most(WAYS[3].1)) else { return String::new() };
    let at = |(rate, point): (f64, &Point)| match rate > 0.0 {
        false => "none anywhere".into(),
        true => format!(
            "at most {} (`{}`, latency {}, {}\u{a0}degrees a frame)",
            percent(rate),
            path(point.path),
            point.latency,
            3.0 * point.speed
        ),
    };
    format!(
        " Of the boxes that are seen the conservative mode culls {}, the chosen parameters, chosen at a latency of {} frames and the usual speed, {}.",
        at(safe),
        results.culling.latency,
        at(chosen)
    )
}

/// What most of the holes of a path come from, and their part of all texels.
fn most(Causes { path: on, holes }: &Causes) -> String {
    let causes = [
        (holes.out_of_frame, "out of the old frame"),
        (holes.stretched, "stretched"),
        (holes.disoccluded, "disoccluded"),
    ];
    let all: u64 = causes.iter().map(|(n, _)| n).sum();
    match causes.into_iter().max_by_key(|(n, _)| *n) {
        Some((n, cause)) if all > 0 => format!(
            "on the path `{}` {} of the texels, {} of these {cause}",
            path(*on),
            percent(part(all, holes.texels)),
            percent(part(n, all))
        ),
        _ => format!("on the path `{}` none", path(*on)),
    }
}

pub(super) fn holes(results: &Results) -> Section {
    let row = |causes: &Causes| {
        let holes = &causes.holes;
        let of = [holes.out_of_frame, holes.stretched, holes.disoccluded];
        std::iter::once(path(causes.path).to_string())
            .chain(of.map(|n| percent(part(n, holes.texels))))
            .collect()
    };
    let columns = "path|out of the old frame>|stretched>|disoccluded>";
    let caption = "Parts of all texels that no point of the old depth reached. Stretched: the old frame saw what is there, with too few points.";
    let table = words::table(columns, results.causes.iter().map(row).collect(), caption);
    Section::new(
        "holes",
        "Why texels are never written",
        format!(
            "Points of the old depth leave empty {}.",
            results.causes.iter().map(most).collect::<Vec<_>>().join("; ")
        ),
        vec![Block::Table(table)],
    )
}

pub(super) fn parameters(results: &Results, timed: Option<&[&Timed]>) -> Section {
    let first = "parameters|shots|culled, worst shot>|culled sideways>|kept sideways>";
    let columns = with_times(&format!("{first}|{RATES}"), timed);
    let two = |name: &str, choice: &Choice| {
        let ms = by(results, timed, choice.trial).and_then(|(_, timed)| milliseconds(timed));
        let row = |shots: &str, found: &OnShots| -> Vec<String> {
            let sideways = [found.sideways.wrongly_culled(), found.sideways.wrongly_kept()].map(percent);
            let first = [name.to_string(), shots.into(), percent(found.most_culled)];
            first.into_iter().chain(sideways).chain(rates(&found.sum)).chain(ms.clone()).collect()
        };
        [row("chosen on", &choice.chosen), row("others", &choice.reported)]
    };
    let Choices { usual, best, tried } = &results.choices;
    let rows = [two("usual", usual), two("chosen", best)].concat();
    let [culled, kept] = ALLOWED.map(percent);
    let none = match best.chosen.sum.wrongly_kept() > ALLOWED[1] {
        true => format!(" Here none keeps {kept} or less."),
        false => String::new(),
    };
    let Work { dilation: cheapest, accumulate: dearest, .. } = COST;
    let caption = format!(
        "Usual: {}. Chosen: {}. Sideways: on the strafes of these shots alone.{}",
        worded(&usual.trial),
        worded(&best.trial),
        timed.map_or("", |_| " Milliseconds: on the scene's path.")
    );
    let lead = format!(
        "Free are the radius of median, dilation and erosion, levels of detail and the margin of depth in tests. The erosion takes the farthest of a square \
         about every texel, so that what stands in front shrinks. Allowed is to cull {culled} of what is seen on any shot and to keep {kept} of what is hidden. \
         The fitting engine is not used: it moves constants along slopes, and rates of boxes are steps in all of these. Each box has a margin from which on \
         it is kept: sorted, they give the least margin that culls no more than is allowed, exactly. With it all {tried} combinations of the rest are tried \
         on a turn, a strafe and a walk from five places each, {} frames of every shot. Chosen is the \
         combination of least work that keeps what is allowed, or else the one that keeps least of what is hidden.{none} A count of each pass is weighed with the time \
         that it takes on a CPU, from {cheapest}\u{a0}ns of the dilation to {dearest}\u{a0}ns of the accumulation, the same in every study. The choice is reported on \
         shots from the four other places.",
        MEASURED.len()
    );
    Section::new("parameters", "Parameters", lead, vec![Block::Table(words::table(&columns, rows, &caption))])
}
