//! Lobes and couplings as functions of two directions: who keeps energy, who keeps reciprocity, and
//! at what cost.

use crate::effects::coupling::results::CouplingLobe;
use crate::effects::coupling::surface::table::{ExchangeAt, FurnaceRow, ReciprocityRow};
use crate::report::numbers::{self, bound, brief, significant};
use crate::report::{Block, ReportError, Section, TextTable, check, words};

/// A furnace departure below this is the error of the measurement.
const CLOSED: f64 = 1e-5;

/// A departure from reciprocity below this is rounding: three products and a quotient of f64, of
/// sums that cancel by less than ten.
const ROUNDING: f64 = 1e-14;

/// Largest f0 of a dielectric that the picks are made for: an index of refraction of 2.6.
const DIELECTRIC: f64 = 0.2;

/// The section of the rows; rows must be there.
///
/// # Errors
/// Rows that are missing or not finite.
pub fn section(rows: &[ReciprocityRow]) -> Result<Section, ReportError> {
    check::filled("reciprocity", "rows", rows.len())?;
    for row in rows {
        let name = format!("{} {}", row.lobe, row.coupling.as_deref().unwrap_or_default());
        check::finite("reciprocity", &name, row.reciprocity)?;
        let furnace: Vec<f64> = row.furnace.iter().map(|f| f.worst).collect();
        check::values("reciprocity", &format!("{name}: furnace"), &furnace)?;
    }
    let (alone, over): (Vec<&ReciprocityRow>, Vec<&ReciprocityRow>) =
        rows.iter().partition(|row| row.coupling.is_none());
    let mut blocks = vec![Block::Table(lobes(&alone))];
    blocks.extend(picks(&over).map(|text| Block::Text { text }));
    let mut lobe = None;
    for (i, row) in over.iter().enumerate() {
        if lobe != Some(&row.lobe) {
            lobe = Some(&row.lobe);
            let of_lobe: Vec<&ReciprocityRow> =
                over[i..].iter().copied().take_while(|next| next.lobe == row.lobe).collect();
            blocks.push(Block::Heading { text: format!("White base under a lobe: {}", row.lobe) });
            blocks.push(Block::Table(couplings(&of_lobe)));
        }
    }
    Ok(Section::new(
        "reciprocity",
        "Energy and reciprocity",
        "Whole materials as functions f(l, v), integrated over the hemisphere as they are drawn. Furnace: what a white \
               material sends back less 1, the largest over roughness and angle; minus loses light, plus makes it. Reciprocity: the \
               largest |f(l, v) − f(v, l)| relative to the mean of their sizes, between 0 and 2, measured for all: 1e−14 and less is rounding. A path \
               tracer that connects paths from both ends needs that; a rasteriser does not.",
        blocks,
    ))
}

/// The section of a lobe; none where it was not measured.
pub(super) fn of_lobe(lobe: &CouplingLobe) -> Result<Option<Section>, ReportError> {
    let Some(measured) = &lobe.reciprocity else { return Ok(None) };
    let section = section(&measured.rows)?;
    let list = |values: &[f64]| values.iter().map(|x| numbers::place(*x)).collect::<Vec<_>>().join(", ");
    let lead = format!(
        "Whole materials as functions f(l, v) of the directions of light and view, integrated over the hemisphere as they are drawn: at \
         roughness {} and cosine of the view {} alone. Furnace: albedo of a white material minus 1, where its magnitude is largest; \
         minus loses light, plus makes it. The tables above look at the whole domain, where errors are larger, at grazing above all. \
         Reciprocity: the largest |f(l, v) − f(v, l)| relative to their mean there, between 0 and 2. A path tracer that connects paths \
         from both ends needs 0; a rasteriser does not. All lobes, couplings and places are those of the study, \
         “lobefit report --study coupling”.",
        list(&measured.places.roughness),
        list(&measured.places.mu),
    );
    Ok(Some(Section::new(
        format!("{}-{}", section.id, lobe.specular),
        format!("{}, {} lobe", section.title, lobe.specular),
        lead,
        section.blocks,
    )))
}

