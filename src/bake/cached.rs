//! Parts of effects that a cache holds: what was made once, of the same scene, by the same code and
//! from the same formulas, is not made again.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::recipe::sources;
use crate::effects::context::Context;
use crate::effects::{BakeError, Called, Effect, Made, Part};
use crate::emit::manifest::Entries;
use crate::report::explore::Explored;
use crate::report::{Answer, EffectFinding};
use crate::store::{Files, Key};
use lobefit_shade::code::Language;

/// A part but for the contents of its files, which follow in their order.
#[derive(Serialize, Deserialize)]
struct Head {
    /// Hash of the recipe that the texts name.
    recipe: String,
    finding: EffectFinding,
    entries: Entries,
    code: BTreeMap<String, String>,
    explored: Vec<Explored>,
    answer: Answer,
    files: Vec<(String, usize)>,
}

/// The work of an effect, `whole` from the cache if it is there; what was computed is put there. Promises
/// that are not kept are computed each time.
pub(super) fn made(called: &Called, whole: bool, context: &Context) -> Result<Made, BakeError> {
    let compute = || called.by.bake(called, context)?.finished(context.scene);
    let Some(cache) = context.memo.cache().filter(|_| whole) else { return compute() };
    let key = key(called, context)?;
    if let Some(made) = cache.get(&key).and_then(|bytes| decoded(bytes, called.by, &context.recipe.hash)) {
        return Ok(made);
    }
    let made = compute()?;
    if made.broken.is_empty() {
        cache.put(&key, &encoded(&made, &context.recipe.hash)?);
    }
    Ok(made)
}

/// The hash of all that a part depends on.
fn key(called: &Called, context: &Context) -> Result<String, serde_json::Error> {
    let scene = serde_json::to_string(context.scene)?;
    let mut key = Key::of("part").with(called.effect).with(&scene).with(&context.recipe.command);
    let jobs = called.work.iter().map(|job| job.name.as_str());
    let own = context.hypotheses.iter().flat_map(|own| [own.file.as_str(), &own.source]);
    let pages = context.pages.iter().flat_map(|(name, file)| [name.as_str(), file]);
    let sources: Vec<&str> = sources(called.by).collect();
    for text in jobs.chain(sources).chain(own).chain(pages) {
        key = key.with(text);
    }
    Ok(key.end())
}

/// A line of JSON, then the contents of the files.
pub(super) fn encoded(made: &Made, recipe: &str) -> Result<Vec<u8>, serde_json::Error> {
    let Part { finding, entries, code, files, explored, answer, .. } = &made.part;
    let head = Head {
        recipe: recipe.into(),
        finding: finding.clone(),
        entries: entries.clone(),
        code: code.iter().map(|(language, text)| (language.name().into(), text.clone())).collect(),
        explored: explored.clone(),
        answer: answer.clone(),
        files: files.iter().map(|(name, bytes)| (name.clone(), bytes.len())).collect(),
    };
    let mut bytes = serde_json::to_vec(&head)?;
    bytes.push(b'\n');
    files.values().for_each(|content| bytes.extend(content));
    Ok(bytes)
}

/// The part of an entry, signed with this recipe; none of an entry of another form.
pub(super) fn decoded(mut bytes: Vec<u8>, by: &'static dyn Effect, recipe: &str) -> Option<Made> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    let old = serde_json::from_slice::<Head>(&bytes[..end]).ok()?.recipe;
    // Another effect's formula makes another recipe, which changes no value of this one. Both are
    // hashes of as many digits: every length stays.
    if old.len() == recipe.len() {
        sign(&mut bytes, old.as_bytes(), recipe.as_bytes());
    }
    let head: Head =
        serde_json::from_slice(&bytes[..end]).ok().filter(|head: &Head| head.recipe == recipe)?;
    let mut contents = &bytes[end + 1..];
    let mut files = Files::new();
    for (name, length) in head.files {
        let (content, rest) = contents.split_at_checked(length)?;
        files.insert(name, content.to_vec());
        contents = rest;
    }
    let code = head.code.into_iter().map(|(name, text)| Some((Language::parse(&name)?, text)));
    let part = Part {
        by,
        finding: head.finding,
        entries: head.entries,
        code: code.collect::<Option<_>>()?,
        files,
        explored: head.explored,
        answer: head.answer,
    };
    Some(Made::of(part))
}

/// Writes one hash in place of another wherever it stands.
fn sign(bytes: &mut [u8], old: &[u8], new: &[u8]) {
    let mut at = 0;
    while let Some(found) = bytes[at..].windows(old.len()).position(|window| window == old) {
        at += found;
        bytes[at..at + old.len()].copy_from_slice(new);
        at += old.len();
    }
}
