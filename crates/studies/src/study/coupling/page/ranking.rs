//! Couplings by what is seen of them and by what they lose.

use crate::study::coupling::findings::{CouplingStudy, Ranked, Ranking};
use lobefit::report::numbers::{bound, place, significant};
use lobefit::report::{Block, Dot, ReportError, Scatter, Section, Spread, TextTable, check};
use lobefit::report::{figures, words};
use lobefit_math::ops;

pub(super) fn section(study: &CouplingStudy) -> Result<Section, ReportError> {
    check::filled("study", "rankings", study.rankings.len())?;
    let charts: Vec<Scatter> = study.rankings.iter().map(chart).collect();
    let caption = "Largest departure from white in the furnace against the mean HDR-FLIP under the environment; both logarithmic. What \
                   lies above the trend errs much where nobody looks, what lies below it errs little where everybody does. The two couplings \
                   that are exact in energy have no departure and are not drawn. Names ending in “perceptual”: constants fitted for what is \
                   seen; in “reciprocal”: made reciprocal. Ours have the number of their name here: 18 is coupling_normalised_18.";
    let mut blocks = vec![figures(&charts, caption)?];
    for ranking in &study.rankings {
        blocks.push(Block::Heading { text: format!("Specular lobe: {}", ranking.lobe) });
        blocks.push(Block::Table(table(ranking)));
        blocks.push(Block::Text { text: disagreement(ranking) });
        blocks.extend(refitted(ranking).map(|text| Block::Text { text }));
    }
    Ok(Section::new(
        "ranking",
        "What is seen, and what is lost",
        format!(
            "The reference is “1 - own specular”: 1 less the albedo of the lobe, as it is drawn, at the view, exactly what is left for the base \
             (all names: “What is compared”, below). FLIP measures how different two pictures look to somebody who flips between them: 0 no \
             visible difference, 1 the largest there is; the mean is over the pixels of all spheres of a lobe at f0 {}, each sphere compared \
             at the exposures at which it can be shown (HDR-FLIP).",
            list(study.rankings.first().map_or(&[], |r| r.f0.as_slice()))
        ),
        blocks,
    ))
}

fn list(values: &[f64]) -> String {
    values.iter().map(|&f0| place(f0)).collect::<Vec<_>>().join(", ")
}

fn chart(ranking: &Ranking) -> Scatter {
    let shown = ranking.rows.iter().filter(|r| r.flip > 0.0 && r.furnace_max > NOTHING);
    let prefix = format!("coupling_{}_", ranking.lobe);
    let dot = |r: &Ranked| Dot {
        name: r.name.strip_prefix(&prefix).unwrap_or(&r.name).into(),
        x: r.flip,
        y: r.furnace_max,
        published: !r.ours,
        table: false,
    };
    Scatter {
        title: format!("specular lobe: {}", ranking.lobe),
        x: ("mean HDR-FLIP under the environment".into(), Spread::Log),
        y: ("largest departure in the furnace".into(), Spread::Log),
        dots: shown.map(dot).collect(),
        size: (420.0, 340.0),
    }
}

/// Departures below this are the error of a furnace that is white by construction.
const NOTHING: f64 = 1e-6;

fn table(ranking: &Ranking) -> TextTable {
    let columns = "coupling|mean FLIP>|rank>|furnace max>|rank>|perceptual RMS>|rank>|to reciprocal>|ops>|texels>|reciprocity>";
    let by_flip = ranks(ranking, |r| r.flip);
    let by_max = ranks(ranking, |r| r.furnace_max);
    let by_weight = ranks(ranking, |r| r.perceptual);
    let row = |(i, r): (usize, &Ranked)| {
        let measured = |x: f64| if x < NOTHING { "0".into() } else { significant(x, 3) };
        vec![
            r.name.clone(),
            measured(r.flip),
            by_flip[i].to_string(),
            if r.furnace_max < NOTHING { "0".into() } else { words::max(r.furnace_max) },
            by_max[i].to_string(),
            measured(r.perceptual),
            by_weight[i].to_string(),
            measured(r.flip_reciprocal),
            r.ops.to_string(),
            r.fetches.to_string(),
            words::max(r.reciprocity),
        ]
    };
    let noise = ranking.rows.iter().fold(0.0, |m: f64, r| m.max(r.flip_error));
    let caption = format!(
        "Over f0 {}. Standard error of a mean FLIP: {} at most. Furnace max: largest |albedo − 1| of a white base over the roughnesses and μ of the \
         tables of the furnace, below. Perceptual RMS: the root of the mean square of the same departures, weighted over μ by what is seen of \
         them, as by lobefit fit --weight perceptual. To reciprocal: FLIP of the same pictures against Kelemen-Szirmay-Kalos, which is reciprocal \
         and exact in energy too; how far the two exact ones are apart is what choosing between them changes. Ops: operations of a channel that \
         the coupling adds to those of the lobe; texels: what lobe and coupling read. Reciprocity: the largest |f(l, v) − f(v, l)| of the base \
         alone over the mean of their sizes, as measured; 1e−14 and less is rounding. Ours in the colour of the text, others grey; the constants of a form that has any \
         minimise the largest error, or, where it says so, the perceptual RMS.",
        list(&ranking.f0),
        bound(noise, 1)
    );
    let mut table = words::table(columns, ranking.rows.iter().enumerate().map(row).collect(), &caption);
    table.muted = ranking.rows.iter().map(|r| !r.ours).collect();
    table
}

