//! `lobefit report --study NAME`: the long studies.

use std::path::PathBuf;

use clap::Args;

use super::CliError;
use super::options::ThreadsOption;
use super::output::{Outcome, print};
use super::progress::Spinner;
use crate::store::Folder;
use crate::study::{self, Size, Study};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit report --study coupling       diffuse couplings in a furnace and under a sky: minutes
  lobefit report --study parallax       lookups of a probe's cubemap in rooms: minutes
  lobefit report --study coupling --reduced --out /tmp/study

Writes reports/studies/NAME/index.html and results.json in the output folder and nothing else. A bake leaves them alone, and
`check` tells where they follow from other parameters than this version's.";

/// Options of `report`.
#[derive(Args)]
pub(super) struct Options {
    /// The study: coupling, parallax
    #[arg(long, value_name = "NAME", value_parser = study)]
    pub study: Study,
    /// Fewer and smaller pictures, in seconds
    #[arg(long)]
    pub reduced: bool,
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the figures as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let size = if options.reduced { Size::Reduced } else { Size::Full };
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = Folder::open(&options.out)?;
    let progress = Spinner::new(options.quiet || options.json);
    let files = options.threads.install(|| Ok(study::run(options.study, size, &progress)?))?;
    drop(progress);
    let written = folder.write(&files)?;
    if options.json {
        let [_, results] = options.study.files();
        print(files.get(&results).map_or(&[], Vec::as_slice))?;
    } else if !options.quiet {
        let (new, same) = (written.written.len(), written.unchanged.len());
        let names: Vec<&str> = files.keys().map(String::as_str).collect();
        print(format!("{}: {new} files written, {same} unchanged\n", names.join(", ")).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// The name of a study.
fn study(text: &str) -> Result<Study, String> {
    Study::from_name(text).ok_or_else(|| {
        let names: Vec<&str> = Study::ALL.into_iter().map(Study::name).collect();
        format!("no such study; the studies are {}", names.join(", "))
    })
}
