//! The section of this effect in the include files: under each lobe its fits, then the functions of
//! its chains.

use std::collections::BTreeSet;

use super::Lobe;
use crate::approximate::Fit;
use crate::effects::BakeError;
use crate::effects::code::{constants, documented, function};
use crate::effects::parallax::probe;
use crate::effects::parallax::{Gives, LevelFunction, Spread, Variation};
use crate::emit::header;
use lobefit_shade::code::{self, Language};
use lobefit_shade::round_up;

/// The text of all lobes; empty where nothing is emitted.
pub(super) fn in_language(language: Language, lobes: &[Lobe]) -> Result<String, BakeError> {
    let (mut text, mut known) = (String::new(), BTreeSet::new());
    let lookups: Vec<probe::Wanted> =
        lobes.iter().flat_map(|lobe| &lobe.lookups).map(|l| l.wanted.clone()).collect();
    for lobe in lobes {
        for (fit, variation) in lobe.measured().filter(|(fit, _)| fit.emitted) {
            text += &function(language, fit, &lines(lobe, fit, variation))?;
        }
        for one in &lobe.functions {
            if known.insert(one.hypothesis.name().to_string()) {
                let lines = level_lines(lobe, one);
                let function = code::print(language, &one.hypothesis, &one.coefficients, &lines)?.text;
                text += &format!("\n{function}");
            }
        }
    }
    Ok(text + &probe::print(language, &lookups)?)
}

/// What a function holds of, so that it is not paired with another chain.
pub(super) fn paired(lobe: &Lobe) -> String {
    let (kernel, map) = (lobe.spec.kernel.clone(), lobe.spec.alpha_map.name());
    format!("for chains prefiltered with the {} lobe {}, alpha = {map}", kernel.word(), kernel.formula())
}

/// The header of a width: what it is, its error and its cost.
fn lines(lobe: &Lobe, fit: &Fit, variation: &Variation) -> Vec<String> {
    let a = &fit.approximation;
    let mut lines = documented(fit);
    let ops = header::operations(a.cost.ops);
    lines.push(format!("{}: {} {}, {}", a.name, a.quantity, a.column, paired(lobe)));
    lines.push(format!("{ops}; {}", constants(fit)));
    lines.extend(header::certificate_lines(
        "of the width, relative to the best one, where that is below 1",
        &a.certificate,
    ));
    lines.extend(header::half_line(a));
    let rows = [
        ("rho < 1", variation.nearer, lobe.least.nearer),
        ("rho > 1", variation.farther, lobe.least.farther),
    ];
    for (where_, spread, least) in rows {
        if let (Some(spread), Some(least)) = (spread, least) {
            lines.push(total(where_, &spread, &least));
        }
    }
    lines
}

pub(super) fn total(where_: &str, spread: &Spread, least: &Spread) -> String {
    let largest = round_up(spread.max, 4);
    let [mean, max, least_mean, least_max] = [spread.mean, largest, least.mean, least.max].map(header::short);
    format!(
        "total variation, {where_}: mean {mean}, max {max}; the best width leaves {least_mean}, {least_max}"
    )
}

/// The header of a function of levels.
fn level_lines(lobe: &Lobe, one: &LevelFunction) -> Vec<String> {
    let (chain, widest) = (one.chain.text(), one.chain.widest());
    let by = lobe.best().map_or("", |fit| &fit.approximation.name);
    let mut lines = match one.gives {
        Gives::Level => {
            vec![format!("Level of a roughness: {chain}. Domain: roughness [0, 1], else the nearer end.")]
        }
        Gives::Roughness => {
            vec![format!("Roughness of a level: {chain}. Domain: mip [0, {widest}], else the nearer end.")]
        }
        Gives::Adjusted => vec![
            format!(
                "Level to fetch for a lobe of level mip, seen from rho times the probe's distance: {chain}."
            ),
            format!("The width is that of {by}; at rho = 1 the level is mip."),
        ],
        Gives::Bias => one.hypothesis.doc().to_vec(),
    };
    let error = match one.gives {
        Gives::Level => "of the map, in levels",
        Gives::Roughness => "of the level there and back, in levels",
        Gives::Adjusted | Gives::Bias => "in levels, against the best width where that is below 1",
    };
    if matches!(one.gives, Gives::Adjusted | Gives::Bias) {
        let [roughness, rho] = [lobe.spec.roughness, lobe.spec.rho];
        lines.push(format!(
            "{}; roughness [{}, {}], rho [{}, {}]",
            paired(lobe),
            roughness[0],
            roughness[1],
            rho[0],
            rho[1]
        ));
    }
    let (max, at) = (one.error.max, header::place(&one.error.at));
    let ops = header::operations(one.hypothesis.tape().cost_ops());
    lines.push(format!("{ops}; error ({error}): max {max} at {at}; {} points in f32", one.error.points));
    lines
}
