//! What a furnace found, in a line and at most five points.

use std::f64::consts::PI;

use lobefit::report::numbers::{brief, significant};
use lobefit::report::words;
use serde::Serialize;

use super::measure::{Cell, DARK, Energy, Furnace};
use super::roles::{Role, is_f0};
use crate::audit::{Grade, first_line, place};

/// The verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judgement {
    /// In one word: unknown where the error bars of an energy hold the limit.
    pub grade: Grade,
    /// The verdict in a line.
    pub line: String,
    /// What was found, each with its name.
    pub points: Vec<String>,
}

/// What is allowed above 1, and of f(l, v) beside f(v, l), where no limit is given: errors of
/// quadrature and of f32 stay below it.
const ALLOWED: f64 = 5e-3;

/// A difference of f(l, v) and f(v, l) that is rounding.
const AGREES: f64 = 1e-4;

/// What a function may do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Allowance {
    /// The largest energy above 1, and the largest difference of f(l, v) and f(v, l); `ALLOWED` where it
    /// is not given.
    pub limit: Option<f64>,
    /// The largest energy below 1; any where it is not given: a lobe alone loses light between facets.
    pub loss: Option<f64>,
    /// Whether it may differ for directions that are exchanged, by whatever much.
    pub one_way: bool,
}

/// The verdict on a function.
pub fn judgement(name: &str, found: &Furnace, allowance: Allowance) -> Judgement {
    let limit = allowance.limit;
    let allowed = limit.unwrap_or(ALLOWED);
    let (cell, channel) = &found.most;
    let most = cell.energy[*channel];
    let broken = &found.reciprocity;
    let gains = most.value - most.error > 1.0 + allowed;
    // Without symmetry to go by, whose cosine is missing cannot be known.
    let unsure = allowance.one_way && found.cosine.known == "assumed";
    let lossy = |least: f64| allowance.loss.is_some_and(|loss| least < 1.0 - loss);
    let least = found.least.0.energy[found.least.1];
    // Of a function that may hold the cosine already the energies are bounds from below.
    let loses = lossy(least.value + least.error) && !unsure;
    let may_gain = most.value + most.error > 1.0 + allowed;
    let may_lose = lossy(least.value - least.error);
    let open = may_gain || may_lose || unsure;
    let one_way = broken.share > allowed && !allowance.one_way;
    let unusable = found.unusable.is_some();
    let grade = match (gains || loses || one_way || unusable, open) {
        (true, _) => Grade::Fail,
        (false, true) => Grade::Unknown,
        (false, false) => Grade::Pass,
    };
    let word = grade.word();
    let mut wrong = Vec::new();
    if unsure && !gains {
        wrong.push("leaves out the light's cosine, or holds it (`--cosine included` or `--cosine absent` says which)");
    } else {
        // In a failure what is sure is said.
        let said = |sure: bool, may: bool| if grade == Grade::Fail { sure } else { may };
        wrong.extend(said(gains, may_gain).then_some("gains energy"));
        wrong.extend(said(loses, may_lose).then_some("loses energy"));
    }
    if one_way {
        wrong.push("is not reciprocal");
    }
    if unusable {
        wrong.push("has values that are no reflectance");
    }
    let what = match (wrong.is_empty(), allowance.one_way) {
        (true, false) => "neither gains energy nor prefers a direction".into(),
        (true, true) => "gains no energy".into(),
        (false, _) => wrong.join(" and "),
    };
    let what = if grade == Grade::Unknown { format!("may be one that {what}") } else { what };
    let is_limited = limit.is_some() || allowance.loss.is_some();
    let allowed_by = if is_limited { format!("; the limit is {allowed}") } else { String::new() };
    let gained =
        format!("; the largest energy sampled is {} at {}{allowed_by}", energy(most), place(&cell.at));
    let lost = allowance.loss.map(|loss| {
        let lost = Energy { value: 1.0 - least.value, ..least };
        format!(
            "; the largest loss sampled is {} at {}, where {loss} may be lost",
            energy(lost),
            place(&found.least.0.at)
        )
    });
    let swapped = one_way.then(|| {
        let share = significant(100.0 * broken.share, 2);
        format!("; f(l, v) and f(v, l) differ by {share} % at {}{allowed_by}", place(&broken.at))
    });
    // What the verdict is for stands first.
    let mut facts: Vec<(bool, String)> = vec![(gains || may_gain, gained)];
    facts.extend(lost.map(|lost| (may_lose, lost)).into_iter().chain(swapped.map(|swapped| (true, swapped))));
    facts.sort_by_key(|(decides, _)| !decides);
    let (first, more) = facts.split_first().map_or(("", &[][..]), |(first, more)| (first.1.as_str(), more));
    let more: Vec<String> = more.iter().map(|fact| fact.1.clone()).collect();
    let rest = first_line(["white furnace: ", name, &format!(" {what}{first}")], &more, "");
    Judgement { grade, line: format!("{word} {rest}"), points: points(found, gains) }
}