/// Place of each row by a measure, 1 for the least; equals share a place.
fn ranks(ranking: &Ranking, by: impl Fn(&Ranked) -> f64) -> Vec<usize> {
    let value = |r: &Ranked| if by(r) < NOTHING { 0.0 } else { by(r) };
    let rank = |r: &Ranked| 1 + ranking.rows.iter().filter(|other| value(other) < value(r)).count();
    ranking.rows.iter().map(rank).collect()
}

/// Where the orders differ, in words.
fn disagreement(ranking: &Ranking) -> String {
    let compared = |r: &&Ranked| r.flip > 0.0 && r.furnace_max > NOTHING && r.flip <= r.flip_reciprocal;
    let rows: Vec<&Ranked> = ranking.rows.iter().filter(compared).collect();
    let pairs = rows.len() * rows.len().saturating_sub(1) / 2;
    let by_max = reversed(&rows, |r| r.furnace_max);
    let by_weight = reversed(&rows, |r| r.perceptual);
    let counted = format!(
        "Of the {pairs} pairs of the {} inexact couplings that are not nearer to Kelemen-Szirmay-Kalos than to the reference, the largest \
         departure orders {} otherwise than FLIP does, the perceptual RMS {}",
        rows.len(),
        by_max.len(),
        by_weight.len(),
    );
    // How far both measures are apart, the smaller of the two ratios.
    let gap = |(better, worse): &(&Ranked, &Ranked)| {
        ops::log(worse.flip / better.flip).min(ops::log(better.furnace_max / worse.furnace_max))
    };
    let Some((better, worse)) = by_max.into_iter().max_by(|a, b| gap(a).total_cmp(&gap(b))) else {
        return format!("{counted}.");
    };
    format!(
        "{counted}. Most markedly, {} is seen less than {} (FLIP {} against {}) although its largest departure is larger ({} against {}).",
        better.name,
        worse.name,
        significant(better.flip, 2),
        significant(worse.flip, 2),
        words::max(better.furnace_max),
        words::max(worse.furnace_max),
    )
}

/// The coupling of ours that is seen least under the first lobe, beside the best published one; both
/// read no texel but those of the lobe.
pub(super) fn conclusion(study: &CouplingStudy) -> String {
    let Some(ranking) = study.rankings.first() else { return String::new() };
    let of_lobe = ranking.rows.iter().map(|row| row.fetches).min();
    let seen = || {
        let inexact = ranking.rows.iter().filter(|row| row.flip > 0.0 && row.furnace_max > NOTHING);
        inexact.filter(|row| Some(row.fetches) == of_lobe)
    };
    let least = |ours: bool| seen().filter(|row| row.ours == ours).min_by(|a, b| a.flip.total_cmp(&b.flip));
    let Some((best, theirs)) = least(true).zip(least(false)) else { return String::new() };
    format!(
        "Under the lobe “{}” {} ({} operations) has a mean FLIP of {} and departs from white by at most {}; {}, the best published coupling \
         that reads no table of its own, has {} and {}.\n",
        ranking.lobe,
        best.name,
        best.ops,
        significant(best.flip, 3),
        words::max(best.furnace_max),
        theirs.name,
        significant(theirs.flip, 3),
        words::max(theirs.furnace_max),
    )
}

/// What it changes to fit a form for what is seen instead of for the largest error, in words; none
/// where no form is fitted for both.
fn refitted(ranking: &Ranking) -> Option<String> {
    let one = |max: &Ranked| {
        let seen = ranking.rows.iter().find(|r| r.name == format!("{}, perceptual", max.name))?;
        Some(format!(
            "{}: FLIP {} instead of {}, largest departure {} instead of {}",
            max.name,
            significant(seen.flip, 2),
            significant(max.flip, 2),
            words::max(seen.furnace_max),
            words::max(max.furnace_max),
        ))
    };
    let all: Vec<String> = ranking.rows.iter().filter_map(one).collect();
    if all.is_empty() {
        return None;
    }
    Some(format!(
        "With constants that minimise the perceptual RMS instead of the largest error: {}.",
        all.join("; ")
    ))
}

/// Pairs of rows, which rise by FLIP, that another measure puts the other way round.
fn reversed<'a>(rows: &[&'a Ranked], by: impl Fn(&Ranked) -> f64) -> Vec<(&'a Ranked, &'a Ranked)> {
    let pairs = rows.iter().enumerate().flat_map(|(i, a)| rows[i + 1..].iter().map(move |b| (*a, *b)));
    pairs.filter(|(better, worse)| better.flip < worse.flip && by(better) > by(worse)).collect()
}
