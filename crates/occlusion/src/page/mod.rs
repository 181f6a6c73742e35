//! The page of a scene's culling: pictures, what each pass buys, and what parameters cost.

mod passes;
mod pictures;
mod sweeps;

use crate::choice::{ALLOWED, Choice};
use crate::grid::Lod;
use crate::measure::{Tally, Trial, part};
use crate::passes::Passes;
use crate::study::{ALL, Point, Results, Row, usual};
use crate::times::{Timed, Times};
use lobefit::report::numbers::brief;
use lobefit::report::{Origin, Page, ReportError};
use lobefit::scene::{CameraPath, World};

/// The page; of `times` what is of these results.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn page(results: &Results, times: Option<&Times>, origin: Origin) -> Result<Page, ReportError> {
    let timed = Times::of(times, &results.rows);
    let device = times.map_or("", |times| &times.device);
    let sections = vec![
        pictures::pictures(results)?,
        sweeps::holes(results),
        passes::passes(results, timed.as_deref().map_err(|why| *why), device)?,
        sweeps::parameters(results, timed.as_deref().ok()),
        sweeps::sweeps(results)?,
        passes::resolutions(results, timed.as_deref().ok())?,
    ];
    Ok(Page::new("lobefit study: occlusion", origin, lead(results), sections))
}

fn percent(x: f64) -> String {
    // The sign stays on the line of its number.
    format!("{}\u{a0}%", brief(100.0 * x, 2))
}

/// What a trial does on the path of the scene with its buffer and its grid, and what it takes.
fn by<'r>(
    results: &'r Results,
    timed: Option<&[&'r Timed]>,
    trial: Trial,
) -> Option<(&'r Row, Option<&'r Timed>)> {
    let own = own(results);
    let i = results.rows.iter().position(|row| own(row) && row.trial == trial)?;
    Some((&results.rows[i], timed.map(|timed| timed[i])))
}

/// Whether a row is of the scene's buffer and grid.
fn own(results: &Results) -> impl Fn(&Row) -> bool {
    let (buffer, voxels) = (results.culling.buffer.map(|n| n as usize), results.culling.grid);
    move |row| row.buffer == buffer && row.voxels.is_none_or(|own| own == voxels)
}

fn path(path: CameraPath) -> &'static str {
    match path {
        CameraPath::Turn => "turn",
        CameraPath::Strafe => "strafe",
        CameraPath::Walk => "walk",
    }
}

/// Which mode to take, then what is simulated.
fn lead(results: &Results) -> String {
    let culling = &results.culling;
    let rates = |tally: &Tally| (percent(tally.wrongly_kept()), percent(tally.wrongly_culled()));
    let of = |passes: Passes| {
        by(results, None, Trial::usual(passes)).map(|(row, _)| rates(&row.tally)).unwrap_or_default()
    };
    let (alone, all, safe) = (of(Passes::POINTS), of(ALL), of(Passes::CONSERVATIVE));
    let few = results.rows.first().map_or_else(String::new, |row| few(&row.tally));
    let [width, height] = culling.buffer;
    format!(
        "{few}Where nothing may vanish take the conservative mode: of depth that is {} frames old it culls {} of the boxes that the frame shows, and keeps \
         {} of those that it hides.\n\
         {} With medians, voxels and dilation {} are kept and {} culled{}: take these only where an object may be missing for some frames. What fills holes also closes gaps that are there; old points alone keep {} and cull {}. \
         {} is drawn on the CPU, with the camera on the path `{}` of {} frames; an occlusion buffer of {width} x {height} texels is made from the \
         depth that has arrived and is held against the depth of the frame itself, which only the study has. Work is texels and voxels read or \
         written, per texel of the buffer: a count, the same on every machine. All figures: results.json.",
        culling.latency,
        safe.1,
        safe.0,
        chosen(results),
        all.0,
        all.1,
        sideways(results),
        alone.0,
        alone.1,
        match culling.world {
            World::Generated(_) => "A world of boxes",
            World::Mesh(_) => "A mesh",
        },
        path(culling.path),
        crate::study::FRAMES,
    )
}

/// What is said of rates of so few boxes that one more or less would change them.
fn few(tally: &Tally) -> String {
    if tally.seen.min(tally.hidden) >= FEW {
        return String::new();
    }
    format!(
        "Too few boxes for rates to be relied on: {} that the frames show and {} that they hide. ",
        tally.seen, tally.hidden
    )
}

/// What all passes cull where the camera moves sideways, if that is not the scene's path.
fn sideways(results: &Results) -> String {
    let culling = &results.culling;
    let here = |point: &&Point| {
        point.path == CameraPath::Strafe && point.speed == 1.0 && point.latency == culling.latency as usize
    };
    // Of a scene that leaves passes out the sweep has other rates.
    let is_said = culling.path != CameraPath::Strafe && usual(culling) == Trial::usual(ALL);
    let point = results.sweep.iter().find(here).filter(|_| is_said);
    point.map_or(String::new(), |point| {
        format!(", and {} where the camera moves sideways", percent(point.all.wrongly_culled()))
    })
}

/// What the chosen parameters do on other shots, and whether they keep what is allowed there.
fn chosen(results: &Results) -> String {
    let Choice { trial, reported, .. } = &results.choices.best;
    let allowed = percent(ALLOWED[0]);
    let what = worded(trial);
    let worst = match percent(reported.most_culled) {
        // A digit more tells it from what is allowed.
        same if same == allowed => format!("{}\u{a0}%", brief(100.0 * reported.most_culled, 4)),
        other => other,
    };
    let rates = format!(
        "on other shots they cull {}, on the worst of these {worst}, and keep {}",
        percent(reported.sum.wrongly_culled()),
        percent(reported.sum.wrongly_kept())
    );
    if reported.most_culled <= ALLOWED[0] {
        format!(
            "Where {allowed} of them may, take the parameters that were chosen for that ({what}): {rates}."
        )
    } else {
        format!(
            "Where {allowed} of them may, nothing that was tried is certain to keep that: of the nearest parameters ({what}), {rates}."
        )
    }
}

/// Fewest boxes, shown and hidden, of which rates are rates.
const FEW: u64 = 200;

/// A rate: its label, and what it is of a tally.
type Rate = (&'static str, fn(&Tally) -> f64);

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

const RATES: &str =
    "wrongly culled>|of which a pixel is seen>|wrongly kept>|texels too near>|never written>|work per texel>";

/// `columns`, with that of times where there are any: it is empty of every row otherwise.
fn with_times(columns: &str, timed: Option<&[&Timed]>) -> String {
    format!("{columns}{}", if timed.is_some() { "|ms a frame>" } else { "" })
}

/// The cell of times, where they are recorded.
fn milliseconds(timed: Option<&Timed>) -> Option<String> {
    timed.map(|timed| brief(timed.milliseconds.total(), 3))
}

/// `median 3 x 3, ...`, whose numbers stay on the line of their units.
fn worded(Trial { passes, bias }: &Trial) -> String {
    let square = |radius: usize| match 2 * radius + 1 {
        1 => "none".into(),
        side => format!("{side}\u{a0}x\u{a0}{side}"),
    };
    let voxels = match passes.voxels {
        None => "no voxels".into(),
        Some(Lod { near, far }) => {
            format!("sub-voxels up to {near}\u{a0}m, super-voxels beyond {far}\u{a0}m")
        }
    };
    format!(
        "median {}, dilation {}, erosion {}, {voxels}, margin {}",
        square(passes.median),
        square(passes.dilation),
        square(passes.erosion),
        percent(f64::from(*bias))
    )
}
