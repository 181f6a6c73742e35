//! The page of a scene's culling: pictures, what each pass buys, and what parameters cost.

use crate::depth::{Depth, EMPTY};
use crate::measure::{TOLERANCE, Tally, error, part};
use crate::passes::{Passes, Work};
use crate::study::{ALL, ALLOWED, Choice, OnShots, Point, Results};
use lobefit::report::numbers::{brief, grouped};
use lobefit::report::{
    Block, Curves, Origin, Page, Pixels, ReportError, Section, Series, Spread, Style, TextTable, check,
    figures, words,
};
use lobefit::scene::CameraPath;

/// Depths of the lightest and of the darkest grey, metres.
const GREYS: [f32; 2] = [1.0, 120.0];
/// Relative errors up to which a texel is black, and of the full colours.
const RIGHT: f32 = 0.01;
const FULL: f32 = 0.2;
/// Size of a chart's plotted area in pixels.
const CHART: (f64, f64) = (430.0, 190.0);

/// The page.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn page(results: &Results, origin: Origin) -> Result<Page, ReportError> {
    let sections = vec![
        pictures(results)?,
        passes(results)?,
        parameters(results),
        sweeps(results)?,
        holes(results),
        resolutions(results),
    ];
    Ok(Page { title: "lobefit study: occlusion".into(), origin, lead: lead(results), sections })
}

fn percent(x: f64) -> String {
    // The sign stays on the line of its number.
    format!("{}\u{a0}%", brief(100.0 * x, 2))
}

/// What passes do on the path of the scene.
fn by(results: &Results, passes: Passes) -> Option<&Tally> {
    results.rows.iter().find(|row| row.trial.passes == passes).map(|row| &row.tally)
}

fn path(path: CameraPath) -> &'static str {
    match path {
        CameraPath::Turn => "turn",
        CameraPath::Strafe => "strafe",
        CameraPath::Walk => "walk",
    }
}

/// The conclusion, then what is simulated.
fn lead(results: &Results) -> String {
    let culling = &results.culling;
    let rates = |tally: &Tally| (percent(tally.wrongly_kept()), percent(tally.wrongly_culled()));
    let of = |passes: Passes| by(results, passes).map(rates).unwrap_or_default();
    let (alone, all, safe) = (of(Passes::POINTS), of(ALL), of(Passes::CONSERVATIVE));
    let [width, height] = culling.buffer;
    format!(
        "Where depth is {} frames old, its points alone keep {} of the boxes that the frame hides and cull {} of those that it shows; with \
         medians, voxels and dilation it is {} and {}, for what fills holes also closes gaps that are there; the conservative mode keeps {} and culls {}.\n\
         {}{} \
         A world of boxes is drawn on the CPU, with the camera on a path of {} frames; an occlusion buffer of {width} x {height} texels is made from the \
         depth that has arrived and is held against the depth of the frame itself, which only the study has. Work is texels and voxels read or \
         written, per texel of the buffer: a count, the same on every machine. All figures: results.json.",
        culling.latency,
        alone.0,
        alone.1,
        all.0,
        all.1,
        safe.0,
        safe.1,
        sideways(results),
        chosen(results),
        crate::study::FRAMES,
    )
}

/// What all passes of the scene do where the camera moves sideways, if that is not its path.
fn sideways(results: &Results) -> String {
    let culling = &results.culling;
    let here = |point: &&Point| {
        point.path == CameraPath::Strafe && point.speed == 1.0 && point.latency == culling.latency as usize
    };
    let point = results.sweep.iter().find(here).filter(|_| culling.path != CameraPath::Strafe);
    point.map_or(String::new(), |point| {
        format!(
            "That is on the path `{}`: with the camera moving sideways the points cull {} and all passes of the scene {}. ",
            path(culling.path),
            percent(point.points.wrongly_culled()),
            percent(point.all.wrongly_culled())
        )
    })
}

