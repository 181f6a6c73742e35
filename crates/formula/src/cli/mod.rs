//! `lobefit fit`: a formula of the user's, fitted and certified.

mod options;

use std::ffi::OsString;
use std::process::ExitCode;

use crate::fitting::{self, Certified, FittingError};
use crate::search;
use lobefit::cli::CliError;
use lobefit::cli::cost::RecordPlace;
use lobefit::cli::declared;
use lobefit::cli::output::{self, Outcome, print, say};
use lobefit::cli::progress::Spinner;
use lobefit::data::Use;
use lobefit::scene::escape::visible;
use lobefit::store::{Files, Folder, Written};
use lobefit_fit::search::Progress;

use options::Options;

const EXAMPLES: &str = "\
Examples:
  lobefit fit mine.wgsl --to ggx-reflection:E --use normalisation
  lobefit fit mine.wgsl --to ggx-reflection:E --norm rms --weight mu --domain roughness=0.1..1
  lobefit fit blend.wgsl --to ggx-reflection --use f0-blend --out fitted
  lobefit fit mine.wgsl --to ggx-reflection:E --exact alpha=0 --range 0..1 --precision f32 --precision f16
  lobefit fit --search --to ggx-reflection:E --use normalisation --max-ops 13 --out found
  lobefit fit --search --to ggx-reflection --use f0-blend --max-ops 16 --out found
  lobefit fit --search --to diffuse-coupling --fix specular=normalised --max-ops 12
  lobefit fit --search --to ggx-reflection:E --max-ops 14 --helpers exp2,complement
  lobefit fit thin.wgsl --to ggx-glass:R --fix side=outside --domain ior=1.5..1.5 --limit 0.01

The formula is the last function of a WGSL file; its free parameters are `override` declarations, whose values are where the
search starts; its arguments are inputs by name:
  override c: f32 = 2.0;
  fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + c * alpha * alpha * mu; }

Inputs: roughness and the alpha that follows from it, mu, ior, alpha_x, alpha_y, phi, f0, as the quantity has them.
Parameters that coincide or do not matter are an error (exit code 2, with the rank), or told of with --allow-undetermined.
Where the formula has a divisor, the fit is proven to keep its sign over the whole domain; without the proof the exit code is 1.

With --search no formula is given: forms of the inputs (quotients of sums of powers) are searched for the most accurate one of every
cost up to --max-ops, by the operation model of the reports (add, mul, fma 1; rcp, sqrt, exp2 4; a division is rcp + mul).
Square roots and exponentials, as factors of terms and of whole forms, are first tried in narrow searches; those that take away 3 %
of the error or more are used (of the factors the best two), and what each gained is printed. --helpers says otherwise.
Formulas of f0 are made of two forms, which share what they can.
Where the truth has one value at alpha = 0, as a mirror's albedo, the forms have it exactly; --exact INPUT=0 says otherwise.

With --out, writes NAME.html (page), NAME.json and NAME.{wgsl,rs,hlsl,glsl,metal,h} into the folder, NAME being the function's
name. A search that does not converge, a missing proof or an error above --limit: exit code 1, nothing written.";

/// What the help says after the options.
fn after_help() -> String {
    let use_of = |used_as: Use| format!("  {:<14} {}\n", used_as.name, used_as.meaning);
    let uses: String = Use::all().into_iter().map(use_of).collect();
    format!("{EXAMPLES}\n\nUses:\n{uses}")
}

/// Runs the verb on its arguments (the first is the program's name).
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    declared::verb(arguments, |options| verb(&options))
}

fn verb(options: &Options) -> Result<Outcome, CliError> {
    if options.search { searched(options) } else { fitted(options) }
}

