//! The experiment that the idea comes from.

use crate::study::page;
use crate::study::parallax::findings::{SeedCell, SeedFindings, SeedFit, SeedSlant};
use lobefit::report::numbers::{place, significant};
use lobefit::report::{Block, Curves, ReportError, Section, Series, Style, check};
use lobefit::report::{figures, words};

pub(super) fn sections(seed: &SeedFindings) -> Result<Vec<Section>, ReportError> {
    check::filled("seed", "cells", seed.cells.len())?;
    check::filled("seed", "slants", seed.slants.len())?;
    Ok(vec![cells(seed)?, slants(seed)?])
}

fn chart(title: String, series: [Series; 3], size: (f64, f64)) -> Curves {
    Curves { y_limits: Some((-0.1, 1.1)), ..page::chart(title, ["wall", ""], series.into(), size) }
}

fn cells(seed: &SeedFindings) -> Result<Section, ReportError> {
    let drawn: Vec<Curves> = seed.cells.iter().filter(|cell| cell.drawn).map(panel).collect();
    let caption = "Each cell: the lobe’s values over the wall, and the fetch from distance 1 that comes nearest, widened, scaled and shifted, or widened \
                   and scaled alone. Rows: α of the lobe; columns: its distance.";
    let mut blocks = vec![figures(&drawn, caption)?];
    for (energy, what) in [(false, "values"), (true, "energy per wall area")] {
        blocks.push(Block::Heading { text: format!("Lobes compared by their {what}") });
        let rows = seed.cells.iter().filter(|cell| cell.energy == energy).map(row).collect();
        let caption = "Offsets in units of the lobe’s peak; errors are root mean square differences over the window over that of the lobe. α′ = 1: \
                       saturated, where scale and offset cancel and neither means anything.";
        blocks.push(Block::Table(words::table(&COLUMNS, rows, caption)));
    }
    blocks.push(Block::Text { text: conclusion(&seed.cells) });
    Ok(Section {
        id: "seed".into(),
        title: "The experiment that the idea comes from".into(),
        lead: "A wall of half-width 1, one face of a cube; the lobe D(θ) of width α looks at it from a distance, the fetch D(θ) of width α′ from distance 1. \
               α′, a scale and an offset minimise the squared difference over the window: scale and offset follow from linear equations for every α′, \
               which alone is searched."
            .into(),
        blocks,
    })
}

fn panel(cell: &SeedCell) -> Curves {
    let title =
        format!("α {}, distance {}: α′ {}", place(cell.alpha), place(cell.distance), width(&cell.shifted));
    let [seen, shifted, plain] = &cell.curves;
    let series = [
        page::line("lobe", seen.clone(), Style::Truth),
        page::line("fetch, scaled and shifted", shifted.clone(), Style::Line(0)),
        page::line("fetch, scaled", plain.clone(), Style::Line(1)),
    ];
    chart(title, series, (210.0, 130.0))
}

fn width(fit: &SeedFit) -> String {
    if fit.saturated { "1".into() } else { significant(fit.alpha, 3) }
}

const COLUMNS: [(&str, bool); 8] = [
    ("α", true),
    ("distance", true),
    ("α′", true),
    ("scale", true),
    ("offset", true),
    ("error", true),
    ("α′ without offset", true),
    ("its error", true),
];

fn row(cell: &SeedCell) -> Vec<String> {
    let percent = |x: f64| format!("{:.2} %", 100.0 * x);
    vec![
        place(cell.alpha),
        place(cell.distance),
        width(&cell.shifted),
        significant(cell.shifted.scale, 3),
        // no -0.000
        format!("{:.3}", (1000.0 * cell.shifted.offset).round() / 1000.0 + 0.0),
        percent(cell.shifted.error),
        width(&cell.plain),
        percent(cell.plain.error),
    ]
}

/// The largest offset of open cells by both ordinates, and what follows.
fn conclusion(cells: &[SeedCell]) -> String {
    let largest = |energy: bool| {
        let open = cells.iter().filter(|cell| cell.energy == energy && !cell.shifted.saturated);
        open.map(|cell| cell.shifted.offset.abs()).fold(0.0, f64::max)
    };
    let plain = |energy: bool| {
        let open = cells.iter().filter(|cell| cell.energy == energy && !cell.shifted.saturated);
        open.map(|cell| cell.plain.error).fold(0.0, f64::max)
    };
    format!(
        "Where α′ is open, the offset of values reaches {}, that of energy per area {}; without an offset the error is at most {} % and {} %. The offset belongs to \
         the plot: D over t = tan θ is (1 + t²)²/(1 + t²/α²)², whose numerator is a pedestal that moves with the distance, and the cos³ θ between \
         values and energy per area cancels three quarters of it. A prefiltered texel holds energy, and no fetch can subtract light: everything \
         else here compares energy per wall area, with both integrals 1, so that α′ alone is left to choose.",
        significant(largest(false), 2),
        significant(largest(true), 2),
        significant(100.0 * plain(false), 2),
        significant(100.0 * plain(true), 2),
    )
}

fn slants(seed: &SeedFindings) -> Result<Section, ReportError> {
    let charts: Vec<Curves> = seed.slants.iter().flat_map(profiles).collect();
    let caption = "Values over the wall along the tilt, the shading point to the left, and across it. The best single fetch is scaled for the least \
                   squared difference over the square window.";
    let columns = [
        ("slant", true),
        ("α", true),
        ("α′", true),
        ("error of α", true),
        ("error of α′", true),
        ("half-width across", true),
        ("towards the point", true),
        ("away", true),
    ];
    let row = |s: &SeedSlant| {
        let percent = |x: f64| format!("{:.1} %", 100.0 * x);
        let mut cells = vec![format!("{}°", place(s.slant)), place(s.alpha), significant(s.best, 3)];
        cells.extend([s.same, s.error].map(percent));
        cells.extend(s.half.map(|h| significant(h, 3)));
        cells
    };
    let table = words::table(
        &columns,
        seed.slants.iter().map(row).collect(),
        "Half-widths: how far from the middle the lobe falls to half of its peak, in distances. Errors as above, each with its own best scale.",
    );
    Ok(Section {
        id: "seed-slant".into(),
        title: "Its negative result at a slant".into(),
        lead: "On a slanted wall one round fetch does not do: the footprint keeps its width across the tilt and grows a long tail along it, which no width \
               follows. Widening the fetch until the tail is covered blurs the centre, which had fitted without."
            .into(),
        blocks: vec![figures(&charts, caption)?, Block::Table(table)],
    })
}

fn profiles(slant: &SeedSlant) -> Vec<Curves> {
    let one = |(curves, way): (&[Vec<(f64, f64)>; 3], &str)| {
        let title = format!("{}°, {way} the tilt", place(slant.slant));
        let best = format!("best fetch, α′ {}", significant(slant.best, 3));
        let series = [
            page::line("lobe", curves[0].clone(), Style::Truth),
            page::line(best, curves[1].clone(), Style::Line(0)),
            page::line("fetch of α itself", curves[2].clone(), Style::Line(1)),
        ];
        chart(title, series, (400.0, 190.0))
    };
    slant.curves.iter().zip(["along", "across"]).map(one).collect()
}
