//! `lobefit merge`: the pieces of a bake, put together.

use std::path::PathBuf;

use clap::Args;

use super::bake::{OutputOptions, finish};
use super::options::{PagesOption, SceneOption};
use super::output::Outcome;
use super::{CliError, input};
use crate::bake::SHARD_ENDING;
use crate::plan;
use crate::store::{self, Folder, Kind};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit bake scene.json --shard 1/2 --out shards     on one machine
  lobefit bake scene.json --shard 2/2 --out shards     on another
  lobefit merge scene.json --shards shards --out assets
                                                       the same files as lobefit bake scene.json --out assets

Every shard is to be there once, of this scene, made by this build of lobefit; a file that is missing, doubled, damaged or of
another bake is named, and nothing is written.";

/// Largest file of a shard, bytes.
const FILE_BYTES: u64 = 4 << 30;

/// Options of `merge`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    #[command(flatten)]
    pub pages: PagesOption,
    /// The folder of the shards: each of its files whose name ends with .lobefit
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub shards: PathBuf,
    #[command(flatten)]
    pub output: OutputOptions,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?.with(&options.pages);
    let plan = plan::plan(&input.scene);
    if !store::is_folder(&options.shards)? {
        let shown = options.shards.display();
        return Err(CliError::Usage(format!("--shards {shown}: there is no such folder")));
    }
    let mut files = Vec::new();
    for entry in store::list(&options.shards, ".")? {
        // Of the folder itself: its names are `./NAME`.
        let own = entry.name.strip_prefix("./").filter(|name| !name.contains('/'));
        let Some(name) = own.filter(|name| name.ends_with(SHARD_ENDING) && entry.kind == Kind::File) else {
            continue;
        };
        let path = options.shards.join(name);
        files.push((path.display().to_string(), store::read(&path, FILE_BYTES)?));
    }
    let baked = input.merge(&plan, &options.shards, &files)?;
    finish(baked, (&input.scene, &plan), Folder::open(&options.output.out)?, &options.output)
}
