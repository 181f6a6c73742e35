//! `lobefit cost`: what accuracy costs in time.

mod effects;
mod from;
mod limited;
mod page;
mod record;

pub use from::{bake_in, counts_in, offline_in, times_in};
pub use page::Beside;
pub(super) use page::PAGE;
pub use record::{RECORD_BYTES, RecordPlace};

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};

use super::input::Input;
use super::options::{SceneOption, ThreadsOption, language, positive, vendor};
use super::output::{Outcome, print};
use super::progress::Bar;
use super::{CliError, external, input};
use crate::bake::{BakeError, Progress, Selection, recipe};
use crate::data::Vendor;
use crate::plan::{self, Plan};
use crate::report::{self, Origin, Timings};
use crate::store::{self, Files, Folder};
use crate::timing::isa::Precision;
use crate::timing::timings;
use lobefit_shade::code::Language;

/// Examples of the help.
pub const EXAMPLES: &str = "\
Examples:
  lobefit cost                          measure, and write reports/timings.html and reports/timings.json
  lobefit cost scene.json --out assets --json
  lobefit cost --gpu                    time the emitted WGSL on a graphics processor, and print it
  lobefit cost --gpu --record reports/gpu/mine.json
                                        and write it as a record, with its page mine.html beside it
  lobefit cost --page reports/gpu/mine.json
                                        write the page of a record again
  lobefit cost examples/every-formula.json --page reports/cost.html
                                        write the page of what accuracy costs, by the records in reports/
  lobefit cost --offline --record reports/offline/mine.json
                                        measure every way to compute every quantity, which the page of costs shows
  lobefit cost --isa                    compile every emitted function for three families of AMD GPUs, and count instructions
  lobefit cost --isa --from . --families vega10,gfx1036
                                        for these families, of the bake in this folder
  lobefit cost --isa --from . --assembly ggx_energy_compensation --families navi21
                                        print the machine code of a function
  lobefit cost --isa --code lighting.wgsl
                                        count the function `lighting` of a file of your own
  lobefit cost --isa --from . --drivers ../drivers --families navi21,intel,a660,mali
                                        for GPUs of other vendors, by drivers that crates/gpu/drivers/mesa.sh ../drivers has built
  lobefit cost --isa --record reports/isa/radv-22.3.6.json
                                        write the counts as a record; its name begins with driver and version
  lobefit cost --isa --against reports/isa/radv-22.3.6.json
                                        fail (exit code 1) where a count grew
  lobefit cost --weights --from every --records .
                                        fit what kinds of work cost on each vendor's GPUs, to the records in reports/isa of the bake in every

  lobefit cost scene.json --budget 100 --vendor intel
                                        what to ship: for each effect the most accurate within 100 cycles on Intel's GPUs
  lobefit cost --max-error 0.02 --max-bytes 4096 --language hlsl
                                        the cheapest within an error, and tables within 4096 bytes

Seconds differ from run to run; `check` ignores reports/timings.*, and tells which rows of the records in reports/gpu/ are of
other code than the bake's, and compiles a function again whose code is not that of the record in reports/isa/. --gpu, --isa and --weights are in
the package lobefit-gpu: cargo build --release -p lobefit-gpu. --isa needs Mesa's driver for AMD GPUs (Debian: mesa-vulkan-drivers
libvulkan1), and no GPU.";

/// The command that measures on the processor.
const COMMAND: &str = "lobefit cost";

/// What is said where there is nothing to measure.
pub const NOTHING: &[u8] = b"the scene calls for no effect: nothing to measure, nothing written\n";

/// What machine code is made for where no family is named: GCN, RDNA 2, RDNA 3.
pub const FAMILIES: &str = "amd";

