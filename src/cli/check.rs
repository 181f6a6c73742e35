//! `lobefit check`: do the files follow from their recipe?

mod counts;
mod records;
mod scene;
mod studies;

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::cost::PAGE;
use super::options::{PagesOption, SceneOption, ThreadsOption, not_negative};
use super::output::{Outcome, print, print_json, say, say_broken, say_each};
use super::progress::Bar;
use super::{CliError, input};
use crate::bake::{self, BUILD_FILE, Baked, Difference, Selection, Silent, changed, compare};
use crate::data::natural;
use crate::plan;
use crate::report::without_absent;
use crate::scene::escape::visible;
use crate::store::{self, Entry, Kind, MANIFEST, SUBFOLDERS};
use crate::timing::{offline, searches};
use counts::Counts;
use records::Record;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit check                         the built-in scene against the current folder
  lobefit check scene.json --against assets
  lobefit check --values 1e-6           accept texels and figures within 1e-6 of each other
  lobefit check --only tables,fits      what an engine reads, and neither pages nor the manifest

With --values TOL texels, and figures of the reports, the manifest and comments, may be TOL off. Another version of lobefit, another
recipe or another name of a material is no difference then; pages are not compared. Constants of functions, in fits/ and in the
manifest's coefficients, and ends of ranges must be equal, no error may be stated smaller than it is, and a table whose texels break
its stated error is never accepted, whatever --values says. Exit code 1 where a file is missing, extra or different; the message says how far it is off and where.

Records of times on graphics processors (reports/gpu/, by lobefit cost --gpu --record) must be whole, and have their pages; times of
other code than the bake's, and functions that they lack, are noted, and do not fail. Records of machine code (reports/isa/, by lobefit
cost --isa --record) must be whole; a function of other code is compiled again where lobefit-gpu is built and the compiler is that of
the record, and a count that grew fails. Studies (reports/studies/, by lobefit report)
must be of this version, if its package lobefit-studies is built; else a note says that they were not checked.";

/// Largest file that is compared, bytes.
pub(super) const FILE_BYTES: u64 = 1 << 30;

/// What of a bake can be compared alone.
const PARTS: [&str; 4] = ["tables", "fits", "reports", "manifest"];

/// Options of `check`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    #[command(flatten)]
    pub pages: PagesOption,
    /// Folder that holds the bake
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub against: PathBuf,
    /// Accept texels and figures that differ by no more than this, unless a table breaks its stated
    /// error; constants of functions and ends of ranges must be equal
    #[arg(long, value_name = "TOL", value_parser = not_negative)]
    pub values: Option<f64>,
    /// Compare these parts of the bake only: `tables`, `fits`, `reports` or `manifest`
    #[arg(long, value_name = "PART", value_delimiter = ',', value_parser = PARTS)]
    pub only: Vec<String>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the differences as JSON
    #[arg(long)]
    pub json: bool,
    /// Say nothing but how many files differ, in one line on standard error; nothing where none does
    #[arg(long, short)]
    pub quiet: bool,
}

impl Options {
    /// Whether a file, by its path in the folder, is one of those to compare.
    fn asks_for(&self, file: &str) -> bool {
        let part = if file == MANIFEST { "manifest" } else { file.split('/').next().unwrap_or(file) };
        self.only.is_empty() || self.only.iter().any(|only| only == part)
    }
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?.with(&options.pages);
    let plan = plan::plan(&input.scene);
    // Before the work: it would only find that every file is missing.
    if !store::is_folder(&options.against)? {
        return Err(CliError::Usage(format!("--against {}: there is no such folder", shown(options))));
    }
    let progress = Bar::new(options.quiet || options.json, (&input.scene, &plan), 1);
    let found = options.threads.install(|| {
        let baked = input.bake(&plan, Selection::default(), &progress)?;
        Found::new(baked, &input.scene.name, options, &progress)
    })?;
    drop(progress);
    // What breaks a promise is not written by a bake: there is nothing to compare with.
    if !found.broken.is_empty() {
        if options.json {
            print_json(&found.verdict())?;
        }
        say_each("the scene changed", &found.changes);
        say_broken(&found.broken);
        return Ok(Outcome::Failed);
    }
    let same = found.all().next().is_none();
    if options.json {
        print_json(&found.verdict())?;
    } else if !options.quiet {
        print(found.lines(options).as_bytes())?;
    } else if !same {
        say(found.closing(options).trim_end());
    }
    Ok(if same { Outcome::Done } else { Outcome::Failed })
}

