//! `lobefit bake`: the main job.

use std::path::PathBuf;

use clap::Args;

use super::options::{SceneOption, ThreadsOption, effect};
use super::output::Outcome;
use super::{CliError, input, seam};
use crate::plan::{self, EffectName};
use crate::store::Folder;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit bake                          the built-in scene, into the current folder
  lobefit bake scene.json --out assets  a scene of your own, into assets/

Writes tables/ fits/ reports/ and manifest.json in the output folder and nothing else. Files that an older bake left
there and this one does not have are removed.";

/// Options of `bake`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Bake these effects only, and keep what the folder has of others
    #[arg(long, value_name = "EFFECT", value_delimiter = ',', value_parser = effect)]
    pub only: Vec<EffectName>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the manifest as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = Folder::open(&options.out)?;
    options.threads.install(|| seam::bake(&input, &plan, &mut folder, options))
}
