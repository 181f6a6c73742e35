//! What came of a file's own statement, in words.

use super::statement::Axis;
use super::{Declared, SLACK};
use crate::audit::column::Column;
use crate::audit::verdict::{Grade, Kind, Verdict, first_line, listed, long, number, place, said_limit};

/// Letter, input, registration, formula.
pub(super) fn axis(axis: &Axis, letter: &str) -> [String; 4] {
    [letter.to_string(), axis.name.clone(), axis.registration.words().to_string(), axis.text.clone()]
}

/// The verdict.
pub(super) fn verdict(found: &Declared, limit: Option<f64>) -> Verdict {
    Verdict {
        grade: if found.passes(limit) { Grade::Pass } else { Grade::Fail },
        headline: headline(found, limit),
        convention: convention(found),
        errors: errors(found, limit),
        furnace: None,
        remedy: Vec::new(),
        certainty: "the file says so; nothing else was tried.".into(),
    }
}

fn headline(found: &Declared, limit: Option<f64>) -> String {
    let held: Vec<&str> = found.held.iter().map(|held| held.column.name()).collect();
    let so = match limit {
        _ if !found.holds() => "is not what it says".to_string(),
        limit if found.figure(limit).is_some_and(|figure| figure.kind == Kind::Claim) => {
            format!("claims an error of {} at most", number(found.claimed))
        }
        _ => "is what it says".into(),
    };
    let off = found.figure(None).map_or(String::new(), |worst| {
        format!(", off by at most {} in lookups ({}; sampled)", number(worst.value), place(&worst.at))
    });
    let what = format!("{} {}: ", found.quantity, listed(&held));
    first_line([&what, &found.what, &format!(" {so}{off}")], &[], &said_limit(limit))
}

/// How the file says that it is read.
fn convention(found: &Declared) -> String {
    let axes = found.axes.iter().map(|[letter, name, registration, formula]| {
        format!("{name} along {letter} at {registration}, by {formula}")
    });
    let lobe = if found.lobe.is_empty() { String::new() } else { format!("of {}, ", found.lobe) };
    format!("{lobe}with {}.", axes.collect::<Vec<_>>().join("; and "))
}

/// The claim, and what was found.
fn errors(found: &Declared, limit: Option<f64>) -> Vec<String> {
    let held = found.held.iter().map(|held| {
        format!(
            "{} is off by at most {} (RMS {}), worst at {}, where it is {} and {} is true",
            held.column.name(),
            number(held.figures.max),
            number(held.figures.rms),
            place(&held.figures.at),
            long(held.figures.value),
            long(held.figures.truth),
        )
    });
    let points = found.held.first().map_or(0, |held| held.errors.len());
    let mut out = vec![claim(found)];
    out.push(format!(
        "Looked up as it says, sampled at {points} places of {}{}: {}.",
        domain(found),
        texels(found),
        held.collect::<Vec<_>>().join("; ")
    ));
    if !found.cut.is_empty() {
        let cut = found.cut.join(" and ");
        out.push(format!("The claim covers {cut} as well, where the truth is not had."));
    }
    if !found.beyond.is_empty() {
        out.push(format!(
            "Its axes cover {} as well, of which it claims nothing: that is not judged.",
            found.beyond.join(" and ")
        ));
    }
    out.extend(
        limit.map(|limit| {
            format!("The limit {limit} is judged at those lookups, at texels and between them.")
        }),
    );
    out
}

/// What it claims, and whether that is so.
fn claim(found: &Declared) -> String {
    let claimed = number(found.claimed);
    if !found.holds() {
        let far = if found.keeps() { ": no table of this quantity is so far off" } else { "" };
        return format!("It claims an error of {claimed} at most, and it is not so{far}.");
    }
    let above = found.held.iter().any(|held| held.figures.max > held.share() * found.claimed);
    let more = format!(
        ", where it was measured; here it is off by more, within the factor {SLACK} that other places may make"
    );
    let places = if above { more } else { String::new() };
    let difference = found.held.iter().any(|held| held.column == Column::A);
    let of =
        if difference { " of f0 A + B for every f0 in [0, 1], which leaves A alone twice that" } else { "" };
    format!("It claims {claimed}{of}{places}.")
}

/// The texels that were judged, if any were.
fn texels(found: &Declared) -> String {
    match found.size.iter().product::<usize>() > found.texels {
        _ if found.texels == 0 => String::new(),
        true => format!(" and at {} of its texels", found.texels),
        false => " and at its texels".into(),
    }
}

/// The ranges that were judged.
fn domain(found: &Declared) -> String {
    let one = |(name, list): &(&str, Vec<f64>)| {
        let ends = list.first().zip(list.last());
        ends.map(|(from, to)| format!("{name} {} to {}", long(*from), long(*to)))
    };
    found.places.iter().filter_map(one).collect::<Vec<_>>().join(", ")
}
