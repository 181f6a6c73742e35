//! `lobefit check`: do the files follow from their recipe?

mod records;
mod scene;
mod studies;

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::options::{SceneOption, ThreadsOption, not_negative};
use super::output::{Outcome, print, print_json, say};
use super::progress::Bar;
use super::{CliError, input};
use crate::bake::{self, BUILD_FILE, Baked, Difference, Selection, compare};
use crate::plan;
use crate::scene::escape::visible;
use crate::store::{self, Entry, Kind, MANIFEST, SUBFOLDERS};
use records::{Record, records};
use studies::studies;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit check                         the built-in scene against the current folder
  lobefit check scene.json --against assets
  lobefit check --values 1e-6           accept decoded values within 1e-6 of each other

Exit code 1 where a file is missing, extra or different; the message says how far it is off and where. A table whose
texels break the error that its manifest states is never accepted, whatever --values says.

Records of times on graphics processors (reports/gpu/, by lobefit cost --gpu --record) must be whole, and have their pages; times of
other code than the bake's, and functions that they lack, are told of, and do not fail. Studies (reports/studies/, by lobefit report)
must be of this version, if its package lobefit-studies is built; else a note says that they were not checked.";

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
    /// Accept files whose decoded values differ by no more than this, unless a table breaks its
    /// stated error
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
    // Before the work: it would only find that every file is missing.
    if !store::is_folder(&options.against)? {
        return Err(CliError::Usage(format!("--against {}: there is no such folder", shown(options))));
    }
    let progress = Bar::new(options.quiet || options.json, &plan, 1);
    let (baked, differences, ends, records, unknown, changes) = options.threads.install(|| {
        let baked = input.bake(&plan, Selection::default(), &progress)?;
        let strays = strays(&options.against, &baked)?;
        let found = store::read_set(&options.against, baked.files.keys().map(String::as_str), FILE_BYTES)?;
        let mut differences = compare(&baked, &found, &strays, options.values, &progress);
        let bake = differences.len();
        let changes = scene::changes(&found, &baked.files);
        let studies = studies(&options.against)?;
        differences.extend(studies.differences);
        let ends = [bake, differences.len()];
        let (records, broken) = records(&options.against, &baked)?;
        differences.extend(broken);
        Ok((baked, differences, ends, records, studies.unknown, changes))
    })?;
    drop(progress);
    // What breaks a promise is not written by a bake: there is nothing to compare with.
    for promise in &baked.broken {
        say(&format!("promise not kept: {}", visible(promise)));
    }
    if !baked.broken.is_empty() {
        return Ok(Outcome::Failed);
    }
    if options.json {
        let same = differences.is_empty();
        let verdict = Verdict {
            schema_version: 1,
            same,
            scene_changes: &changes,
            differences: &differences,
            records: &records,
            studies_unknown: unknown,
        };
        print_json(&verdict)?;
    } else if !options.quiet {
        // Of another scene every file is another: the change is what there is to say.
        for change in &changes {
            print(format!("the scene changed: {}\n", visible(change)).as_bytes())?;
        }
        if !changes.is_empty() {
            print(format!("bake it again: {}\n", visible(&again(options))).as_bytes())?;
        }
        let named = if changes.is_empty() { &differences[..] } else { &differences[ends[0]..] };
        for difference in named {
            print(format!("{difference}\n").as_bytes())?;
        }
        for note in records.iter().filter_map(Record::note) {
            print(note.as_bytes())?;
        }
        if let Some(reason) = unknown {
            print(format!("note: reports/studies: not checked: {reason}\n").as_bytes())?;
        }
        let (studies, broken) = (ends[1] - ends[0], differences.len() - ends[1]);
        print(closing(&baked, &differences[..ends[0]], [studies, broken], options).as_bytes())?;
    }
    Ok(if differences.is_empty() { Outcome::Done } else { Outcome::Failed })
}

/// The result for machines.
#[derive(Serialize)]
struct Verdict<'a> {
    schema_version: u32,
    same: bool,
    /// What changed in the scene since the bake that is checked.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    scene_changes: &'a [String],
    differences: &'a [Difference],
    /// Times on graphics processors, those of other code among them.
    #[serde(skip_serializing_if = "<[Record]>::is_empty")]
    records: &'a [Record],
    /// Why nothing is known of the studies that are there.
    #[serde(skip_serializing_if = "Option::is_none")]
    studies_unknown: Option<String>,
}

/// What lies in the folders of a bake and is none of its files, links in their places among it.
/// Hypotheses are a person's, timings are measured, the name of the build says who baked and
/// studies have a recipe of their own: they may be there.
fn strays(root: &Path, baked: &Baked) -> Result<Vec<Entry>, CliError> {
    let mut strays = Vec::new();
    for place in SUBFOLDERS.into_iter().chain([MANIFEST]) {
        strays.extend(store::list(root, place)?);
    }
    let all = strays.clone();
    strays.retain(|entry| {
        let name = entry.name.as_str();
        let allowed = name == "fits/hypotheses"
            || name.starts_with("fits/hypotheses/")
            || name.starts_with("reports/timings.")
            || records::placed(entry, &all)
            || entry.kind == Kind::File && name == BUILD_FILE
            || entry.kind == Kind::File && studies::placed(name);
        let baked = entry.kind == Kind::File && baked.files.contains_key(name);
        !allowed && !baked
    });
    Ok(strays)
}

/// The command that bakes the scene into the folder.
fn again(options: &Options) -> String {
    let scene =
        options.scene.scene.as_ref().map_or_else(String::new, |scene| format!(" {}", scene.display()));
    let out =
        if options.against == Path::new(".") { String::new() } else { format!(" --out {}", shown(options)) };
    format!("lobefit bake{scene}{out}")
}

/// The folder as the user named it.
fn shown(options: &Options) -> String {
    visible(&options.against.display().to_string())
}

/// What was found, of the files of the bake, and of the studies and records beside it.
fn closing(baked: &Baked, differences: &[Difference], beside: [usize; 2], options: &Options) -> String {
    let (folder, files) = (shown(options), baked.files.len());
    let extra = differences.iter().filter(|d| d.kind == bake::Kind::Extra).count();
    let more = if extra == 0 { String::new() } else { format!(", {extra} extra") };
    let [stale, broken] = beside;
    let records = match broken {
        0 => String::new(),
        1 => "; 1 record of times is broken".into(),
        broken => format!("; {broken} records of times are broken"),
    };
    let studies = match stale {
        0 => String::new(),
        1 => "; 1 study is not that of this version".into(),
        stale => format!("; {stale} studies are not those of this version"),
    };
    let found = match differences.len() - extra {
        0 => format!("{files} files in {folder} follow from their recipe"),
        1 => format!("1 of {files} files in {folder} differs or is missing"),
        bad => format!("{bad} of {files} files in {folder} differ or are missing"),
    };
    format!("{found}{more}{studies}{records}\n")
}
