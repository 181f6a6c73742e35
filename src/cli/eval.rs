//! `lobefit eval`: the truth at given points.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::{Args, ValueEnum};

use super::CliError;
use super::input;
use super::options::{ThreadsOption, draw, positive, quantity, sequence, smith};
use super::output::{Outcome, print, say_each};
use super::points::{self, Points, Row};
use super::progress::Spinner;
use crate::data::Smith;
use crate::store;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::monte_carlo::{self, Draw, Points as Sequence, Run};
use lobefit_truth::quantity::{Choice, Input, QUANTITIES, Quantity};
use rayon::prelude::*;

const EXAMPLES: &str = "\
Examples:
  lobefit eval ggx-reflection --points points.csv > values.csv
  printf 'alpha,mu\\n0.25,0.5\\n' | lobefit eval ggx-reflection --points -
  lobefit eval ggx-average --points alphas.csv --out averages.csv --smith separable
  printf 'alpha,mu,f0,specular\\n0.25,0.5,0.04,compensated\\n' | lobefit eval diffuse-coupling --points -
  printf 'alpha,rho\\n0.25,0.5\\n' | lobefit eval parallax-alpha --kernel mine.json --points -
  lobefit eval ggx-reflection --points points.csv --method monte-carlo --samples 1048576 --seed 7
";

const REMARKS: &str = "\
alpha = roughness^2 in most engines, and mu is n_dot_v. alpha 0 is a mirror, or smooth glass. Monte Carlo takes no zeros, but mu
where the lobe has a value there. Other columns are kept as they are. `error` estimates the largest distance of a value from the
truth, from two rules of quadrature of which one has twice the nodes: it holds at all but 1 of 1000 points. With Monte Carlo it is
four standard errors. Of a kernel's table the truth is that of the lobes as they are interpolated: between few widths they may
differ by more.";

/// What the help says after the options: examples, and every quantity with its columns.
pub(super) fn after_help() -> String {
    let row = |quantity: &&dyn Quantity| {
        let choices = quantity.choices().iter().filter(|choice| **choice != Choice::Smith);
        let choices = choices.map(|choice| format!("{} ({})", choice.name(), choice.words().join(", ")));
        let domain = |input: &Input| domain(input, quantity.smallest_alpha());
        let inputs: Vec<String> = quantity.inputs().iter().map(domain).chain(choices).collect();
        let remark = match quantity.remark() {
            "" => String::new(),
            remark => format!(" ({remark})"),
        };
        let (name, outputs) = (quantity.name(), quantity.outputs().join(", "));
        format!("  {name:<20}  {}: {outputs}{remark}\n", inputs.join(", "))
    };
    let rows: String = QUANTITIES.iter().map(row).collect();
    format!("{EXAMPLES}\nQuantities (input columns: appended columns):\n{rows}{REMARKS}")
}

/// `mu (0 to 1)`, `alpha (0, 1e-7 to 1)`: an input with its domain, where that ends.
fn domain(input: &Input, smallest_alpha: f64) -> String {
    let short = |x: f64| format!("{x:?}").trim_end_matches(".0").to_owned();
    let (name, [low, high]) = (input.name, input.domain);
    match (low, high) {
        (low, high) if !(low > f64::MIN && high < f64::MAX) => format!("{name} (any)"),
        (0.0, high) if name.starts_with("alpha") => {
            format!("{name} (0, {} to {})", short(smallest_alpha), short(high))
        }
        (low, high) => format!("{name} ({} to {})", short(low), short(high)),
    }
}

/// How the truth is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Method {
    /// Deterministic quadrature
    #[default]
    Quadrature,
    /// The independent second opinion
    MonteCarlo,
}

