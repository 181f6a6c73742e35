//! `lobefit schema`: the JSON Schema of the scene, and of the file of a kernel.

use clap::Args;

use super::CliError;
use super::output::{Outcome, print_json};
use crate::scene;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit schema > scene.schema.json    for an editor that completes and checks scenes
  lobefit schema | less                 what every field means
  lobefit schema --kernel               the file of a probe's kernel that has no word";

/// Options of `schema`.
#[derive(Args)]
pub(super) struct Options {
    /// The file of a kernel instead: the table of a lobe that a probe is prefiltered with
    #[arg(long)]
    pub kernel: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let schema = if options.kernel { scene::kernel_schema() } else { scene::schema() };
    print_json(&schema)?;
    Ok(Outcome::Done)
}