/// What a folder holds, held against what its recipe gives.
struct Found {
    /// Promises that the bake itself does not keep.
    broken: Vec<String>,
    /// Files of the bake that were compared.
    files: usize,
    /// What is other than in the bake, in its studies and in its records of times.
    of_bake: Vec<Difference>,
    of_studies: Vec<Difference>,
    of_records: Vec<Difference>,
    records: Vec<Record>,
    counts: Vec<Counts>,
    /// Why nothing is known of the studies that are there.
    studies_unknown: Option<String>,
    /// What changed in the scene.
    changes: Vec<String>,
    /// Whether no value did.
    names_only: bool,
    /// Where the scene changed: the files whose numbers or code, which a shader reads, are others.
    changed: Vec<String>,
}

impl Found {
    fn new(mut baked: Baked, scene: &str, options: &Options, progress: &Bar) -> Result<Found, CliError> {
        let root = &options.against;
        without_absent(&mut baked.files, root);
        let mut strays = strays(root, &baked)?;
        strays.retain(|stray| options.asks_for(&stray.name));
        let found = store::read_set(root, baked.files.keys().map(String::as_str), FILE_BYTES)?;
        let changes = scene::changes(&found, &baked.files);
        let (mut records, mut counts, mut of_records) = (Vec::new(), Vec::new(), Vec::new());
        let mut studies = studies::Studies::default();
        if options.asks_for("reports/") {
            (records, of_records) = records::records(root, (&baked, scene))?;
            let (found, grown) = counts::counts(root, &baked, scene)?;
            counts = found;
            of_records.extend(grown);
            studies = studies::studies(root)?;
        }
        let compared = compare(&baked, &found, &strays, options.values, progress);
        let names_only = options.values.is_none()
            && !changes.is_empty()
            && compare(&baked, &found, &strays, Some(0.0), &Silent).is_empty();
        let changed = if changes.is_empty() { Vec::new() } else { changed(&baked.files, &found) };
        baked.files.retain(|file, _| options.asks_for(file));
        Ok(Found {
            broken: baked.broken,
            files: baked.files.len(),
            of_bake: compared.into_iter().filter(|d| options.asks_for(&d.file)).collect(),
            of_studies: studies.differences,
            of_records,
            records,
            counts,
            studies_unknown: studies.unknown,
            changes,
            names_only,
            changed,
        })
    }

    fn all(&self) -> impl Iterator<Item = &Difference> {
        self.of_bake.iter().chain(&self.of_studies).chain(&self.of_records)
    }

    /// Files of the bake that are not there.
    fn missing(&self) -> usize {
        self.of_bake.iter().filter(|difference| difference.kind == bake::Kind::Missing).count()
    }

    fn verdict(&self) -> Verdict<'_> {
        Verdict {
            schema_version: 1,
            same: self.broken.is_empty() && self.all().next().is_none(),
            promises_not_kept: &self.broken,
            scene_changes: &self.changes,
            changed_for_shaders: (!self.changes.is_empty()).then_some(&self.changed),
            differences: self.all().filter(|_| self.broken.is_empty()).collect(),
            records: &self.records,
            counts: &self.counts,
            studies_unknown: self.studies_unknown.as_deref(),
        }
    }

    /// The result for a person.
    fn lines(&self, options: &Options) -> String {
        let mut lines = Vec::new();
        if self.changes.is_empty() {
            lines.extend(self.of_bake.iter().map(|difference| format!("{difference}\n")));
            if self.missing() < self.files
                && self.of_bake.iter().any(|difference| difference.kind != bake::Kind::Extra)
            {
                let bake = command("bake", "--out", options, options.pages.no_reports);
                lines.push(format!("bake it again: {}\n", visible(&bake)));
            }
        } else if !self.of_bake.is_empty() {
            // Of another scene every file is another: the change is what there is to say.
            for change in &self.changes {
                lines.push(format!("the scene changed: {}\n", visible(change)));
                if change.starts_with(scene::PAGES) {
                    let without = command("check", "--against", options, true);
                    lines.push(format!("  without pages: {}\n", visible(&without)));
                }
            }
            let files: Vec<&str> = self.of_bake.iter().map(|difference| difference.file.as_str()).collect();
            lines.push(format!("files that differ: {}\n", visible(&files.join(", "))));
            lines.push(visible(&for_shaders(&self.changed)) + "\n");
            lines.push(format!(
                "bake it again: {}\n",
                visible(&command("bake", "--out", options, options.pages.no_reports))
            ));
        }
        let beside = self.of_studies.iter().chain(&self.of_records);
        lines.extend(beside.map(|difference| format!("{difference}\n")));
        lines.extend(self.records.iter().filter_map(Record::note));
        lines.extend(self.counts.iter().filter_map(Counts::note));
        if let Some(reason) = &self.studies_unknown {
            lines.push(format!("note: reports/studies: not checked: {reason}\n"));
        }
        lines.push(self.closing(options));
        if self.files > 0 && self.missing() == self.files {
            let bake = visible(&command("bake", "--out", options, options.pages.no_reports));
            lines.push(format!(
                "none of them is there: `--against` names the folder of a bake; `{bake}` makes one here\n"
            ));
        }
        if self.names_only {
            let command = command("check", "--against", options, options.pages.no_reports);
            let passes = visible(&format!("{command} --values 0"));
            lines.push(format!("names only: `{passes}` passes\n"));
        }
        lines.concat()
    }

    /// What was found, of the files of the bake, and of the studies and records beside it.
    fn closing(&self, options: &Options) -> String {
        let (folder, files) = (shown(options), self.files);
        let extra = self.of_bake.iter().filter(|d| d.kind == bake::Kind::Extra).count();
        let more = if extra == 0 { String::new() } else { format!(", {extra} extra") };
        let records = match self.of_records.len() {
            0 => String::new(),
            1 => "; 1 fault in records of times and machine code".into(),
            faults => format!("; {faults} faults in records of times and machine code"),
        };
        let studies = match self.of_studies.len() {
            0 => String::new(),
            1 => "; 1 study is not that of this version".into(),
            stale => format!("; {stale} studies are not those of this version"),
        };
        let found = match self.of_bake.len() - extra {
            0 if files == 1 => format!("1 file in {folder} follows from its recipe"),
            0 => format!("{files} files in {folder} follow from their recipe"),
            1 => format!("1 of {files} files in {folder} differs or is missing"),
            bad => format!("{bad} of {files} files in {folder} differ or are missing"),
        };
        format!("{found}{more}{studies}{records}\n")
    }
}

