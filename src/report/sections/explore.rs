//! The live page: its data, its controls, and still pictures in their place where nothing can be
//! drawn.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::answers::{self, Drawn};
use super::{figures, words};
use crate::emit::include::Include;
use crate::report::explore::{self, ExplorePage, Explored, ExploredApproximation, Standing, Times, document};
use crate::report::{Block, Page, ReportError, Section, Shade, SphereRow, Spheres, Spread};

/// Radiance of white: above 1, so that gains show too.
const WHITE: f64 = 1.25;

pub(super) fn page(explore: ExplorePage, code: &str, drawn: &Drawn) -> Result<Page, ReportError> {
    let ramp = STANDARD.encode(Shade::Signed { limit: 1.0, spread: Spread::Linear }.palette());
    let include = Include::with(drawn.files, Some(drawn.manifest));
    let shown = explore.effects.iter().flat_map(|effect| &effect.shown).flat_map(|one| &one.approximations);
    let time = |one: &ExploredApproximation| {
        let time = answers::time(Some(&one.name), drawn.record, include.as_ref())?;
        Some((one.name.clone(), (10.0 * time).round() / 10.0))
    };
    let device = drawn.record.map_or("", |record| &record.device.adapter);
    let times = Times { device: device.into(), microseconds: shown.filter_map(time).collect() };
    let data = document(&ramp, &times, &explore.effects)?;
    let is_lobe = |one: &Explored| one.drawn != explore::Drawn::Value;
    let furnace = explore.effects.iter().flat_map(|effect| &effect.shown).any(is_lobe);
    let furnace =
        if furnace { " In a white furnace a sphere that loses no energy cannot be seen." } else { "" };
    let conclusion = conclusion(explore.effects.iter().flat_map(|effect| &effect.shown));
    let first = explore.effects.iter().flat_map(|effect| &effect.shown).next();
    let still = first.map(still).transpose()?.into_iter().collect();
    let spheres = Section::new("spheres", "Spheres", "", vec![Block::Live { data, still }]);
    Ok(Page::new(
        explore.origin.title("lobefit live", ""),
        explore.origin.with_figures("../manifest.json"),
        format!(
            "{conclusion}Spheres drawn by {code}, beside the truth: choose what is approximated, by which formula or table, and for which \
             material.{furnace}"
        ),
        vec![spheres],
    ))
}

/// What the cheapest emitted function of each quantity is off by, in one sentence; empty where no function
/// is emitted.
fn conclusion<'a>(shown: impl Iterator<Item = &'a Explored>) -> String {
    let mut all: Vec<&ExploredApproximation> = Vec::new();
    for explored in shown {
        let emitted = explored.approximations.iter().find(|one| one.standing == Standing::Emitted);
        all.extend(emitted.filter(|one| !all.iter().any(|known| known.name == one.name)));
    }
    let off = all.iter().filter_map(|one| {
        let max = words::max(one.certificate.as_ref()?.max_abs);
        Some(format!("{} by {max} at most ({})", one.name, words::operations(one.cost.ops)))
    });
    let off: Vec<String> = off.collect();
    if off.is_empty() { String::new() } else { format!("Off from the truth: {}.\n", off.join("; ")) }
}

/// The spheres of the first picture.
fn still(explored: &Explored) -> Result<Block, ReportError> {
    let furnace = &explored.spheres;
    let rows = furnace.rows.iter().map(|row| SphereRow { name: row.name.clone(), factors: &row.factors });
    let spheres = Spheres {
        title: explored.title.clone(),
        column_name: "roughness".into(),
        columns: &furnace.roughness,
        mu: &furnace.mu,
        rows: rows.collect(),
        shade: Shade::Radiance { white: WHITE },
        unit: "radiance".into(),
        cell: super::furnace::CELL,
    };
    figures(&[spheres], &explored.lead)
}