/// What stands between an energy and its error.
pub(super) const BAR: &str = " \u{b1} ";

/// An energy with its error, which every one has: a quadrature's, or that of f32.
pub(super) fn energy(e: Energy) -> String {
    let digits = if e.error < 5e-6 { 5 } else { 4 };
    format!("{}{BAR}{}", brief(e.value, digits), brief(e.error, 1))
}

fn points(found: &Furnace, gains: bool) -> Vec<String> {
    let of = |(cell, channel): &(Cell, usize)| {
        let name = match found.channels.len() {
            1 => String::new(),
            _ => format!(" of {}", found.channels[*channel]),
        };
        format!("{}{name} at {}", energy(cell.energy[*channel]), place(&cell.at))
    };
    let (most, least) = (found.most.0.energy[found.most.1].value, found.least.0.energy[found.least.1]);
    let nearly = |factor: f64| (0.9..=1.05).contains(&(most / factor));
    let advice = match gains {
        true if nearly(PI) => " It is nearly pi: is the division by pi left to the caller?",
        true if nearly(4.0) => " It is nearly 4: is the 4 of D G F/(4 (n.l) (n.v)) missing?",
        true => " More comes back than came in: a light in such a room grows brighter at every bounce.",
        false if nearly(1.0 / PI) => " It is nearly 1/pi: is a division by pi done twice?",
        false if nearly(0.25) => " It is nearly 1/4: is the 4 of D G F/(4 (n.l) (n.v)) there twice?",
        false => "",
    };
    // What the error may make up for is no loss.
    let lost = if least.value + least.error < 0.99 {
        format!(" {} % of the light is lost there.", significant(100.0 * (1.0 - least.value), 3))
    } else {
        String::new()
    };
    let broken = &found.reciprocity;
    let swapped = if broken.share < AGREES {
        format!("f(l, v) and f(v, l) agree within {} %.", 100.0 * AGREES)
    } else {
        format!(
            "f(l, v) and f(v, l) differ by {} % of the larger at most: {} and {} at {}.",
            significant(100.0 * broken.share, 2),
            significant(broken.values[0], 4),
            significant(broken.values[1], 4),
            place(&broken.at)
        )
    };
    let cosine = match (found.cosine.known, found.cosine.included) {
        ("found", true) => {
            "the function holds the cosine of the light: f/cos is symmetric, or nearer to it than f."
        }
        ("found", false) => {
            "the function holds no cosine of the light: f itself is symmetric, or nearer to it than f/cos."
        }
        ("stated", true) => "the function is said to hold the cosine of the light.",
        ("stated", false) => "the function is said to hold no cosine of the light.",
        _ => {
            "neither f nor f/cos is symmetric: the function is taken for one without the cosine of the light (`--cosine included` or `--cosine absent` says which)."
        }
    };
    let given: Vec<String> = found.arguments.iter().map(|(name, role)| format!("{name} = {role}")).collect();
    let white = Role::White.words();
    let f0 = found.arguments.iter().filter(|(name, role)| *role == white && is_f0(name));
    let f0: Vec<&str> = f0.map(|(name, _)| name.as_str()).collect();
    let hidden = match f0.is_empty() {
        true => String::new(),
        false => format!(
            " Where {} is 1 a Fresnel term is 1 throughout: f(l, v) and f(v, l) are compared at {DARK} as well.",
            f0.join(" or ")
        ),
    };
    let mut points = vec![
        format!("Energy: {} at most.{advice} {} at least.{lost}", of(&found.most), of(&found.least)),
        format!("Reciprocity: {swapped}"),
        format!("Cosine: {cosine}"),
        format!("Arguments: {}.{hidden}", given.join(", ")),
    ];
    if let Some(bad) = &found.unusable {
        let so = words::count(bad.points, "point", "points");
        points.insert(0, format!("Values: {} at {}; so at {so}.", bad.value, place(&bad.at)));
    }
    points
}
