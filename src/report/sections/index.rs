//! The overview: what was called for, what was made, and where to read on.

use super::{called_for, words};
use crate::emit::manifest::{CostEntry, FitEntry, Manifest, TableEntry};
use crate::report::{Block, Section};

const COLUMNS: [(&str, bool); 9] = [
    ("effect", false),
    ("name", false),
    ("quantity", false),
    ("use", false),
    ("smith", false),
    ("max error", true),
    ("ops", true),
    ("fetches", true),
    ("bytes", true),
];

pub(super) fn sections(manifest: &Manifest) -> Vec<Section> {
    let mut sections = vec![called_for::of(&manifest.effects, &manifest.left_out)];
    if manifest.effects.is_empty() {
        return sections;
    }
    let links = manifest.effects.iter().map(|e| (e.effect.clone(), format!("{}.html", e.effect)));
    sections.push(Section {
        id: "pages".into(),
        title: "Pages".into(),
        lead: "One for each effect.".into(),
        blocks: vec![Block::Links { rows: links.collect() }],
    });
    sections.push(Section {
        id: "made".into(),
        title: "What was made".into(),
        lead: "Tables and formulas in the order of the manifest, which has all their figures.".into(),
        blocks: vec![Block::Table(words::table(
            &COLUMNS,
            rows(manifest),
            "The largest error of the use (lookup error of a table, furnace error of a normalisation), rounded up.",
        ))],
    });
    sections
}

/// Tables and fits by effect, in the order of the effects.
fn rows(manifest: &Manifest) -> Vec<Vec<String>> {
    let of_effect = |effect: &str| {
        let entries = manifest.entries.of(effect);
        let tables = entries.tables.iter().map(table).collect::<Vec<_>>();
        tables.into_iter().chain(entries.fits.iter().map(fit)).collect::<Vec<_>>()
    };
    manifest.effects.iter().flat_map(|e| of_effect(&e.effect)).collect()
}

fn table(t: &TableEntry) -> Vec<String> {
    let smith = t.smith.as_deref().unwrap_or_default();
    let [effect, name, quantity, used_as] = [&t.effect, &t.name, &t.quantity, &t.used_as].map(String::as_str);
    row([effect, name, quantity, used_as, smith], t.error.lookup.max, &t.cost)
}

fn fit(f: &FitEntry) -> Vec<String> {
    let smith = f.smith.as_deref().unwrap_or_default();
    let names = [&f.effect, &f.name, &f.quantity, &f.used_as].map(String::as_str);
    let [effect, name, quantity, used_as] = names;
    row([effect, name, quantity, used_as, smith], f.certificate.max_abs, &f.cost)
}

fn row(names: [&str; 5], max: f64, cost: &CostEntry) -> Vec<String> {
    let figures = [words::max(max), cost.ops.to_string(), cost.fetches.to_string(), cost.bytes.to_string()];
    names.into_iter().map(String::from).chain(figures).collect()
}
