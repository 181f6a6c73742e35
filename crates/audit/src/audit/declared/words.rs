//! What came of a file's own statement, in words.

use super::statement::Axis;
use super::{Declared, SLACK};
use crate::audit::column::Column;
use crate::audit::verdict::{long, number, place};

/// Letter, input, registration, formula.
pub(super) fn axis(axis: &Axis, letter: &str) -> [String; 4] {
    [letter.to_string(), axis.name.clone(), axis.registration.words().to_string(), axis.text.clone()]
}

/// All of it.
pub(super) fn paragraph(found: &Declared) -> String {
    let axes = found.axes.iter().map(|[letter, name, registration, formula]| {
        format!("{name} along {letter} at {registration}, by {formula}")
    });
    let axes: Vec<String> = axes.collect();
    let lobe = if found.lobe.is_empty() { String::new() } else { format!(", of {}", found.lobe) };
    let mut out = vec![format!(
        "{} says what it is: {}{lobe}, with {}.",
        found.what,
        found.quantity,
        axes.join("; and ")
    )];
    out.push(if found.holds() {
        "That was read, held against the truth, and is so.".into()
    } else if found.keeps() {
        format!(
            "That was read and held against the truth, and it is not so, for all that it claims an error of {} at most: no table of this is so \
             far off.",
            number(found.claimed)
        )
    } else {
        format!(
            "That was read and held against the truth, and it is not so: it claims an error of {} at most.",
            number(found.claimed)
        )
    });
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
    out.push(format!(
        "Looked up as it says, over {points} points of {}: {}.",
        domain(found),
        held.collect::<Vec<_>>().join("; ")
    ));
    if found.holds() {
        let above = found.held.iter().any(|held| held.figures.max > held.share() * found.claimed);
        let more = format!(
            ", where it was measured; here it is off by more, within the factor {SLACK} that other places may make"
        );
        let places = if above { more } else { String::new() };
        let difference = found.held.iter().any(|held| held.column == Column::A);
        let of = if difference {
            " of f0 A + B for every f0 in [0, 1], which leaves A alone twice that"
        } else {
            ""
        };
        out.push(format!("It claims {}{of}{places}.", number(found.claimed)));
    }
    if !found.cut.is_empty() {
        out.push(format!(
            "It claims that of {} as well, where the truth is not had.",
            found.cut.join(" and ")
        ));
    }
    if !found.beyond.is_empty() {
        out.push(format!(
            "Its axes cover {} as well, of which it claims nothing: that is not judged.",
            found.beyond.join(" and ")
        ));
    }
    out.join(" ")
}

/// The ranges that were judged.
fn domain(found: &Declared) -> String {
    let one = |(name, list): &(&str, Vec<f64>)| {
        let ends = list.first().zip(list.last());
        ends.map(|(from, to)| format!("{name} {} to {}", long(*from), long(*to)))
    };
    found.places.iter().filter_map(one).collect::<Vec<_>>().join(", ")
}
