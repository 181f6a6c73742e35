//! `lobefit report --study NAME`: the long studies.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use serde::Serialize;

use crate::study::{self, Given, STUDIES, Size, Stale, Study, Timed};
use lobefit::cli::CliError;
use lobefit::cli::declared;
use lobefit::cli::options::ThreadsOption;
use lobefit::cli::output::{self, Outcome, print, print_json};
use lobefit::cli::progress::Spinner;
use lobefit::cli::word::Words;
use lobefit::store::{self, Folder};

const REMARKS: &str = "\
Writes reports/studies/NAME/index.html and results.json in the output folder, with --times the record times.json beside them, and
nothing else; with --reduced, in reports/studies/NAME-reduced, with --scene FILE.json in reports/studies/NAME-scene-FILE, where the
study of another scene file of that name (by its path as given) is not replaced: give another --out. A bake leaves them alone. --check runs no study: it compares their recipes, and exits with 1 where one is of other code or other parameters than
this version's, as `lobefit check` does.";

/// What the help says after the options: every study, and what is written where.
fn after_help() -> String {
    let example =
        |study: &&dyn Study| format!("  lobefit report --study {:<14} {}\n", study.name(), study.about());
    let examples: String = STUDIES.iter().map(example).collect();
    let name = STUDIES[0].name();
    format!(
        "Examples:\n{examples}  lobefit report --study {name} --reduced --out /tmp/study\n  \
         lobefit report --check .              are the studies in a folder of this version?\n\n{REMARKS}"
    )
}

/// Largest file of a study that is read, bytes.
const FILE_BYTES: u64 = 1 << 30;

/// Make the page of a long study, which no bake waits for
#[derive(Parser)]
#[command(name = "lobefit report", bin_name = "lobefit report", version, after_help = after_help())]
struct Options {
    /// The study, one of those below
    #[arg(long, value_name = "NAME", value_parser = study(), required_unless_present = "check")]
    study: Option<&'static dyn Study>,
    /// Scene whose `culling` is simulated, in place of the example's (occlusion)
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Fewer and smaller pictures, in seconds
    #[arg(long)]
    reduced: bool,
    /// Time the passes on this machine first, and keep the record beside the page, which shows it
    /// from then on (occlusion)
    #[arg(long)]
    times: bool,
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    /// Say which studies in a folder are not of this version
    #[arg(long, value_name = "DIR", conflicts_with_all = ["study", "scene", "reduced", "times", "out"])]
    check: Option<PathBuf>,
    #[command(flatten)]
    threads: ThreadsOption,
    /// Print the figures, or what --check finds, as JSON on standard output
    #[arg(long)]
    json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the verb on its arguments (the first is the program's name).
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    declared::verb(arguments, |options| verb(&options))
}

fn verb(options: &Options) -> Result<Outcome, CliError> {
    match (&options.check, options.study) {
        (Some(folder), _) => check(options, folder),
        (None, Some(study)) => match &options.scene {
            None => make(options, study),
            Some(file) => make(options, &*of_scene(study, file)?),
        },
        (None, None) => Err(CliError::Usage("--study or --check is called for".into())),
    }
}

/// The study of a scene in a file.
fn of_scene(study: &dyn Study, file: &Path) -> Result<Box<dyn Study>, CliError> {
    let refused = || {
        let name = file.display();
        CliError::Usage(format!("--scene {name}: it does not call for the study {}", study.name()))
    };
    study.of_scene(&Given::read(file)?)?.ok_or_else(refused)
}

/// A study whose page shows times, where there are any, and the record of times to be written, where they
/// were measured now.
type WithTimes = (Option<Box<dyn Study>>, Option<Vec<u8>>);

/// A study with its times: measured now, or recorded beside its page.
fn with_times(options: &Options, study: &dyn Study, size: Size) -> Result<WithTimes, CliError> {
    let (file, command) = (study.times_file(size), format!("{} --times", study.command(size)));
    if options.times {
        let found = study.timed(size, command)?;
        let refused = || CliError::Usage(format!("--times: the study {} times nothing", study.name()));
        let Timed { record, study } = found.ok_or_else(refused)?;
        return Ok((Some(study), Some(record)));
    }
    let record = store::read_set(&options.out, [file.as_str()], FILE_BYTES)?.remove(&file);
    let timed = record.map(|record| study.with_times(&record)).transpose();
    let refused = |e| CliError::Usage(format!("{file}: no record of `{command}`: {e}"));
    Ok((timed.map_err(refused)?.flatten(), None))
}

/// Refuses to write over the study of another scene file.
fn refuse_other(options: &Options, study: &dyn Study, size: Size) -> Result<(), CliError> {
    let [_, results] = study.files(size);
    let Some([_, file]) = study.scene() else { return Ok(()) };
    let found = store::read_set(&options.out, [results.as_str()], FILE_BYTES)?;
    match found.get(&results).and_then(|bytes| study::other(study, size, bytes)) {
        Some(command) => Err(CliError::Usage(format!(
            "--scene {file}: {results} is of `{command}`; give another --out, or remove it"
        ))),
        None => Ok(()),
    }
}

/// Runs a study and writes it.
fn make(options: &Options, study: &dyn Study) -> Result<Outcome, CliError> {
    let size = if options.reduced { Size::Reduced } else { Size::Full };
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = Folder::open(&options.out)?;
    refuse_other(options, study, size)?;
    let progress = Spinner::new(options.quiet || options.json);
    let (timed, record) = options.threads.install(|| with_times(options, study, size))?;
    let study = timed.as_deref().unwrap_or(study);
    let mut files = options.threads.install(|| Ok(study::run(study, size, &progress)?))?;
    drop(progress);
    if let Some(record) = record {
        files.insert(study.times_file(size), record);
    }
    let written = folder.write(&files)?;
    if options.json {
        let [_, results] = study.files(size);
        print(files.get(&results).map_or(&[], Vec::as_slice))?;
    } else if !options.quiet {
        let names: Vec<&str> = files.keys().map(String::as_str).collect();
        print(format!("{}: {}\n", names.join(", "), output::files(&written)).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// What `--check` prints for machines.
#[derive(Serialize)]
struct Verdict {
    schema_version: u32,
    differences: Vec<Stale>,
}

/// Compares the recipes of the studies in a folder.
fn check(options: &Options, root: &Path) -> Result<Outcome, CliError> {
    let mut differences = Vec::new();
    for study in STUDIES {
        for size in [Size::Full, Size::Reduced] {
            let names = study.files(size);
            let found = store::read_set(root, names.iter().map(String::as_str), FILE_BYTES)?;
            differences.extend(study::stale(study, size, &found)?);
        }
    }
    let done = if differences.is_empty() { Outcome::Done } else { Outcome::Failed };
    if options.json {
        print_json(&Verdict { schema_version: 1, differences })?;
    } else if !options.quiet {
        for Stale { file, detail } in &differences {
            print(format!("{file}: {detail}\n").as_bytes())?;
        }
    }
    Ok(done)
}

/// The study of a name.
fn study() -> Words<&'static dyn Study> {
    Words::one_of("study", STUDIES.map(|study| (study.name(), study)))
}
