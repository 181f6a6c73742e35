//! `lobefit check`: do the files follow from their recipe?

use std::path::PathBuf;

use clap::Args;

use super::options::{SceneOption, ThreadsOption, not_negative};
use super::output::Outcome;
use super::{CliError, input, seam};
use crate::plan;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit check                         the built-in scene against the current folder
  lobefit check scene.json --against assets
  lobefit check --values 1e-6           accept decoded values within 1e-6 of each other

Exit code 1 where a file is missing, extra or different; the message says how far it is off and where.";

/// Options of `check`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    /// Folder that holds the bake
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub against: PathBuf,
    /// Accept files whose decoded values differ by no more than this
    #[arg(long, value_name = "TOL", value_parser = not_negative)]
    pub values: Option<f64>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the differences as JSON
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors; the exit code tells
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    options.threads.install(|| seam::check(&input, &plan, options))
}
