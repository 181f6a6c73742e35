//! The overview: what was called for, what was made, and where to read on.

use super::{called_for, words};
use crate::report::{Block, Index, IndexRow, Section};

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

pub(super) fn sections(index: &Index) -> Vec<Section> {
    let mut sections = vec![called_for::of(&index.effects, &index.left_out)];
    if index.effects.is_empty() {
        return sections;
    }
    let links = index.effects.iter().map(|e| (e.effect.clone(), format!("{}.html", e.effect)));
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
            index.rows.iter().map(row).collect(),
            "The largest error of the use (lookup error of a table, furnace error of a normalisation), rounded up.",
        ))],
    });
    sections
}

fn row(r: &IndexRow) -> Vec<String> {
    vec![
        r.effect.clone(),
        r.name.clone(),
        r.quantity.clone(),
        r.used_as.clone(),
        r.smith.clone(),
        r.max_error.map_or_else(|| "–".into(), words::max),
        r.ops.to_string(),
        r.fetches.to_string(),
        r.bytes.to_string(),
    ]
}