/// What the chosen parameters do on other shots, and whether they keep what is allowed.
fn chosen(results: &Results) -> String {
    let [_, Choice { trial, reported, .. }] = &results.choices;
    let kept = if reported.most_culled <= ALLOWED[0] { "no more" } else { "more" };
    format!(
        "Parameters that were chosen to cull at most {} ({}) cull {} on other shots, on the worst of these {} ({kept} than allowed), and keep {}.",
        percent(ALLOWED[0]),
        worded(&trial.passes, trial.bias),
        percent(reported.sum.wrongly_culled()),
        percent(reported.most_culled),
        percent(reported.sum.wrongly_kept())
    )
}

/// A grey for each depth, a colour for what is infinitely far, another where nothing was written.
fn depth(title: &str, depth: &Depth) -> Pixels {
    let level = |z: f32| match z {
        EMPTY => 0,
        f32::INFINITY => 1,
        _ => {
            let [near, far] = GREYS.map(lobefit_math::ops::logf);
            let t = ((lobefit_math::ops::logf(z) - near) / (far - near)).clamp(0.0, 1.0);
            2 + (t * 61.0).round() as u8
        }
    };
    let greys = (0..62_u32).flat_map(|i| [(235 - 3 * i) as u8; 3]);
    let palette = [0x8e, 0x24, 0xaa, 0xcf, 0xe6, 0xff].into_iter().chain(greys).collect();
    Pixels {
        title: title.into(),
        size: (depth.size[0], depth.size[1]),
        levels: depth.texels.iter().map(|z| level(*z)).collect(),
        palette,
    }
}

/// Yellow where a buffer is too near, cyan where it is too far, faint dots where nothing was
/// written.
fn errors(title: &str, found: &Depth, truth: &Depth) -> Pixels {
    let width = found.size[0];
    let level = |(i, (found, truth)): (usize, (&f32, &f32))| match error(*found, *truth) {
        None => u8::from((i % width + i / width).is_multiple_of(4) && (i / width).is_multiple_of(2)),
        Some(e) => {
            let t = (((e.abs() - RIGHT) / (FULL - RIGHT)).clamp(0.0, 1.0).sqrt() * 30.0).round() as u8;
            if e < 0.0 { 2 + t } else { 33 + t }
        }
    };
    let ramp = |colour: [u32; 3]| (0..31_u32).flat_map(move |i| colour.map(|c| (c * i / 30) as u8));
    let palette =
        [0, 0, 0, 96, 88, 20].into_iter().chain(ramp([255, 214, 0])).chain(ramp([0, 225, 255])).collect();
    Pixels {
        title: title.into(),
        size: (found.size[0], found.size[1]),
        levels: found.texels.iter().zip(&truth.texels).enumerate().map(level).collect(),
        palette,
    }
}

fn pictures(results: &Results) -> Result<Section, ReportError> {
    let shown = &results.pictures;
    let (all, sheet) =
        shown.buffers.split_last().ok_or_else(|| check::domain("study", "pictures", "there is none"))?;
    let first = [
        depth("the depth of the frame", &shown.truth),
        depth("the depth that has arrived", &shown.old),
        depth(all.0, &all.1),
    ];
    let made: Vec<Pixels> = sheet.iter().map(|(name, buffer)| depth(name, buffer)).collect();
    let others = shown.buffers.iter().filter(|(name, _)| *name != "voxels, median");
    let off: Vec<Pixels> = others.map(|(name, buffer)| errors(name, buffer, &shown.truth)).collect();
    Ok(Section {
        id: "pictures".into(),
        title: "One frame".into(),
        lead: format!(
            "A frame of the path `{}`, {} frames after the depth that has arrived.",
            path(results.culling.path),
            results.culling.latency
        ),
        blocks: vec![
            figures(
                &first,
                "What is wanted, what there is, and the occlusion buffer by all passes. Light is near, dark is far, blue is infinitely far.",
            )?,
            figures(&made, "The buffer by each way. Purple: nothing was written.")?,
            figures(
                &off,
                "The errors of these. Yellow is too near, false occlusion: what is behind it vanishes. Cyan is too far, false disocclusion: \
                           drawn in vain. Black is right within 1 %, full colours are off by 20 % or more. Faint dots: nothing was written, which hides nothing.",
            )?,
        ],
    })
}

