//! Which approximations have pictures, and where the others are.

use super::words;
use crate::data::Use;
use crate::report::{ApproximationFinding, AverageFinding, Block, Findings, FitFinding};

/// What the section of the fits shows, and what it leaves to the table.
pub(super) fn shown(
    fits: &[FitFinding],
    averages: Option<&AverageFinding>,
    approximations: &[ApproximationFinding],
) -> Vec<Block> {
    let mut texts = Vec::new();
    let pictured = match fits {
        [] => None,
        [fit] => Some(format!("One fit has pictures: {} ({}).", fit.name, fit.shown_as)),
        fits => Some(format!(
            "{} with pictures: {}. First all of these on one colour scale, then the most accurate of the frontier in one chart \
             per roughness, then each by itself on its own scale.",
            words::count(fits.len(), "fit", "fits"),
            reasons(fits).join("; "),
        )),
    };
    let curves = averages.map_or_else(String::new, |a| {
        format!(" The fits of {} follow at the end, as curves over roughness.", a.name)
    });
    texts.extend(pictured.map(|text| text + &curves));
    let averaged = averages.iter().flat_map(|a| &a.fits).map(|f| &f.name);
    let pictured: Vec<&String> = fits.iter().map(|f| &f.name).chain(averaged).collect();
    let plain = approximations.iter().filter(|a| !a.table && !pictured.contains(&&a.name));
    let rest: Vec<&str> = plain.map(|a| a.name.as_str()).collect();
    if !rest.is_empty() {
        texts.push(format!(
            "Without pictures, but listed with error and cost under “What accuracy costs at run time”: {}.",
            rest.join(", "),
        ));
    }
    texts.into_iter().map(|text| Block::Text { text }).collect()
}

/// `11 on the frontier`, one for each reason, in the order of their first fit.
fn reasons(fits: &[FitFinding]) -> Vec<String> {
    let groups = lobefit_math::groups(fits, |fit| &fit.shown_as).into_iter();
    groups.map(|(reason, fits)| format!("{} {reason}", fits.len())).collect()
}

/// Formulas that would have a place in the furnace and none there.
pub(super) fn without_sphere(findings: &Findings) -> usize {
    let rows = findings.furnace.iter().flat_map(|f| &f.rows).map(|r| &r.name).collect::<Vec<_>>();
    let normalises = |a: &&ApproximationFinding| a.used_as == Use::NORMALISATION && !rows.contains(&&a.name);
    findings.approximations.iter().filter(normalises).count()
}
