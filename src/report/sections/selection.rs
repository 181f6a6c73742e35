//! Which approximations have pictures, and where the others are.

use super::words;
use crate::data::Use;
use crate::report::{ApproximationFinding, Block, Findings};

/// What the section of the fits shows, and what it leaves to the table.
pub(super) fn told(findings: &Findings) -> Vec<Block> {
    let mut texts = Vec::new();
    if !findings.fits.is_empty() {
        texts.push(format!(
            "{} with pictures: {}. First all of these on one colour scale, then the most accurate of the frontier in one chart \
             per roughness, then each by itself on its own scale.{}",
            words::count(findings.fits.len(), "fit", "fits"),
            reasons(findings).join("; "),
            findings.averages.as_ref().map_or_else(String::new, |a| format!(
                " The fits of {} follow at the end, as curves over roughness.",
                a.name
            )),
        ));
    }
    let rest: Vec<&str> = without_pictures(findings).map(|a| a.name.as_str()).collect();
    if !rest.is_empty() {
        texts.push(format!(
            "Without pictures, but listed with error and cost under “What accuracy costs at run time”: {}.",
            rest.join(", "),
        ));
    }
    texts.into_iter().map(|text| Block::Text { text }).collect()
}

/// `11 on the frontier`, one for each reason, in the order of their first fit.
fn reasons(findings: &Findings) -> Vec<String> {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for fit in &findings.fits {
        match counts.iter_mut().find(|c| c.0 == fit.shown_as) {
            Some(count) => count.1 += 1,
            None => counts.push((&fit.shown_as, 1)),
        }
    }
    counts.into_iter().map(|(reason, n)| format!("{n} {reason}")).collect()
}

fn without_pictures(findings: &Findings) -> impl Iterator<Item = &ApproximationFinding> {
    let pictured = |name: &str| {
        let averages = findings.averages.iter().flat_map(|a| &a.fits);
        findings.fits.iter().any(|f| f.name == name) || averages.into_iter().any(|f| f.name == name)
    };
    findings.approximations.iter().filter(move |a| !a.table && !pictured(&a.name))
}

/// Formulas that would have a place in the furnace and none there.
pub(super) fn without_sphere(findings: &Findings) -> usize {
    let rows = findings.furnace.iter().flat_map(|f| &f.rows).map(|r| &r.name).collect::<Vec<_>>();
    let normalises = |a: &&ApproximationFinding| a.used_as == Use::Normalisation && !rows.contains(&&a.name);
    findings.approximations.iter().filter(normalises).count()
}