/// Options of `cost`.
#[derive(Args)]
#[command(group(ArgGroup::new("recorded").args(["gpu", "isa", "weights", "offline"])))]
#[command(group(ArgGroup::new("limited").args(["budget", "max_error", "max_bytes"]).multiple(true).conflicts_with_all(["recorded", "page"])))]
#[command(group(ArgGroup::new("compared").args(["weights", "page"])))]
#[command(group(ArgGroup::new("counted").args(["isa", "weights"])))]
pub struct Options {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneOption,
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".", conflicts_with_all = ["recorded", "page"])]
    pub out: PathBuf,
    /// Say what to ship: for each effect the most accurate function of at most so many operations, or with
    /// --vendor of at most this cost on its GPUs. Limits of the scene on functions do not count
    #[arg(long, value_name = "COST", value_parser = positive)]
    pub budget: Option<f64>,
    /// Say what to ship: the cheapest function and the smallest table within this error
    #[arg(long, value_name = "ERROR", value_parser = positive)]
    pub max_error: Option<f64>,
    /// Say what to ship: tables of at most so many bytes, the smallest within --max-error, or the most
    /// accurate
    #[arg(long, value_name = "BYTES")]
    pub max_bytes: Option<u64>,
    /// Count what functions cost on this vendor's GPUs, by the model of its compiled code
    #[arg(long, value_name = "VENDOR", value_parser = vendor(), requires = "limited")]
    pub vendor: Option<Vendor>,
    /// The language of the snippets: rust, wgsl, hlsl, glsl, msl or c; by default wgsl, or the scene's
    /// first where it asks for others alone
    #[arg(long, value_name = "LANGUAGE", value_parser = language(), requires = "limited")]
    pub language: Option<Language>,
    /// Time the emitted WGSL on a graphics processor instead; writes nothing without --record
    #[arg(long)]
    pub gpu: bool,
    /// Take the first graphics processor whose name holds this
    #[arg(long, value_name = "TEXT", requires = "gpu")]
    pub adapter: Option<String>,
    /// Fewer threads and repeats: for software drivers and for trying out
    #[arg(long, requires = "gpu")]
    pub reduced: bool,
    /// Measure every way to compute every quantity instead, on one thread: error against evaluations and
    /// seconds, for --record
    #[arg(long, requires = "record", conflicts_with_all = ["scene", "json"])]
    pub offline: bool,
    /// Compile the emitted functions for families of GPUs instead, and count instructions
    #[arg(long)]
    pub isa: bool,
    /// Fit to the records of counts what kinds of work cost on the GPUs of each vendor
    #[arg(long, requires = "from")]
    pub weights: bool,
    /// The folder in whose reports/isa and reports/gpu the records are
    #[arg(long, value_name = "DIR", default_value = ".", requires = "compared")]
    pub records: PathBuf,
    /// Families of GPUs: navi21, gfx1100 and others of AMD; with --drivers skl, tgl, dg2, a630, a660,
    /// g52; or amd, intel, adreno, mali for the usual ones
    #[arg(
        long,
        value_name = "FAMILY",
        value_delimiter = ',',
        default_value = FAMILIES,
        requires = "isa",
        value_parser = clap::builder::NonEmptyStringValueParser::new()
    )]
    pub families: Vec<String>,
    /// Drivers for Intel, Adreno and Mali GPUs: a folder that crates/gpu/drivers/mesa.sh writes
    #[arg(long, value_name = "DIR", requires = "isa")]
    pub drivers: Option<PathBuf>,
    /// Numbers to compute with; packed code evaluates twice at once
    #[arg(long, value_name = "PRECISION", value_delimiter = ',', requires = "isa", value_parser = Precision::WORDS)]
    pub precisions: Vec<String>,
    /// Print the machine code of this function
    #[arg(long, value_name = "FUNCTION", requires = "isa", conflicts_with_all = ["record", "against", "json"])]
    pub assembly: Option<String>,
    /// Take the bake in this folder, in place of baking a scene
    #[arg(long, value_name = "DIR", requires = "counted", conflicts_with = "scene")]
    pub from: Option<PathBuf>,
    /// Take one function of each of these WGSL files, the one of the file's name, in place of a bake
    #[arg(long, value_name = "FILE,..", value_delimiter = ',', requires = "isa", conflicts_with_all = ["scene", "from", "against", "record"])]
    pub code: Vec<PathBuf>,
    /// Compare with this record of counts, for its families and precisions: exit code 1 where one grew
    #[arg(long, value_name = "RECORD", requires = "isa", conflicts_with_all = ["record", "families", "precisions"])]
    pub against: Option<PathBuf>,
    /// Write the times, counts or weights to this file, whose name ends with .json; beside times their page
    #[arg(long, value_name = "FILE", requires = "recorded")]
    pub record: Option<PathBuf>,
    /// Write the page of a record again, and measure nothing; of a name that ends with .html the page of
    /// what every formula of the scene costs by the records
    #[arg(long, value_name = "FILE", conflicts_with_all = ["recorded", "json"])]
    pub page: Option<PathBuf>,
    /// The worker threads.
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the measurements as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Runs the verb; `words` are those that follow it, for the package that drives graphics
/// processors and their compilers.
pub(super) fn run(options: &Options, words: &[OsString]) -> Result<Outcome, CliError> {
    if let Some(record) = &options.page {
        return if record.extension().is_some_and(|end| end == "html") {
            page::verb(options, record)
        } else {
            record::page(options, record)
        };
    }
    if options.gpu || options.isa || options.weights {
        return external::run("lobefit-gpu", words);
    }
    if options.budget.is_some() || options.max_error.is_some() || options.max_bytes.is_some() {
        return limited::verb(options);
    }
    if let Some(path) = options.record.as_ref().filter(|_| options.offline) {
        return record::offline(options, path);
    }
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    let mut folder = Folder::open(&options.out)?;
    if plan.is_empty() {
        return nothing(options, &input, &plan);
    }
    let more = 1 + effects::stages(options, &plan);
    let progress = Bar::new(options.quiet || options.json, (&input.scene, &plan), more);
    let files = options.threads.install(|| {
        let baked = input.bake(&plan, Selection::default(), &progress)?;
        let effects = effects::timed(options, &plan, &progress)?;
        progress.stage("timings");
        let measured = timings(
            (&input.scene, &baked),
            effects,
            origin(&input, &plan, COMMAND)?,
            device(rayon::current_num_threads()),
        )?;
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

/// The end for a scene that calls for no effect: there is nothing to measure and nothing is
/// written.
fn nothing(options: &Options, input: &Input, plan: &Plan) -> Result<Outcome, CliError> {
    if options.json {
        let origin = origin(input, plan, COMMAND)?;
        let empty = Timings {
            origin,
            device: device(rayon::current_num_threads()),
            tables: None,
            effects: None,
            evaluations: Vec::new(),
            lookups: Vec::new(),
        };
        let files = report::timings_page(&empty).map_err(BakeError::from)?;
        print(json(&files.into_iter().map(|f| (f.path, f.bytes)).collect()))?;
    } else if !options.quiet {
        print(NOTHING)?;
    }
    Ok(Outcome::Done)
}

/// The measurements as JSON.
fn json(files: &Files) -> &[u8] {
    files.get("reports/timings.json").map_or(&[], Vec::as_slice)
}

/// What a measurement of a scene is made from.
///
/// # Errors
/// A recipe that cannot be written as JSON.
pub fn origin(input: &Input, plan: &Plan, command: &str) -> Result<Origin, CliError> {
    Ok(Origin {
        scene: input.scene.name.clone(),
        recipe: recipe(&input.scene, plan, &input.hypotheses)?.hash,
        tool: env!("CARGO_PKG_VERSION").into(),
        command: command.into(),
        pages: Vec::new(),
    })
}

/// The processor as the system names it, and the threads in use.
pub fn device(threads: usize) -> String {
    const LIMIT: u64 = 1 << 20;
    let text = store::read(Path::new("/proc/cpuinfo"), LIMIT).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let model =
        text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, m)| m.trim()));
    let plural = if threads == 1 { "" } else { "s" };
    let model = model.unwrap_or("processor not named");
    format!("{model} ({}), {threads} thread{plural}", std::env::consts::ARCH)
}
