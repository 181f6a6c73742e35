//! `lobefit cost`: what accuracy costs in time.

use std::path::{Path, PathBuf};

use clap::Args;

use super::input::Input;
use super::options::{SceneOption, ThreadsOption};
use super::output::{Outcome, print};
use super::progress::Bar;
use super::{CliError, input};
use crate::bake::{BakeError, Progress, Selection, recipe};
use crate::plan;
use crate::report::{self, Origin, Timings};
use crate::store::{self, Files, Folder};
use crate::timing::timings;

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
    if plan.is_empty() {
        return nothing(options, &input);
    }
    let progress = Bar::new(options.quiet || options.json, &plan, 1);
    let files = options.threads.install(|| {
        let baked = input.bake(&plan, Selection::default(), &progress)?;
        progress.stage("timings");
        let measured = timings(&input.scene, &baked, origin(&input)?, device())?;
        Ok(report::timings_page(&measured).map_err(BakeError::from)?)
    })?;
    drop(progress);
    let files: Files = files.into_iter().map(|f| (f.path, f.bytes)).collect();
    folder.write(&files)?;
    if options.json {
        print(json(&files))?;
    } else if !options.quiet {
        print(b"reports/timings.html and reports/timings.json written\n")?;
    }
    Ok(Outcome::Done)
}

/// The end for a scene that calls for no effect: there is nothing to measure and nothing is written.
fn nothing(options: &Options, input: &Input) -> Result<Outcome, CliError> {
    if options.json {
        let origin = origin(input)?;
        let empty = Timings {
            origin,
            device: device(),
            points: Vec::new(),
            tables: None,
            evaluations: Vec::new(),
            lookups: Vec::new(),
        };
        let files = report::timings_page(&empty).map_err(BakeError::from)?;
        print(json(&files.into_iter().map(|f| (f.path, f.bytes)).collect()))?;
    } else if !options.quiet {
        print(b"the scene calls for no effect: nothing to measure, nothing written\n")?;
    }
    Ok(Outcome::Done)
}

/// The measurements as JSON.
fn json(files: &Files) -> &[u8] {
    files.get("reports/timings.json").map_or(&[], Vec::as_slice)
}

fn origin(input: &Input) -> Result<Origin, CliError> {
    Ok(Origin {
        scene: input.scene.name.clone(),
        recipe: recipe(&input.scene, &input.hypotheses)?.hash,
        tool: env!("CARGO_PKG_VERSION").into(),
        command: "lobefit cost".into(),
    })
}

/// The processor as the system names it, and the threads in use.
fn device() -> String {
    const LIMIT: u64 = 1 << 20;
    let text = store::read(Path::new("/proc/cpuinfo"), LIMIT).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let model =
        text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, m)| m.trim()));
    let threads = rayon::current_num_threads();
    format!("{} ({}), {threads} threads", model.unwrap_or("processor not named"), std::env::consts::ARCH)
}
