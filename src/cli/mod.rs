//! Top floor: one file per verb. Results go to standard output, everything else to standard error.
//!
//! Exit codes: 0 done; 1 a check or promise failed; 2 bad input or usage; 3 cannot write.

mod bake;
mod cache;
mod calls;
mod check;
pub mod columns;
pub mod cost;
pub mod declared;
mod error;
mod eval;
pub mod external;
pub mod input;
mod manual;
mod merge;
pub mod options;
pub mod output;
mod plan;
pub mod points;
pub mod progress;
mod scene_from;
mod schema;
pub mod word;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

pub use error::{CliError, PackageError};

const EXAMPLES: &str = "\
Examples:
  lobefit bake                          bake the built-in scene into tables/ fits/ reports/
  lobefit plan scene.json               what the scene calls for, and what it leaves out and why
  lobefit bake scene.json --out assets  bake a scene of your own
  lobefit check scene.json              in CI: do the committed files follow from the scene?

Exit codes: 0 done; 1 a check or promise failed; 2 bad input or usage; 3 cannot write.";

/// Integrates BRDF quantities to a stated accuracy, compresses them into tables and fits, and emits
/// what a renderer needs with its measured error.
#[derive(Parser)]
#[command(name = "lobefit", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Say what a scene calls for, what it leaves out and why
    #[command(after_help = plan::EXAMPLES)]
    Plan(plan::Options),
    /// Integrate, fit, emit and report what a scene calls for
    #[command(after_help = bake::EXAMPLES)]
    Bake(bake::Options),
    /// Put the pieces together that `bake --shard` has made
    #[command(after_help = merge::EXAMPLES)]
    Merge(merge::Options),
    /// Bake again and compare with the files that are there
    #[command(after_help = check::EXAMPLES)]
    Check(check::Options),
    /// Compute a quantity at the points of a CSV file
    #[command(after_help = eval::after_help())]
    Eval(eval::Options),
    /// Fit a formula of your own to a quantity, or search for formulas (--search)
    #[command(disable_help_flag = true)]
    Fit(external::Words),
    /// Measure a table or shader function that somebody ships against the truth
    #[command(disable_help_flag = true)]
    Audit(external::Words),
    /// Measure a whole BRDF of a shader file in a white furnace, and for reciprocity
    #[command(disable_help_flag = true)]
    Furnace(external::Words),
    /// Measure what accuracy costs in time
    #[command(after_help = cost::EXAMPLES)]
    Cost(Box<cost::Options>),
    /// Make the page of a long study, which no bake waits for
    #[command(disable_help_flag = true)]
    Report(external::Words),
    /// Say what the cache of bakes holds, or clear it
    #[command(after_help = cache::EXAMPLES)]
    Cache(cache::Options),
    /// Print the scene that a glTF or MaterialX file is read as
    #[command(after_help = scene_from::EXAMPLES)]
    SceneFrom(scene_from::Options),
    /// Print the JSON Schema of the scene
    #[command(after_help = schema::EXAMPLES)]
    Schema(schema::Options),
    /// Print the completions of a shell
    #[command(after_help = manual::COMPLETIONS)]
    Completions(manual::CompletionOptions),
    /// Write the manual pages of the program and of its verbs
    #[command(after_help = manual::MAN)]
    Man(manual::ManOptions),
}

/// Runs the program on its arguments (the first is its own name).
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = external::help_of_verb(arguments);
    let cli: Cli = match declared::parsed(arguments.clone()) {
        Ok(cli) => cli,
        Err(usage) => return output::usage(&usage),
    };
    let done = match cli.verb {
        Verb::Plan(options) => plan::run(&options),
        Verb::Bake(options) => bake::run(&options),
        Verb::Merge(options) => merge::run(&options),
        Verb::Check(options) => check::run(&options),
        Verb::Eval(options) => eval::run(&options),
        Verb::Fit(external) => external::run("lobefit-formula", &external.words),
        Verb::Audit(external) => external::run("lobefit-audit", &external.words),
        Verb::Furnace(external) => {
            let verb = [OsString::from("furnace")];
            external::run("lobefit-audit", &[&verb[..], &external.words].concat())
        }
        Verb::Cost(options) => cost::run(&options, &arguments[2..]),
        Verb::Report(external) => external::run("lobefit-studies", &external.words),
        Verb::Cache(options) => cache::run(&options),
        Verb::SceneFrom(options) => scene_from::run(&options),
        Verb::Schema(options) => schema::run(&options),
        Verb::Completions(options) => {
            declared::whole(Cli::command()).and_then(|all| manual::completions(&options, all))
        }
        Verb::Man(options) => declared::whole(Cli::command()).and_then(|all| manual::man(&options, all)),
    };
    output::finish(done)
}
