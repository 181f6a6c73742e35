//! What came of a file's own statement, in words.

use super::Declared;
use super::statement::Axis;
use crate::audit::verdict::{long, number, place};

/// Letter, input, siting, formula.
pub(super) fn axis(axis: &Axis, letter: &str) -> [String; 4] {
    [letter.to_string(), axis.name.clone(), axis.siting.words().to_string(), axis.text.clone()]
}

/// All of it.
pub(super) fn paragraph(found: &Declared) -> String {
    let axes = found
        .axes
        .iter()
        .map(|[letter, name, siting, formula]| format!("{name} along {letter} at {siting}, by {formula}"));
    let axes: Vec<String> = axes.collect();
    let lobe = if found.lobe.is_empty() { String::new() } else { format!(", of {}", found.lobe) };
    let mut out = vec![format!(
        "{} says what it is (its attribute `lobefit`): {}{lobe}, with {}.",
        found.what,
        found.quantity,
        axes.join("; and ")
    )];
    out.push(if found.holds() {
        "That was read, held against the truth, and is so.".into()
    } else {
        format!(
            "That was read and held against the truth, and it is not so: it claims an error of {} at most.",
            number(found.claimed)
        )
    });
    for held in &found.held {
        out.push(format!(
            "Looked up as it says, {} is off by at most {} (RMS {}) over {} points of its domain, worst at {}, where it is {} and {} is true.",
            held.column.name(),
            number(held.max),
            number(held.rms),
            held.errors.len(),
            place(&held.at),
            long(held.value),
            long(held.truth),
        ));
    }
    if found.holds() {
        out.push(format!("It claims {}.", number(found.claimed)));
    }
    out.extend(found.instead.as_ref().map(|other| format!("It would be so with {other}.")));
    out.join(" ")
}
