//! A bake in pieces, for a matrix of CI jobs: each shard makes some of the effects, and all of them
//! merged are the bytes of one run.
//!
//! A shard's file is a line of JSON, then the parts of its effects as the cache holds them.

use std::cmp::Reverse;

use serde::{Deserialize, Serialize};

use super::build::BUILD;
use super::{Baked, cached, finished, made};
use crate::effects::context::Context;
use crate::effects::{BakeError, Called, named};
use crate::plan::Plan;

/// The form of the file.
const VERSION: u32 = 1;

/// Most pieces of a bake, far above the number of effects.
pub const MOST: usize = 1024;

/// How the names of shards' files end.
pub const ENDING: &str = ".lobefit";

/// One of the pieces that a bake is split into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Which one, from 1.
    pub number: usize,
    /// How many there are.
    pub of: usize,
}

impl Shard {
    /// Reads `K/N` with 1 <= K <= N <= [`MOST`].
    pub fn parse(text: &str) -> Option<Shard> {
        let (number, of) = text.split_once('/')?;
        let shard = Shard { number: number.parse().ok()?, of: of.parse().ok()? };
        shard.is_one().then_some(shard)
    }

    /// Whether there is such a piece.
    fn is_one(self) -> bool {
        self.of <= MOST && (1..=self.of).contains(&self.number)
    }

    /// The name of its file.
    pub fn file(self) -> String {
        format!("shard-{}-of-{}{ENDING}", self.number, self.of)
    }

    /// The effects that it makes, of a plan: the longest first, each goes to the shard that has the
    /// least to do. None where there are more shards than effects.
    pub fn effects(self, plan: &Plan) -> Vec<&Called> {
        let mut effects: Vec<&Called> = plan.effects.iter().collect();
        effects.sort_by_key(|called| Reverse(ordered(called.seconds)));
        let mut busy = vec![0.0; self.of.min(effects.len())];
        let mut own = Vec::new();
        for called in effects {
            let Some(least) = (0..busy.len()).min_by_key(|shard| ordered(busy[*shard])) else { break };
            busy[least] += called.seconds;
            if least + 1 == self.number {
                own.push(called);
            }
        }
        own
    }
}

/// Seconds, which are not negative, in their order.
fn ordered(seconds: f64) -> u64 {
    seconds.to_bits()
}

/// Why files are not the shards of a bake. Each message names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShardError {
    /// They are of something else, not whole, not each once, or not all there.
    #[error("{0}")]
    Files(String),
    /// Their files could not be put together.
    #[error(transparent)]
    Bake(#[from] BakeError),
}

/// The first line of a shard's file.
#[derive(Serialize, Deserialize)]
struct Head {
    version: u32,
    shard: Shard,
    recipe: String,
    build: String,
    /// Effects, each with the bytes of its part.
    effects: Vec<(String, usize)>,
    /// Hash of what follows.
    hash: String,
}

/// The bytes of a shard's file, and the promises of the scene that are not kept.
///
/// # Errors
/// As a bake of its effects.
pub fn shard(plan: &Plan, shard: Shard, context: &Context) -> Result<(Vec<u8>, Vec<String>), BakeError> {
    let (mut effects, mut parts, mut broken) = (Vec::new(), Vec::new(), Vec::new());
    for made in made(&shard.effects(plan), true, context)? {
        let part = cached::encoded(&made, &context.recipe.hash)?;
        effects.push((made.part.by.name().to_string(), part.len()));
        parts.extend(part);
        broken.extend(made.broken);
    }
    let head = Head {
        version: VERSION,
        shard,
        recipe: context.recipe.hash.clone(),
        build: BUILD.into(),
        effects,
        hash: blake3::hash(&parts).to_hex().to_string(),
    };
    let mut bytes = serde_json::to_vec(&head)?;
    bytes.push(b'\n');
    bytes.extend(parts);
    Ok((bytes, broken))
}

/// The bake of all its shards, the files of `folder` with their bytes. Nothing is computed.
///
/// # Errors
/// Files that are not all shards of this plan's bake, each once.
pub fn merge(
    plan: &Plan,
    folder: &str,
    files: &[(String, Vec<u8>)],
    context: &Context,
) -> Result<Baked, ShardError> {
    let mut heads: Vec<(&str, Head)> = Vec::new();
    let mut all = Vec::new();
    for (file, bytes) in files {
        let damaged = || {
            ShardError::Files(format!(
                "{file}: not a whole shard of a bake; make it again with `lobefit bake --shard K/N`"
            ))
        };
        let (head, mut parts) = read(bytes).ok_or_else(damaged)?;
        of_this_bake(file, &head, &heads, context)?;
        for (effect, length) in &head.effects {
            let (part, rest) = parts.split_at_checked(*length).ok_or_else(damaged)?;
            let by = named(&plan.catalogue, effect).ok_or_else(damaged)?;
            let made = cached::decoded(part.to_vec(), by, &context.recipe.hash);
            all.push(made.ok_or_else(damaged)?);
            parts = rest;
        }
        heads.push((file, head));
    }
    let of = heads.first().map_or(1, |(_, head)| head.shard.of);
    let all_of = (1..=of).map(|number| Shard { number, of });
    let missing = all_of.filter(|shard| heads.iter().all(|(_, head)| head.shard != *shard));
    let missing: Vec<String> = missing.map(Shard::file).collect();
    if !missing.is_empty() {
        return Err(ShardError::Files(format!("{folder}: missing: {}", missing.join(", "))));
    }
    Ok(finished(plan, Vec::new(), all, context)?)
}

/// The head of a file that is whole, and the parts.
fn read(bytes: &[u8]) -> Option<(Head, &[u8])> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    let head: Head = serde_json::from_slice(&bytes[..end]).ok()?;
    let parts = &bytes[end + 1..];
    let known = head.version == VERSION && head.shard.is_one();
    (known && head.hash == *blake3::hash(parts).to_hex()).then_some((head, parts))
}

/// Whether a shard is of the bake that is merged, and none that is there already.
fn of_this_bake(
    file: &str,
    head: &Head,
    others: &[(&str, Head)],
    context: &Context,
) -> Result<(), ShardError> {
    let refuse = |why: String| Err(ShardError::Files(format!("{file}: {why}")));
    if head.recipe != context.recipe.hash {
        return refuse(format!(
            "a shard of recipe {}, this scene's is {}: the scene, its hypotheses, --no-reports or the tool differ",
            head.recipe, context.recipe.hash
        ));
    }
    if head.build != BUILD {
        return refuse("made by another build of lobefit; shards and merge take the same one".into());
    }
    let Shard { number, of } = head.shard;
    if let Some((first, other)) = others.first().filter(|(_, other)| other.shard.of != of) {
        return refuse(format!("a shard of {of}, {first} is one of {}", other.shard.of));
    }
    match others.iter().find(|(_, other)| other.shard.number == number) {
        Some((other, _)) => refuse(format!("shard {number} of {of}, as {other} is")),
        None => Ok(()),
    }
}
