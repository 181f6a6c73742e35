//! Conventions and numbers in words.

use crate::audit::Audit;
use crate::audit::axis::{AxisReading, Input};
use crate::audit::convention::{COLUMN, Convention, NAMES};
use crate::audit::table::Source;
use lobefit::data::Place;

/// `E (the albedo), of separable Smith, with mu along x at texel centres`.
pub(super) fn reading(audit: &Audit) -> String {
    let best = audit.best();
    let holds: Vec<String> = audit
        .channels
        .iter()
        .filter_map(|c| Some((c, c.column?)))
        .map(|(c, column)| match audit.channels.len() {
            1 => column.words(),
            _ => format!("{} = {}", audit.channel(&c.name), column.words()),
        })
        .collect();
    // Of a table of two lobes they are printed before.
    let lobe = if audit.two_lobes.is_some() { String::new() } else { best.lobe.words() };
    let lobe = if lobe.is_empty() { String::new() } else { format!(", of {lobe}") };
    let slice = audit.at.map_or_else(String::new, |(input, x)| format!(", at {} {x}", input.name()));
    let decoded =
        audit.encoding.map_or_else(String::new, |e| format!(", its values {}", e.said("decoded from ")));
    format!("{}{lobe}{slice}, with {}{decoded}", holds.join(", "), axes(audit, audit.best()))
}

/// Every axis in words.
pub(super) fn axes(audit: &Audit, convention: &Convention) -> String {
    let one = |(k, a): (usize, &AxisReading)| {
        let name = &audit.axes[k];
        if audit.source == Source::Function {
            return format!("the argument {name} given {}", a.words());
        }
        let floor = if a.floor > 0.0 {
            format!(", {} clamped to {:?}", a.scale.input().name(), a.floor)
        } else {
            String::new()
        };
        // A falling axis and one whose texels lie the other way round are the same numbers.
        let lines = ["columns", "rows", "slices"][k];
        let flipped = if a.reversed { format!(" (or the {lines} are flipped)") } else { String::new() };
        format!("{}{flipped} along {name} at {}{floor}", a.words(), a.registration.words())
    };
    let all: Vec<String> = convention.axes.iter().enumerate().map(one).collect();
    all.join(", and ")
}

/// `left edges, i/n along x, y and z`: what is said of several axes in the same words, said once.
pub(in crate::audit) fn along(said: &[(String, String)]) -> Vec<String> {
    let mut groups: Vec<(&String, Vec<&str>)> = Vec::new();
    for (words, axis) in said {
        match groups.iter_mut().find(|g| g.0 == words) {
            Some(group) => group.1.push(axis),
            None => groups.push((words, vec![axis])),
        }
    }
    groups.iter().map(|(words, axes)| format!("{words} along {}", listed(axes))).collect()
}

/// The names of some axes.
pub(super) fn names(axes: &[String], some: &[usize]) -> String {
    listed(&some.iter().map(|axis| axes[*axis].as_str()).collect::<Vec<_>>())
}

/// `x`, `x and y`, `x, y and z`.
pub(in crate::audit) fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_string(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

/// What another convention has that the best one has not.
pub(super) fn readings_differ(audit: &Audit, best: &Convention, other: &Convention) -> String {
    let mut parts = Vec::new();
    if best.lobe != other.lobe {
        parts.push(other.lobe.words());
    }
    let mut said = Vec::new();
    for ((name, a), b) in audit.axes.iter().zip(&best.axes).zip(&other.axes) {
        if (a.scale, a.reversed) != (b.scale, b.reversed) {
            said.push((b.words(), name.clone()));
        }
        if a.registration != b.registration {
            said.push((b.registration.words().to_string(), name.clone()));
        }
    }
    parts.extend(along(&said));
    for (a, b) in best.columns.iter().zip(&other.columns) {
        if let (true, Some(b)) = (a != b, b) {
            parts.push(b.name().to_string());
        }
    }
    match parts.is_empty() {
        true if best == other => "as they are stored".into(),
        true if other.axes.iter().all(|axis| axis.floor == 0.0) => "unclamped".into(),
        true => "other clamps".into(),
        false => parts.join(", "),
    }
}

/// What says another convention than the one that it follows: `--smith says`.
pub(super) fn excluded(audit: &Audit) -> Option<String> {
    let option = audit.excluded?;
    Some(match option {
        NAMES => format!("{NAMES} say"),
        COLUMN => "--as says".into(),
        option if option.starts_with('-') => format!("{option} says"),
        _ => "the options say".into(),
    })
}

impl AxisReading {
    /// `roughness (alpha = roughness^2)`, `gloss = 1 - roughness`, `1 - mu`.
    pub fn words(&self) -> String {
        let name = self.scale.name();
        let base = match (self.scale.input(), self.reversed) {
            (Input::Alpha, true) => format!("gloss = 1 - {name}"),
            (_, true) => format!("1 - {name}"),
            (_, false) => name.to_string(),
        };
        let note = self.scale.note();
        if note.is_empty() { base } else { format!("{base} ({note})") }
    }
}

/// `alpha 0.25, mu 0.1`.
pub(crate) fn place(at: &Place) -> String {
    at.iter().map(|(k, v)| format!("{k} {}", number(*v))).collect::<Vec<_>>().join(", ")
}

/// Three significant digits.
pub(in crate::audit) fn number(x: f64) -> String {
    digits(x, 2)
}

/// Five.
pub(in crate::audit) fn long(x: f64) -> String {
    digits(x, 4)
}

/// With its sign.
pub(super) fn signed(x: f64) -> String {
    let sign = if x < 0.0 { "\u{2212}" } else { "+" };
    format!("{sign}{}", number(x.abs()))
}

/// A share with its sign.
pub(super) fn percent(x: f64) -> String {
    if x.abs() < 1e-6 { "0 %".into() } else { format!("{} %", signed(100.0 * x)) }
}

fn digits(x: f64, after: usize) -> String {
    if !x.is_finite() {
        return "any number of".into();
    }
    let rounded: f64 = format!("{x:.after$e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}
