//! What latency, speed and free parameters do, and why texels are never written.

use super::{CHART, MS, RATES, Rate, by, curves, milliseconds, path, percent, rates, worded};
use crate::choice::{ALLOWED, Choice, Choices, FINALISTS, OnShots};
use crate::measure::{Tally, part};
use crate::study::{Causes, MEASURED, Point, Results};
use crate::times::Timed;
use lobefit::report::{Block, ReportError, Section, Series, Style, figures, words};
use lobefit::scene::CameraPath;

pub(super) fn sweeps(results: &Results) -> Result<Section, ReportError> {
    let latency = results.culling.latency as usize;
    let chart = |(title, x): (&str, &str), keep: &dyn Fn(&Point) -> Option<f64>, of: Rate| {
        let line = |path: CameraPath, all: bool, style: usize| {
            let mut points: Vec<(f64, f64)> = results
                .sweep
                .iter()
                .filter(|point| point.path == path)
                .filter_map(|point| {
                    Some((keep(point)?, 100.0 * of.1(if all { &point.all } else { &point.points })))
                })
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let name = format!("{}, {}", super::path(path), if all { "all passes" } else { "points" });
            Series { name, points, style: Style::Line(style), end: None }
        };
        let series = [
            (CameraPath::Turn, false),
            (CameraPath::Turn, true),
            (CameraPath::Strafe, false),
            (CameraPath::Strafe, true),
        ];
        let lines = series.into_iter().enumerate().map(|(i, (path, all))| line(path, all, i)).collect();
        curves(title, [x, of.0], lines, CHART)
    };
    let by_latency = |point: &Point| (point.speed == 1.0).then_some(point.latency as f64);
    let by_speed = |point: &Point| (point.latency == latency).then_some(3.0 * point.speed);
    let [kept, culled]: [Rate; 2] =
        [("wrongly kept, %", Tally::wrongly_kept), ("wrongly culled, %", Tally::wrongly_culled)];
    let charts = [
        chart(("By latency: kept", "frames"), &by_latency, kept),
        chart(("By latency: culled", "frames"), &by_latency, culled),
        chart(("By speed: kept", "degrees a frame"), &by_speed, kept),
        chart(("By speed: culled", "degrees a frame"), &by_speed, culled),
    ];
    Ok(Section {
        id: "sweeps".into(),
        title: "Latency and speed".into(),
        lead: format!(
            "Latency at 3 degrees a frame (sideways 0.25 m a frame), speed at a latency of {latency} frames; a step sideways grows as the turn does, \
             by 0.083 m for each degree."
        ),
        blocks: vec![figures(
            &charts,
            "Points: old depth alone. All passes: those of the scene, with `reproject` in place of `reproject-half`.",
        )?],
    })
}

pub(super) fn holes(results: &Results) -> Section {
    let row = |causes: &Causes| {
        let holes = &causes.holes;
        let of = [holes.out_of_frame, holes.stretched, holes.disoccluded];
        std::iter::once(path(causes.path).to_string())
            .chain(of.map(|n| percent(part(n, holes.texels))))
            .collect()
    };
    let columns =
        [("path", false), ("out of the old frame", true), ("stretched", true), ("disoccluded", true)];
    let caption = "Parts of all texels that no point of the old depth reached. Stretched: the old frame saw what is there, with too few points.";
    let table = words::table(&columns, results.causes.iter().map(row).collect(), caption);
    Section {
        id: "holes".into(),
        title: "Why texels are never written".into(),
        lead: String::new(),
        blocks: vec![Block::Table(table)],
    }
}

pub(super) fn parameters(results: &Results, timed: Option<&[&Timed]>) -> Section {
    let first = [
        ("parameters", false),
        ("shots", false),
        ("culled, worst shot", true),
        ("culled sideways", true),
        ("kept sideways", true),
    ];
    let columns = [&first[..], &RATES, timed.map_or(&[], |_| &[MS])].concat();
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
    let caption = format!(
        "Usual: {}. Chosen: {}. Sideways: on the strafes of these shots alone.{}",
        worded(&usual.trial),
        worded(&best.trial),
        timed.map_or("", |_| " Milliseconds: on the scene's path.")
    );
    let lead = format!(
        "Radius of median, dilation and erosion, levels of detail and the margin of depth in tests. The erosion takes the farthest of a square about every \
         texel, so that what stands in front shrinks. Allowed is to cull {culled} of what is seen on any shot and to keep {kept} of what is hidden. Each box \
         has a margin from which on it is kept: sorted, they give the least margin that culls no more than is allowed, exactly. With it all {tried} \
         combinations of the rest are tried, on a turn, a strafe and a walk from four places each, and the best {FINALISTS} again in all {} frames of these shots. \
         Chosen is the combination of least work that keeps what is allowed, or else the one that keeps least of what is hidden. It is reported on shots from \
         three other places.",
        MEASURED.len()
    );
    Section {
        id: "parameters".into(),
        title: "Parameters".into(),
        lead,
        blocks: vec![Block::Table(words::table(&columns, rows, &caption))],
    }
}
