//! What the verb of another package declares: its binary prints it, and completions and manual pages of
//! this program are made of it.

use std::ffi::{OsStr, OsString};
use std::process::ExitCode;

use clap::{Arg, ArgAction, Command, Parser};
use serde::{Deserialize, Serialize};

use super::CliError;
use super::external::{VERBS, ask};
use super::output::{Outcome, finish, print_json, usage};

/// Asks a binary for its declaration.
const DECLARED: &str = "--declared";

/// A verb.
#[derive(Serialize, Deserialize)]
struct Declared {
    about: String,
    examples: String,
    arguments: Vec<Argument>,
}

/// An option, or where it has no name on the command line, a file or folder.
#[derive(Serialize, Deserialize)]
struct Argument {
    name: String,
    long: Option<String>,
    short: Option<char>,
    help: String,
    /// The name of its value; none of a switch.
    value: Option<String>,
    values: Vec<String>,
    required: bool,
    /// Whether it may be given more than once.
    repeats: bool,
    defaults: Vec<String>,
}

/// Runs the verb of a package on its arguments (the first is the program's name).
pub fn verb<O: Parser>(
    arguments: impl IntoIterator<Item = OsString>,
    run: impl FnOnce(O) -> Result<Outcome, CliError>,
) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if arguments.get(1).is_some_and(|word| word == DECLARED) {
        return finish(print_json(&Declared::of(&O::command())).map(|()| Outcome::Done));
    }
    match parsed::<O>(arguments) {
        Ok(options) => finish(run(options)),
        Err(wrong) => usage(&wrong),
    }
}

/// Options of arguments. A negative number is a value, of which the check of the option's range speaks.
///
/// # Errors
/// Arguments that the options do not take.
pub fn parsed<O: Parser>(arguments: impl IntoIterator<Item = OsString>) -> Result<O, clap::Error> {
    let mut command = numbered(O::command());
    let found = command.try_get_matches_from_mut(arguments)?;
    O::from_arg_matches(&found).map_err(|wrong| wrong.format(&mut command))
}

fn numbered(command: Command) -> Command {
    let with_values = |arg: Arg| match arg.get_action().takes_values() {
        true => arg.allow_negative_numbers(true),
        false => arg,
    };
    command.mut_args(with_values).mut_subcommands(numbered)
}

/// The program with the verbs of the packages that are built, as their binaries declare them.
///
/// # Errors
/// A binary that does not answer.
pub(super) fn whole(mut program: Command) -> Result<Command, CliError> {
    for (verb, (package, before)) in VERBS {
        let words: Vec<&OsStr> = before.iter().chain([&DECLARED]).map(OsStr::new).collect();
        let declared: Declared = match ask(package, &words) {
            Ok(answer) => serde_json::from_slice(&answer)
                .map_err(|error| CliError::NotRun { program: package.into(), reason: error.into() })?,
            Err(CliError::NotBuilt { .. }) => continue,
            Err(error) => return Err(error),
        };
        program = program.mut_subcommand(verb, |_| declared.command(verb));
    }
    Ok(program)
}

impl Declared {
    fn of(command: &Command) -> Declared {
        let text =
            |styled: Option<&clap::builder::StyledStr>| styled.map(ToString::to_string).unwrap_or_default();
        let argument = |own: &Arg| Argument {
            name: own.get_id().to_string(),
            long: own.get_long().map(String::from),
            short: own.get_short(),
            help: text(own.get_help()),
            value: own.get_action().takes_values().then(|| match own.get_value_names() {
                Some([name, ..]) => name.to_string(),
                _ => own.get_id().as_str().to_uppercase(),
            }),
            values: own.get_possible_values().iter().map(|value| value.get_name().to_string()).collect(),
            required: own.is_required_set(),
            repeats: matches!(own.get_action(), ArgAction::Append),
            defaults: own
                .get_default_values()
                .iter()
                .map(|text| text.to_string_lossy().into_owned())
                .collect(),
        };
        Declared {
            about: text(command.get_about()),
            examples: text(command.get_after_help()),
            arguments: command.get_arguments().map(argument).collect(),
        }
    }

    fn command(self, verb: &'static str) -> Command {
        let argument = |own: Argument| {
            let mut arg =
                Arg::new(own.name).help(own.help).required(own.required).default_values(own.defaults);
            if own.repeats {
                arg = arg.action(ArgAction::Append);
            }
            if let Some(long) = own.long {
                arg = arg.long(long);
            }
            if let Some(short) = own.short {
                arg = arg.short(short);
            }
            match own.value {
                Some(value) if own.values.is_empty() => arg.value_name(value),
                Some(value) => arg.value_name(value).value_parser(own.values),
                None => arg.action(ArgAction::SetTrue),
            }
        };
        Command::new(verb)
            .about(self.about)
            .after_help(self.examples)
            .args(self.arguments.into_iter().map(argument))
    }
}
