//! `lobefit cost`: what accuracy costs in time.

use std::path::PathBuf;

use clap::Args;

use super::options::{SceneOption, ThreadsOption};
use super::output::Outcome;
use super::{CliError, input, seam};
use crate::plan;
use crate::store::Folder;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit cost                          measure, and write reports/timings.html and reports/timings.json
  lobefit cost scene.json --out assets --json

Seconds differ from run to run; `check` ignores reports/timings.*.";

/// Options of `cost`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the measurements as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    let mut folder = Folder::open(&options.out)?;
    options.threads.install(|| seam::cost(&input, &plan, &mut folder, options))
}
