//! What the scene called for, and what it did not.

use super::words;
use crate::report::{Block, EffectFinding, Findings, LeftOut, ReportError, Section, numbers};
use lobefit_import::{About, Note};

const COLUMNS: &str = "effect|because|ranges|approximation|error limit|measured error>|error of what";

pub(crate) fn section(findings: &Findings) -> Result<Section, ReportError> {
    Ok(of(&findings.effects, &findings.left_out))
}

/// What a foreign file says that the scene does not hold.
pub(crate) fn notes(notes: &[Note]) -> Option<Block> {
    let about = |note: &Note| match note.about {
        About::Missing => "not in this version",
        About::Reading => "how it was read",
    };
    let row =
        |note: &Note| vec![numbers::shortened(&note.of.join(", ")), about(note).into(), note.text.clone()];
    let columns = "material of the file|about|note";
    let caption = "What the file says that the scene does not hold, and how its values are passed.";
    (!notes.is_empty()).then(|| Block::Table(words::table(columns, notes.iter().map(row).collect(), caption)))
}

/// The effects, and what was left out.
pub(crate) fn of(effects: &[EffectFinding], left_out: &[LeftOut]) -> Section {
    let mut blocks = Vec::new();
    if effects.is_empty() {
        let text = "The scene calls for no effect: nothing was integrated, fitted or emitted.".into();
        blocks.push(Block::Text { text });
    } else {
        let rows = effects.iter().map(row).collect();
        let caption = "Maxima are rounded up. The limit is the scene's; a bake that exceeds it fails and writes nothing. Ranges are the hull of \
                       those of the effect's functions and tables: each error holds over the ranges of its own.";
        blocks.push(Block::Table(words::table(COLUMNS, rows, caption)));
    }
    if !left_out.is_empty() {
        let row = |of_one_reason: &[LeftOut]| {
            let effects = of_one_reason.iter().map(|l| l.effect.as_str()).collect::<Vec<_>>().join(", ");
            vec![effects, numbers::shortened(&of_one_reason[0].reason)]
        };
        let rows = left_out.chunk_by(|a, b| a.reason == b.reason).map(row).collect();
        let caption = "Left out: not integrated, fitted, emitted or shown below.";
        blocks.push(Block::Table(words::table("left out|reason", rows, caption)));
    }
    Section::new(
        "called-for",
        "What the scene called for",
        "Only effects that a material or probe of the scene needs are computed, over the ranges that the \
               scene spans.",
        blocks,
    )
}

fn row(e: &EffectFinding) -> Vec<String> {
    let reasons = if e.reasons.is_empty() { &e.because } else { &e.reasons };
    vec![
        e.effect.clone(),
        numbers::shortened(&reasons.join("; ")),
        words::ranges(&e.ranges),
        numbers::shortened(&e.approximation),
        e.limit.clone(),
        e.measured_error.map_or_else(|| "–".into(), words::max),
        e.metric.clone(),
    ]
}