/// A rate: its label, and what it is of a tally.
type Rate = (&'static str, fn(&Tally) -> f64);

/// A chart over linear axes of these labels.
fn curves(title: &str, [x, y]: [&str; 2], series: Vec<Series>, size: (f64, f64)) -> Curves {
    Curves {
        title: title.into(),
        x: (x.into(), Spread::Linear),
        y: (y.into(), Spread::Linear),
        series,
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size,
    }
}

/// A row of figures that every table has.
fn rates(tally: &Tally) -> [String; 6] {
    [
        percent(tally.wrongly_culled()),
        percent(part(tally.vanished, tally.seen)),
        percent(tally.wrongly_kept()),
        percent(part(tally.near, tally.texels)),
        percent(part(tally.holes, tally.texels)),
        brief(tally.work_per_texel(), 3),
    ]
}

const RATES: [(&str, bool); 6] = [
    ("wrongly culled", true),
    ("of which a pixel is seen", true),
    ("wrongly kept", true),
    ("texels too near", true),
    ("never written", true),
    ("work", true),
];

/// What buffers are made from, in the order of the table.
const SOURCES: [&str; 4] = ["depth", "depth of twice the resolution", "voxels", "depth and voxels"];

/// Work of each pass for each texel of the buffer.
fn split(results: &Results) -> TextTable {
    let columns = ["buffer", "points", "medians", "voxels", "dilation", "tests of boxes"];
    let columns = columns.map(|name| (name, name != "buffer"));
    let half = Passes { half: Some(true), ..Passes::NONE };
    let shown = [Passes::POINTS, half, ALL, Passes::CONSERVATIVE];
    let rows = results.rows.iter().filter(|row| shown.contains(&row.trial.passes)).map(|row| {
        let Work { reproject, median, voxels, dilation } = row.tally.work;
        let all = [reproject, median, voxels, dilation, row.tally.reads];
        let cells = all.map(|n| brief(part(n, row.tally.texels), 3));
        std::iter::once(row.name.clone()).chain(cells).collect()
    });
    let caption = "Work of each pass for each texel of the buffer. To keep the grid takes two more for each texel of a depth that arrives. \
                   Milliseconds, which differ from machine to machine: docs/occlusion.md.";
    words::table(&columns, rows.collect(), caption)
}

fn passes(results: &Results) -> Result<Section, ReportError> {
    let columns = [&[("buffer", false)][..], &RATES].concat();
    let rows =
        results.rows.iter().map(|row| std::iter::once(row.name.clone()).chain(rates(&row.tally)).collect());
    let first = results.rows.first().map(|row| row.tally).unwrap_or_default();
    let caption = format!(
        "Over {} frames, with {} boxes that the true depth shows and {} that it hides, by the same test of a box's rectangle. Too near: by more than {} of the depth. \
         The conservative mode reprojects depth of four times the resolution, keeps the farthest point, and knows nothing at edges.",
        first.frames,
        grouped(first.seen),
        grouped(first.hidden),
        percent(f64::from(TOLERANCE)),
    );
    let chart = |title: &str, y: &str, of: fn(&Tally) -> f64| {
        let line = |(i, source): (usize, &&str)| {
            let own = results.rows.iter().filter(|row| row.name.split(',').next() == Some(source));
            let points = own.map(|row| (row.tally.work_per_texel(), 100.0 * of(&row.tally)));
            let mut points: Vec<(f64, f64)> = points.collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            Series { name: (*source).into(), points, style: Style::Marked(i), end: None }
        };
        curves(title, ["work per texel", y], SOURCES.iter().enumerate().map(line).collect(), CHART)
    };
    let charts = [
        chart("What hiding costs", "wrongly kept, %", Tally::wrongly_kept),
        chart("What it endangers", "wrongly culled, %", Tally::wrongly_culled),
    ];
    Ok(Section {
        id: "passes".into(),
        title: "What each pass buys".into(),
        lead: "Points of old depth leave cracks, most of which a median closes, and what they never saw, which only voxels know. A voxel is as thick as it is \
               wide: it closes the holes of fences. Depth of twice the resolution leaves fewer cracks than a median does, at more work, and more of it is too near at edges."
            .into(),
        blocks: vec![
            Block::Table(words::table(&columns, rows.collect(), &caption)),
            figures(&charts, "Marks of a line, by rising work: its source alone, with the median, with the dilation, with both. Lower is better in both charts.")?,
            Block::Table(split(results)),
        ],
    })
}

fn sweeps(results: &Results) -> Result<Section, ReportError> {
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
            let name = format!("{}, {}", self::path(path), if all { "all passes" } else { "points" });
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

fn holes(results: &Results) -> Section {
    let row = |causes: &crate::study::Causes| {
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

fn resolutions(results: &Results) -> Section {
    let columns = [&[("buffer", false), ("voxels", false)][..], &RATES].concat();
    let rows = results.resolutions.iter().map(|one| {
        let ([w, h], voxels) = (one.buffer, one.voxels.map(|n| n.to_string()).join(" x "));
        [format!("{w} x {h}"), voxels].into_iter().chain(rates(&one.tally)).collect()
    });
    let caption = "With the passes of the scene; the conservative mode has its row above.";
    Section {
        id: "resolutions".into(),
        title: "Resolutions".into(),
        lead: "A grid of twice the voxel takes an eighth of the memory; texels that are too near grow with the size of voxels and of texels.".into(),
        blocks: vec![Block::Table(words::table(&columns, rows.collect(), caption))],
    }
}

/// `median 3 x 3, ...`.
fn worded(passes: &Passes, bias: f32) -> String {
    let square =
        |radius: usize| if radius == 0 { "none".into() } else { format!("{0} x {0}", 2 * radius + 1) };
    let voxels = match passes.voxels {
        None => "no voxels".into(),
        Some(lod) => format!("sub-voxels up to {} m, super-voxels beyond {} m", lod.near, lod.far),
    };
    format!(
        "median {}, dilation {}, erosion {}, {voxels}, margin {}",
        square(passes.median),
        square(passes.dilation),
        square(passes.erosion),
        percent(f64::from(bias))
    )
}

fn parameters(results: &Results) -> Section {
    let columns =
        [&[("parameters", false), ("shots", false), ("culled, worst shot", true)][..], &RATES].concat();
    let two = |name: &str, choice: &Choice| {
        let text = format!("{name}: {}", worded(&choice.trial.passes, choice.trial.bias));
        let row = |shots: &str, found: &OnShots| -> Vec<String> {
            let first = [text.clone(), shots.into(), percent(found.most_culled)];
            first.into_iter().chain(rates(&found.sum)).collect()
        };
        [row("chosen on", &choice.chosen), row("others", &choice.reported)]
    };
    let [own, best] = &results.choices;
    let rows = [two("usual", own), two("chosen", best)].concat();
    let [culled, kept] = ALLOWED.map(percent);
    let lead = format!(
        "Radius of median, dilation and erosion, levels of detail and the margin of depth in tests: all {} combinations on a turn, a strafe and a walk from \
         two places each. The erosion takes the farthest of a square about every texel, so that what stands in front shrinks. Allowed is to cull {culled} of what is seen on any \
         shot and to keep {kept} of what is hidden. Chosen is the combination of least work that culls at most half as much, for other shots are other, \
         or breaks this least. It is reported on shots from other places.",
        results.combinations
    );
    Section {
        id: "parameters".into(),
        title: "Parameters".into(),
        lead,
        blocks: vec![Block::Table(words::table(&columns, rows, ""))],
    }
}
