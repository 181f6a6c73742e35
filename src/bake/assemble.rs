//! The parts of all effects as one set of files.

use super::{BakeError, includes, opening};
use crate::effects::Part;
use crate::effects::context::Context;
use crate::emit::manifest::{Entries, Include, LeftOut, Manifest, Report, SCHEMA_VERSION};
use crate::plan::Plan;
use crate::report;
use crate::report::explore::{ExplorePage, ExploredEffect};
use crate::store::{Files, MANIFEST};

/// Every file of a bake: those of the parts, the include files, the overview, the manifest.
pub fn assemble(plan: &Plan, parts: Vec<Part>, context: &Context) -> Result<Files, BakeError> {
    let mut files = Files::new();
    let mut manifest = Manifest {
        schema_version: SCHEMA_VERSION,
        tool: context.recipe.tool.clone(),
        scene: context.recipe.scene.clone(),
        made_from: serde_json::to_value(context.scene)?,
        command: context.recipe.command.clone(),
        recipe: context.recipe.hash.clone(),
        effects: parts.iter().map(|part| part.finding.clone()).collect(),
        entries: Entries::default(),
        includes: Vec::new(),
        left_out: plan
            .left_out
            .iter()
            .map(|l| LeftOut { effect: l.effect.into(), reason: l.reason.clone() })
            .collect(),
        notes: context.scene.notes.clone(),
    };
    for (language, text) in includes::includes(&parts, &opening::opening(&parts, context), context)? {
        let file = includes::path(language);
        manifest.includes.push(Include { language: language.name().into(), file: file.clone() });
        files.insert(file, text.into_bytes());
    }
    let explored = explored(&parts);
    let mut answers = Vec::new();
    for part in parts {
        files.extend(part.files);
        manifest.entries.extend(part.entries);
        answers.push(part.answer);
    }
    let mut pages = Vec::new();
    if context.scene.output.reports {
        if !explored.is_empty() {
            let page = ExplorePage { origin: context.origin(), effects: explored };
            pages.push(report::explore(page, (&manifest, &files))?);
        }
        pages.extend(report::index(context.origin(), answers, (&manifest, &files))?);
    }
    for file in pages {
        manifest.entries.reports.push(Report { effect: None, file: file.path.clone() });
        files.insert(file.path, file.bytes);
    }
    files.insert(MANIFEST.to_string(), manifest.bytes()?);
    Ok(files)
}

/// What the live page draws, by effect.
fn explored(parts: &[Part]) -> Vec<ExploredEffect> {
    let filled = parts.iter().filter(|part| !part.explored.is_empty());
    filled
        .map(|part| ExploredEffect { effect: part.by.name().into(), shown: part.explored.clone() })
        .collect()
}
