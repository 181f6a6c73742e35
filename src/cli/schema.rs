//! `lobefit schema`: the JSON Schema of the scene.

use clap::Args;

use super::CliError;
use super::output::{Outcome, print_json};
use crate::scene;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit schema > scene.schema.json    for an editor that completes and checks scenes
  lobefit schema | less                 what every field means";

/// Options of `schema`.
#[derive(Args)]
pub(super) struct Options {}

pub(super) fn run(_: &Options) -> Result<Outcome, CliError> {
    print_json(&scene::schema())?;
    Ok(Outcome::Done)
}