/// Options of `eval`.
#[derive(Args)]
pub(super) struct Options {
    /// Quantity to compute
    #[arg(value_parser = quantity())]
    pub quantity: &'static dyn Quantity,
    /// CSV file with a header (`-`: standard input)
    #[arg(long, value_name = "IN.csv")]
    pub points: PathBuf,
    /// CSV file to write; without it, standard output
    #[arg(long, value_name = "OUT.csv")]
    pub out: Option<PathBuf>,
    /// Lobe of every point of a quantity with a kernel, in place of a column `kernel`: its word, or
    /// a .json file with its table
    #[arg(long, value_name = "WORD|FILE")]
    pub kernel: Option<String>,
    /// Shadowing form
    #[arg(long, value_name = "S", value_parser = smith(), default_value = "correlated")]
    pub smith: Smith,
    /// Largest error to accept of a value; without it, the quantity's own promise (1e-4 where the
    /// kernel is a table, 1e-3 of one that ends with a jump)
    #[arg(long, value_name = "T", value_parser = positive)]
    pub tolerance: Option<f64>,
    /// How the truth is computed
    #[arg(long, value_enum, default_value_t)]
    pub method: Method,
    /// Samples of each point (monte-carlo only)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(32..=1 << 32))]
    pub samples: Option<u64>,
    /// Seed of the samples (monte-carlo only)
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// What a sample draws: lights uniform over the hemisphere or weighted by their cosine, normals by the
    /// distribution (ndf) or visible ones (monte-carlo only; glass: ndf or visible)
    #[arg(long, value_name = "DRAW", value_parser = draw())]
    pub draw: Option<Draw>,
    /// The points that drive the samples (monte-carlo only; without it, scrambled Sobol points)
    #[arg(long, value_name = "SEQUENCE", value_parser = sequence())]
    pub sequence: Option<Sequence>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    check_sampling(options)?;
    // Before the work.
    options.out.iter().try_for_each(|path| store::free(path))?;
    let name = points_name(&options.points);
    let mut points = Points::parse(read(&options.points, &name)?, &name, options.quantity)?;
    if let Some(word) = &options.kernel {
        fix_kernel(&mut points, word, options.quantity)?;
    }
    points.variants().for_each(|variant| variant.smith = Some(options.smith));
    let progress = Spinner::new(options.quiet);
    let values = options.threads.install(|| evaluate(options, &points, &progress))?;
    drop(progress);
    let csv = points.with_columns(options.quantity, &values)?;
    match &options.out {
        Some(path) => store::write(path, &csv).map(drop)?,
        None => print(&csv)?,
    }
    Ok(match broken_promise(options, &points, &values) {
        None => Outcome::Done,
        Some(message) => {
            say_each("error", &[message]);
            Outcome::Failed
        }
    })
}

/// Refuses options of samples where there are none, and what the quantity does not draw.
fn check_sampling(options: &Options) -> Result<(), CliError> {
    let given = options.samples.is_some() || options.seed.is_some();
    if options.method == Method::Quadrature && (given || options.draw.is_some() || options.sequence.is_some())
    {
        let message = "--samples, --seed, --draw and --sequence belong to --method monte-carlo; quadrature has none of them";
        return Err(CliError::Usage(message.into()));
    }
    let Some(draw) = options.draw else { return Ok(()) };
    let (name, draws) = (options.quantity.name(), options.quantity.draws());
    if draws.contains(&draw) {
        return Ok(());
    }
    let has = match draws {
        [] => "has a way of its own: leave --draw out".into(),
        draws => format!("draws {}", draws.iter().map(|draw| draw.name()).collect::<Vec<_>>().join(" or ")),
    };
    Err(CliError::Usage(format!("--draw {}: {name} {has}", draw.name())))
}

/// Which rows of quadrature are farther off than the quantity promises, where nothing else was asked
/// for: their values stand in the file, with the error that was reached.
fn broken_promise(options: &Options, points: &Points, values: &[f64]) -> Option<String> {
    if options.method == Method::MonteCarlo || options.tolerance.is_some() {
        return None;
    }
    let misses = |(row, values): (Row<'_>, &[f64])| {
        let promise = options.quantity.tolerance(row.variant);
        let error = values.last().copied().filter(|error| *error > promise)?;
        Some(format!("error {error:e} is above the promise of {}, {promise:e}", options.quantity.name()))
    };
    let values = values.chunks(options.quantity.outputs().len());
    let rows = (0..points.len()).map(|i| points.row(i)).zip(values).enumerate();
    let missing: Vec<(usize, String)> = rows.filter_map(|(i, row)| Some((i, misses(row)?))).collect();
    let (first, message) = missing.first()?;
    let more = match missing.len() - 1 {
        0 => String::new(),
        more => format!("; so do {more} rows more"),
    };
    Some(format!("{}{more}. All rows are written", points.refuse(*first, message)))
}