/// The result for machines.
#[derive(Serialize)]
struct Verdict<'a> {
    schema_version: u32,
    same: bool,
    /// Promises of the scene that no bake keeps, so that there is nothing to compare with.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    promises_not_kept: &'a [String],
    /// What changed in the scene since the bake that is checked.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    scene_changes: &'a [String],
    /// Of a changed scene the files whose numbers or code, which a shader reads, are others.
    #[serde(skip_serializing_if = "Option::is_none")]
    changed_for_shaders: Option<&'a Vec<String>>,
    differences: Vec<&'a Difference>,
    /// Times on graphics processors, those of other code among them.
    #[serde(skip_serializing_if = "<[Record]>::is_empty")]
    records: &'a [Record],
    /// Counts of machine instructions, and functions of other code among them.
    #[serde(skip_serializing_if = "<[Counts]>::is_empty")]
    counts: &'a [Counts],
    /// Why nothing is known of the studies that are there.
    #[serde(skip_serializing_if = "Option::is_none")]
    studies_unknown: Option<&'a str>,
}

/// What lies in the folders of a bake and is none of its files, links in their places among it.
/// Hypotheses are a person's, timings are measured, the page of costs follows from records, the name
/// of the build says who baked and studies have a recipe of their own: they may be there.
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
            || entry.kind == Kind::File && (counts::placed(name) || unread(name))
            || entry.kind == Kind::File && [BUILD_FILE, PAGE].contains(&name)
            || entry.kind == Kind::File && studies::placed(name);
        let baked = entry.kind == Kind::File && baked.files.contains_key(name);
        !allowed && !baked
    });
    Ok(strays)
}

/// Whether a file is a record that a check has nothing to say of: times of integrators, searches.
fn unread(name: &str) -> bool {
    let folders = [offline::FOLDER, searches::FOLDER];
    folders.iter().any(|folder| name.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/')))
}

/// Whether what a shader reads changed, and where.
pub(super) fn for_shaders(changed: &[String]) -> String {
    match changed {
        [] => "no number and no code that a shader reads changed".into(),
        files => {
            let mut files = files.to_vec();
            files.sort_by(|a, b| natural(a, b));
            format!("numbers or code that a shader reads changed in {}", files.join(", "))
        }
    }
}

/// The command of a verb on the scene and the folder.
fn command(verb: &str, folder: &str, options: &Options, no_reports: bool) -> String {
    let scene =
        options.scene.scene.as_ref().map_or_else(String::new, |scene| format!(" {}", scene.display()));
    let out = if options.against == Path::new(".") {
        String::new()
    } else {
        format!(" {folder} {}", shown(options))
    };
    let pages = if no_reports { " --no-reports" } else { "" };
    format!("lobefit {verb}{scene}{out}{pages}")
}

/// The folder as the user named it.
fn shown(options: &Options) -> String {
    visible(&options.against.display().to_string())
}
