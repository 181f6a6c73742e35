//! `lobefit check`: do the files follow from their recipe?

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::options::{SceneOption, ThreadsOption, not_negative};
use super::output::{Outcome, print, print_json};
use super::progress::Bar;
use super::{CliError, input};
use crate::bake::{Baked, Difference, bake, compare};
use crate::plan;
use crate::store::{self, Files, SUBFOLDERS};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit check                         the built-in scene against the current folder
  lobefit check scene.json --against assets
  lobefit check --values 1e-6           accept decoded values within 1e-6 of each other

Exit code 1 where a file is missing, extra or different; the message says how far it is off and where.";

/// Largest file that is compared, bytes.
const FILE_BYTES: u64 = 1 << 30;

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
    let progress = Bar::new(options.quiet || options.json);
    let (baked, differences) = options.threads.install(|| {
        let baked = bake(&input.scene, &plan, &input.hypotheses, &progress)?;
        let found = found(&options.against, &baked)?;
        let differences = compare(&baked, &found, options.values, &progress);
        Ok((baked, differences))
    })?;
    drop(progress);
    if options.json {
        print_json(&Verdict { schema_version: 1, same: differences.is_empty(), differences: &differences })?;
    } else if !options.quiet {
        for difference in &differences {
            print(format!("{difference}\n").as_bytes())?;
        }
        print(closing(&baked, &differences, options).as_bytes())?;
    }
    Ok(if differences.is_empty() { Outcome::Done } else { Outcome::Failed })
}

/// The result for machines.
#[derive(Serialize)]
struct Verdict<'a> {
    schema_version: u32,
    same: bool,
    differences: &'a [Difference],
}

/// The files of the folder that a bake could have written, and nothing else: hypotheses are a person's, timings are measured.
fn found(root: &Path, baked: &Baked) -> Result<Files, CliError> {
    let mut names: BTreeSet<String> = baked.files.keys().cloned().collect();
    for folder in SUBFOLDERS {
        names.extend(store::list(root, folder)?);
    }
    let ours =
        |name: &&String| !name.starts_with("fits/hypotheses/") && !name.starts_with("reports/timings.");
    Ok(store::read_set(root, names.iter().filter(ours).map(String::as_str), FILE_BYTES)?)
}

fn closing(baked: &Baked, differences: &[Difference], options: &Options) -> String {
    let folder = options.against.display();
    match differences.len() {
        0 => format!("{} files in {folder} follow from their recipe\n", baked.files.len()),
        n => format!("{n} of {} files in {folder} do not follow from their recipe\n", baked.files.len()),
    }
}
