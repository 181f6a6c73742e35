//! The furnace: spheres that should not be seen.

use super::{figures, selection, words};
use crate::report::{
    Block, Figure, Findings, Furnace, FurnaceRow, ReportError, Section, Shade, SphereRow, Spheres, check,
    numbers,
};

/// Side of a sphere's cell in pixels of the page.
pub(crate) const CELL: usize = 58;

/// The same where the spheres are a picture of their own.
const ALONE: usize = 78;

pub(crate) fn section(findings: &Findings) -> Result<Option<Section>, ReportError> {
    let Some(furnace) = &findings.furnace else { return Ok(None) };
    let limit = limit(furnace)?;
    let plain =
        spheres("the furnace, unamplified", furnace, &furnace.rows[..1], Shade::Radiance { white: 1.25 });
    let drawn =
        spheres("the furnace, departure amplified", furnace, &furnace.rows, Shade::Departure { limit });
    let caption = format!("{} {VANISHES}{}", amplified(furnace.amplification), absent(findings));
    let blocks = vec![
        figures(&[Spheres { unit: "radiance".into(), ..plain }], &plain_caption(furnace))?,
        figures(&[drawn], &caption)?,
        worst(furnace, &worst_caption("E N − 1")),
    ];
    Ok(Some(Section::new(
        "furnace",
        "The furnace",
        "Spheres of rising roughness under equal light from everywhere, with no absorption: whatever is not lost \
               must come back, so the right picture is an empty one.",
        blocks,
    )))
}

/// The spheres before and after, as the eye sees them: without compensation, and with the last that
/// the furnace shows, which is a fit where there are any. None where the scene called for no
/// furnace.
pub(crate) fn picture(findings: &Findings) -> Result<Option<String>, ReportError> {
    let Some(furnace) = &findings.furnace else { return Ok(None) };
    let after = furnace.rows.iter().skip(1).next_back();
    let rows: Vec<FurnaceRow> = furnace.rows.iter().take(1).chain(after).cloned().collect();
    let drawn = spheres("White spheres in a white furnace", furnace, &rows, Shade::Radiance { white: 1.25 });
    let svg = Spheres { unit: "radiance".into(), cell: ALONE, ..drawn }.svg()?;
    // The picture stands alone, on pages of any colour.
    Ok(Some(svg.replacen("<svg ", "<svg style=\"background:#fff\" ", 1)))
}

/// The spheres of one condition: as they are, amplified, and in figures.
pub(crate) fn panel(title: &str, furnace: &Furnace) -> Result<Vec<Block>, ReportError> {
    let limit = limit(furnace)?;
    let plain = spheres(
        &format!("{title}, unamplified"),
        furnace,
        &furnace.rows[..1],
        Shade::Radiance { white: 1.25 },
    );
    let drawn = spheres(&format!("{title}, amplified"), furnace, &furnace.rows, Shade::Departure { limit });
    let caption = format!("{} {VANISHES}", amplified(furnace.amplification));
    Ok(vec![
        figures(&[Spheres { unit: "radiance".into(), ..plain }], &plain_caption(furnace))?,
        figures(&[Spheres { unit: "E / lookup − 1".into(), ..drawn }], &caption)?,
        worst(furnace, &worst_caption("E / lookup − 1")),
    ])
}

/// The departure that gets the deepest colours.
pub(crate) fn limit(furnace: &Furnace) -> Result<f64, ReportError> {
    check::filled("furnace", "rows", furnace.rows.len())?;
    check::finite("furnace", "amplification", furnace.amplification)?;
    if furnace.amplification <= 0.0 {
        return Err(check::domain("furnace", "amplification", "must be positive"));
    }
    Ok(1.0 / furnace.amplification)
}

fn plain_caption(furnace: &Furnace) -> String {
    format!(
        "As the eye would see it: {} in an environment of radiance 1 (grey, so that gains would show too). What is \
         darker than its surroundings is energy lost to single scattering.",
        furnace.rows[0].name,
    )
}

/// How the colours of amplified spheres read.
pub(crate) fn amplified(times: f64) -> String {
    let deepest = numbers::brief(1.0 / times, 2);
    format!(
        "Departure from the environment, amplified {} times: grey is exact, the deepest blue a loss of {deepest} or more, \
         the deepest red a gain of {deepest} or more.",
        numbers::brief(times, 3),
    )
}

const VANISHES: &str = "A perfect compensation vanishes.";

/// What has no row.
fn absent(findings: &Findings) -> String {
    match selection::without_sphere(findings) {
        0 => String::new(),
        n => format!(
            " Not every normalisation has a row, only those selected for pictures under “Fits beside the truth”: {n} more are \
             listed with their largest furnace error under “What accuracy costs at run time”."
        ),
    }
}

/// Rows of a furnace, drawn.
pub(crate) fn spheres<'a>(
    title: &str,
    furnace: &'a Furnace,
    rows: &'a [FurnaceRow],
    shade: Shade,
) -> Spheres<'a> {
    Spheres {
        title: title.into(),
        column_name: "roughness".into(),
        columns: &furnace.roughness,
        mu: &furnace.mu,
        rows: rows.iter().map(|r| SphereRow { name: r.name.clone(), factors: &r.factors }).collect(),
        shade,
        unit: "E N − 1".into(),
        cell: CELL,
    }
}

/// The largest departure of every sphere in figures.
pub(crate) fn worst(furnace: &Furnace, caption: &str) -> Block {
    let columns = words::figures_after("roughness", furnace.roughness.iter().map(|&r| numbers::place(r)));
    let farthest = |factors: &Vec<f64>| {
        factors.iter().map(|f| f - 1.0).fold(0.0, |m: f64, d| if d.abs() > m.abs() { d } else { m })
    };
    let row = |r: &FurnaceRow| {
        let cells = r.factors.iter().map(|f| numbers::bound(farthest(f), 2));
        std::iter::once(r.name.clone()).chain(cells).collect()
    };
    Block::Table(words::table(&columns, furnace.rows.iter().map(row).collect(), caption))
}

fn worst_caption(what: &str) -> String {
    format!(
        "Largest signed departure {what} over each sphere, rounded away from zero. Where it is larger than the sphere looks, it is \
         at the rim: grazing views take up few pixels."
    )
}
