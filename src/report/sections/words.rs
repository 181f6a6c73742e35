//! Words and numbers that several sections use.

use std::collections::BTreeMap;

use crate::data::Place;
use crate::report::numbers::{bound, brief, significant};
use crate::report::{Dot, Field, Ruler, TextTable};

/// Name of an input as its symbol.
pub fn symbol(name: &str) -> &str {
    match name {
        "mu" => "μ",
        "alpha" => "α",
        "rho" => "ρ",
        "phi" => "φ",
        other => other,
    }
}

/// Name of an axis with what it means.
pub fn axis(name: &str) -> String {
    match name {
        "mu" => "μ (cosine of view angle)".into(),
        "alpha" => "α (GGX width)".into(),
        "roughness" => "roughness".into(),
        other => symbol(other).into(),
    }
}

/// A field with its axes named for readers.
pub fn labelled(field: &Field) -> Field {
    let named = |r: &Ruler| Ruler { name: axis(&r.name), values: r.values.clone() };
    Field { x: named(&field.x), y: named(&field.y), ..field.clone() }
}

/// `μ 0.1, roughness 0.36`.
pub fn place(at: &Place) -> String {
    let parts: Vec<String> = at.iter().map(|(k, v)| format!("{}\u{a0}{}", symbol(k), brief(*v, 3))).collect();
    if parts.is_empty() { "–".into() } else { parts.join(", ") }
}

/// `μ 0.01 to 1, roughness 0.02 to 1`.
pub fn ranges(ranges: &BTreeMap<String, [f64; 2]>) -> String {
    let one = |(k, [a, b]): (&String, &[f64; 2])| match a == b {
        true => format!("{}\u{a0}{}", symbol(k), brief(*a, 3)),
        false => format!("{}\u{a0}{}\u{a0}to\u{a0}{}", symbol(k), brief(*a, 3), brief(*b, 3)),
    };
    ranges.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// A maximum, rounded up.
pub fn max(x: f64) -> String {
    bound(x, 4)
}

/// A mean or root mean square.
pub fn mean(x: f64) -> String {
    significant(x, 4)
}

/// `1 operation`, `13 operations`.
pub fn operations(n: u32) -> String {
    count(n as usize, "operation", "operations")
}

/// A number with its noun.
pub fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Whether points tell more than their rows in a table: three or more, not all at one place of the
/// horizontal axis.
pub fn worth_a_chart(dots: &[Dot]) -> bool {
    dots.len() >= 3 && dots.iter().any(|d| d.x != dots[0].x)
}

/// A table without muted rows, of columns as [`heads`] reads them.
pub fn table(columns: &str, rows: Vec<Vec<String>>, caption: &str) -> TextTable {
    let muted = vec![false; rows.len()];
    TextTable { columns: heads(columns), rows, muted, names: None, caption: caption.into() }
}

/// The heads of columns, with a bar between any two, and which columns are of figures: those marked by a
/// trailing `>`, as in `name|ops>|max>|where`.
pub fn heads(columns: &str) -> Vec<(String, bool)> {
    let head = |head: &str| match head.strip_suffix('>') {
        Some(figures) => (figures.to_string(), true),
        None => (head.to_string(), false),
    };
    let heads: Vec<_> = columns.split('|').map(head).collect();
    debug_assert!(heads.iter().all(|(name, _)| !name.is_empty()), "a head without a name: {columns}");
    heads
}

/// The heads of a column of names and of columns of figures.
pub fn figures_after(first: &str, heads: impl IntoIterator<Item = String>) -> String {
    heads.into_iter().fold(first.into(), |columns, head| format!("{columns}|{head}>"))
}