/// A fit of the user's formula.
fn fitted(options: &Options) -> Result<Outcome, CliError> {
    let job = options.job()?;
    publish(options, "integrating and fitting", |_, written| {
        let fitting = fitting::fit(&job)?;
        let problem =
            |fit: &Certified, problem: &String| visible(&format!("{}: {problem}", fit.approximation.name));
        let problems = fitting.fits.iter().flat_map(|fit| fit.problems.iter().map(move |p| problem(fit, p)));
        let problems: Vec<String> = problems.collect();
        let wanted = written && problems.is_empty();
        let files = if wanted { fitting::files(&job, &fitting)? } else { Files::new() };
        let shown = if options.json {
            fitting::document(&job, &fitting)?
        } else {
            lines(&fitting::summary(&job, &fitting, written)?)
        };
        Ok(Made { shown, problems, files })
    })
}

/// A search for formulas.
fn searched(options: &Options) -> Result<Outcome, CliError> {
    let job = options.search_job()?;
    let place = options.record.as_deref().map(|path| RecordPlace::of("--record", path)).transpose()?;
    let mut folder = place.as_ref().map(RecordPlace::open).transpose()?;
    let mut record = None;
    let outcome = publish(options, "integrating", |spinner, written| {
        let searched = search::run(&job, &|at| spinner.stage(&told(at)))?;
        let problems: Vec<String> = searched.problem(job.limit).into_iter().collect();
        let wanted = written && problems.is_empty();
        let files = if wanted { search::files(&job, &searched)? } else { Files::new() };
        record = Some(search::record(&job, &searched).bytes().map_err(FittingError::from)?);
        let shown = if options.json {
            search::document(&job, &searched)?
        } else {
            lines(&search::summary(&searched, written))
        };
        Ok(Made { shown, problems, files })
    })?;
    if let (Outcome::Done, Some(place), Some(folder), Some(record)) = (&outcome, &place, &mut folder, record)
    {
        place.write_bytes(folder, record, None, options.quiet || options.json)?;
    }
    Ok(outcome)
}

/// What a fit or a search came to.
struct Made {
    /// The document, or the words.
    shown: Vec<u8>,
    /// Why it cannot be relied on, each a sentence.
    problems: Vec<String>,
    /// What is written, where a folder is given and there are no problems.
    files: Files,
}

/// Makes, prints and writes; the work hears whether its files are wanted.
fn publish(
    options: &Options,
    stage: &str,
    make: impl FnOnce(&Spinner, bool) -> Result<Made, CliError> + Send,
) -> Result<Outcome, CliError> {
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = options.out.as_deref().map(Folder::open_flat).transpose()?;
    let spinner = Spinner::new(options.quiet || options.json);
    spinner.stage(stage);
    let made = options.threads.install(|| make(&spinner, folder.is_some()));
    drop(spinner);
    let Made { shown, problems, files } = made?;
    if options.json || !options.quiet {
        print(&shown)?;
    }
    if !problems.is_empty() {
        problems.iter().for_each(|problem| say(problem));
        if folder.is_some() {
            say("nothing written");
        }
        return Ok(Outcome::Failed);
    }
    if let Some(folder) = &mut folder {
        let written = folder.write(&files)?;
        if !options.quiet && !options.json {
            print(written_files(options, &written).as_bytes())?;
        }
    }
    Ok(Outcome::Done)
}

/// A text line by line, without what a terminal would obey.
fn lines(text: &str) -> Vec<u8> {
    text.lines().map(|line| visible(line) + "\n").collect::<String>().into_bytes()
}

/// How far a search is.
fn told(at: &Progress) -> String {
    let Progress { trial, sweep, sweeps, ops, max_ops, forms, best, .. } = at;
    let trial = trial.map_or(String::new(), |[k, count]| format!("what pays ({k} of {count}): "));
    format!(
        "{trial}sweep {} of at most {sweeps}, {ops} of {max_ops} operations, {forms} forms tried, error {best:.5} so far",
        sweep + 1
    )
}

/// What lies in the output folder now.
fn written_files(options: &Options, written: &Written) -> String {
    let folder = options.out.iter().map(|out| visible(&out.display().to_string())).collect::<String>();
    let mut files: Vec<&str> = written.written.iter().chain(&written.unchanged).map(String::as_str).collect();
    files.sort_unstable();
    format!("\nin {folder}: {}\n{}\n", visible(&files.join(", ")), output::files(written))
}