/// Gives every point the kernel of a word.
fn fix_kernel(points: &mut Points, word: &str, quantity: &dyn Quantity) -> Result<(), CliError> {
    if !quantity.has(Choice::Kernel) {
        let having: Vec<&str> =
            QUANTITIES.iter().filter(|q| q.has(Choice::Kernel)).map(|q| q.name()).collect();
        let (name, having) = (quantity.name(), having.join(", "));
        return Err(CliError::Usage(format!("--kernel: {name} has no kernel; {having} has")));
    }
    if points.variants().any(|variant| variant.kernel.is_some()) {
        let message = "--kernel: the points have a column `kernel` too; give one of them";
        return Err(CliError::Usage(message.into()));
    }
    let kernel = input::kernel(word)?;
    points.variants().for_each(|variant| variant.kernel = Some(kernel.clone()));
    Ok(())
}

/// Samples of a point where none are asked for.
const SAMPLES: u64 = 1 << 20;

/// Standard errors in the error column of Monte Carlo.
const STANDARD_ERRORS: f64 = 4.0;

/// The outputs at a point; to the quantity's own tolerance by default.
fn outputs(options: &Options, Row { inputs, variant }: Row<'_>) -> Result<Vec<f64>, IntegrateError> {
    let quantity = options.quantity;
    match options.method {
        Method::Quadrature => {
            let promise = || quantity.tolerance(variant);
            match quantity.at(variant, inputs, options.tolerance.unwrap_or_else(promise)) {
                // What the largest rule reaches, with its error.
                Err(IntegrateError::Tolerance { reached, .. }) if options.tolerance.is_none() => {
                    quantity.at(variant, inputs, reached)
                }
                done => done,
            }
        }
        Method::MonteCarlo => {
            let samples = options.samples.unwrap_or(SAMPLES);
            let default = monte_carlo::sobol(samples, options.seed.unwrap_or_default());
            let (draw, points) =
                (options.draw.unwrap_or(default.draw), options.sequence.unwrap_or(default.points));
            let run = Run { draw, points, ..default };
            let sampled = quantity.second_opinion(variant, inputs, run)?;
            let error = sampled.iter().map(|column| column.standard_error).fold(0.0, f64::max);
            let values = sampled.into_iter().map(|column| column.value);
            Ok(values.chain([STANDARD_ERRORS * error]).collect())
        }
    }
}

/// Rows that are computed at once: what each gives is kept beside the others without a list of its own.
const BATCH: usize = 1 << 16;

/// Stages of progress at most.
const STAGES: usize = 100;

/// The outputs at every row, one after another.
fn evaluate(options: &Options, points: &Points, progress: &Spinner) -> Result<Vec<f64>, CliError> {
    let columns = options.quantity.outputs().len();
    let (done, every) = (AtomicUsize::new(0), points.len().div_ceil(STAGES).max(1));
    progress.stage(&format!("0 of {} rows", points.len()));
    let row = |i: usize| {
        let values = outputs(options, points.row(i)).map_err(|e| points.refuse(i, &e.to_string()))?;
        if values.len() != columns {
            return Err(points.refuse(i, &format!("{} values for {columns} columns", values.len())));
        }
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        if done.is_multiple_of(every) {
            progress.stage(&format!("{done} of {} rows", points.len()));
        }
        let error = values.last().copied().unwrap_or(f64::NAN);
        match options.tolerance {
            Some(tolerance) if error.is_nan() || error > tolerance => {
                let message =
                    format!("error {error:e} is above the tolerance {tolerance:e}; give more --samples");
                Err(points.refuse(i, &message))
            }
            _ => Ok(values),
        }
    };
    let mut all = Vec::with_capacity(points.len() * columns);
    for first in (0..points.len()).step_by(BATCH) {
        let batch: Vec<_> = (first..points.len().min(first + BATCH)).into_par_iter().map(row).collect();
        for values in batch {
            all.extend(values?);
        }
    }
    Ok(all)
}

fn points_name(path: &Path) -> String {
    if path.as_os_str() == "-" { "<stdin>".into() } else { path.display().to_string() }
}

fn read(path: &Path, name: &str) -> Result<Vec<u8>, CliError> {
    Ok(if path.as_os_str() == "-" {
        store::read_stream(io::stdin().lock(), name, points::FILE_BYTES)?
    } else {
        store::read(path, points::FILE_BYTES)?
    })
}