fn lobes(rows: &[&ReciprocityRow]) -> TextTable {
    let columns = "lobe|furnace at f0 = 1>|reciprocity>|where|ops>|texels>";
    let row = |row: &&ReciprocityRow| {
        vec![
            row.lobe.clone(),
            row.worst().map_or("–".into(), |f| departure(f.worst)),
            exchange(row),
            place(row),
            row.ops.to_string(),
            row.fetches.to_string(),
        ]
    };
    words::table(
        columns,
        rows.iter().map(row).collect(),
        "Specular lobes alone. Operations are those of one channel beyond the bare lobe, by the project's operation model; texels are \
         reads of (A, B), constants of the material are free.",
    )
}

fn couplings(rows: &[&ReciprocityRow]) -> TextTable {
    let furnace = rows.first().map(|row| row.furnace.as_slice()).unwrap_or_default();
    let columns = words::figures_after("base", furnace.iter().map(|f| format!("f0 {}", brief(f.f0, 3))));
    let row = |row: &&ReciprocityRow| {
        let mut cells = vec![row.coupling.clone().unwrap_or_default()];
        cells.extend(row.furnace.iter().map(|f| departure(f.worst)));
        cells.extend([exchange(row), place(row), row.ops.to_string(), row.fetches.to_string()]);
        cells
    };
    words::table(
        &(columns + "|reciprocity>|where|ops>|texels>"),
        rows.iter().map(row).collect(),
        "Lobe and base together. Columns of f0: furnace, two digits, 0 if closed to the error of the measurement. Where: the two cosines that are \
         exchanged. Names ending in “reciprocal”: the factor at the light times that at the view over its average. Own specular: the albedo of \
         the lobe above, as it is drawn.",
    )
}

fn departure(x: f64) -> String {
    if x.abs() < CLOSED { "0".into() } else { significant(x, 2) }
}

fn exchange(row: &ReciprocityRow) -> String {
    bound(row.reciprocity, if kept(row) { 1 } else { 3 })
}

/// Whether the two directions can be exchanged, but for rounding, as it was measured.
fn kept(row: &ReciprocityRow) -> bool {
    row.reciprocity < ROUNDING
}

fn place(row: &ReciprocityRow) -> String {
    if kept(row) {
        return if row.reciprocity > 0.0 { "rounding" } else { "–" }.into();
    }
    let ExchangeAt { alpha, mu_l, mu_v, .. } = row.at;
    format!("α\u{a0}{}, μ\u{a0}{}\u{a0}↔\u{a0}{}", brief(alpha, 2), brief(mu_l, 2), brief(mu_v, 2))
}

/// What each kind of author may want: the cheapest that closes the furnace and is reciprocal, the
/// cheapest that closes it, and the least wrong without a texel.
fn picks(rows: &[&ReciprocityRow]) -> impl Iterator<Item = String> {
    let dielectric = |f: &&FurnaceRow| f.f0 <= DIELECTRIC;
    let worst = |row: &ReciprocityRow| {
        row.furnace.iter().filter(dielectric).fold(0.0_f64, |worst, f| worst.max(f.worst.abs()))
    };
    let least_lost = |row: &ReciprocityRow| (row.fetches, row.ops);
    let cheapest = |keep: &dyn Fn(&ReciprocityRow) -> bool| {
        rows.iter().filter(|row| keep(row)).min_by_key(|row| least_lost(row)).copied()
    };
    let closed = |row: &ReciprocityRow| worst(row) < CLOSED;
    let path_tracer = cheapest(&|row| kept(row) && closed(row));
    let game = cheapest(&|row| closed(row));
    let free = rows
        .iter()
        .filter(|row| row.fetches == 0)
        .min_by(|a, b| worst(a).total_cmp(&worst(b)).then(a.ops.cmp(&b.ops)))
        .copied();
    let told = |who: &str, row: Option<&ReciprocityRow>| {
        row.map(|row| {
            format!(
                "{who}: {} over “{}”, {} and {}, furnace {} up to f0 {}, reciprocity {}.",
                row.lobe,
                row.coupling.as_deref().unwrap_or_default(),
                words::operations(row.ops),
                words::count(row.fetches as usize, "texel", "texels"),
                departure(worst(row)),
                brief(DIELECTRIC, 2),
                exchange(row),
            )
        })
    };
    [
        told("The cheapest that closes the furnace and is reciprocal", path_tracer),
        told("The cheapest that closes the furnace", game),
        told("The least wrong without a texel", free),
    ]
    .into_iter()
    .flatten()
}
