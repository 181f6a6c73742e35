//! Verbs whose code is in another package: their binaries are run in place of this one, as git and
//! cargo run theirs.

use std::env;
use std::ffi::{OsStr, OsString};
use std::io;
use std::path::PathBuf;
use std::process::Command;

use clap::Args;

use super::CliError;
use super::output::Outcome;

/// What follows the verb, for its binary to read.
#[derive(Args)]
pub(super) struct Words {
    /// Options and files of the verb: `lobefit VERB --help` lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    pub words: Vec<OsString>,
}

/// Verbs of other packages: the binary of each, and the words before those of the verb.
pub(super) const VERBS: [(&str, (&str, &[&str])); 4] = [
    ("audit", ("lobefit-audit", &[])),
    ("fit", ("lobefit-formula", &[])),
    ("furnace", ("lobefit-audit", &["furnace"])),
    ("report", ("lobefit-studies", &[])),
];

/// The arguments of the program; `help VERB` of another package's verb becomes `VERB --help`, which
/// its binary answers.
pub(super) fn help_of_verb(arguments: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = arguments.into_iter().collect();
    let external = arguments.get(2).is_some_and(|verb| VERBS.iter().any(|(own, _)| verb == own));
    if external && arguments.len() == 3 && arguments[1] == "help" {
        arguments.remove(1);
        arguments.push("--help".into());
    }
    arguments
}

/// Runs a package's binary on the words that follow the verb, with the streams and the exit code of
/// this process.
pub(super) fn run(package: &'static str, words: &[OsString]) -> Result<Outcome, CliError> {
    let mut command = Command::new(find(package)?);
    let program = command.get_program().to_string_lossy().into_owned();
    handed_over(command.args(words)).map_err(|reason| CliError::NotRun { program, reason })
}

/// What a package's binary prints on the words, where it ends with 0 or 1.
///
/// # Errors
/// A package that is not built; a binary that ends otherwise, with what it says.
pub fn ask(package: &'static str, words: &[&OsStr]) -> Result<Vec<u8>, CliError> {
    let mut command = Command::new(find(package)?);
    let program = command.get_program().to_string_lossy().into_owned();
    match command.args(words).output() {
        Ok(output) if matches!(output.status.code(), Some(0 | 1)) => Ok(output.stdout),
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
            Err(CliError::NotRun { program, reason: io::Error::other(said) })
        }
        Err(reason) => Err(CliError::NotRun { program, reason }),
    }
}

/// The binary: beside the running program, else on PATH.
fn find(package: &'static str) -> Result<PathBuf, CliError> {
    let own = env::current_exe().ok();
    let beside = own.as_ref().and_then(|own| own.parent()).map(PathBuf::from);
    let path = env::var_os("PATH").unwrap_or_default();
    let name = format!("{package}{}", env::consts::EXE_SUFFIX);
    let found = beside.into_iter().chain(env::split_paths(&path)).map(|folder| folder.join(&name));
    found.into_iter().find(|file| file.is_file()).ok_or_else(|| CliError::NotBuilt {
        package,
        program: own.map_or_else(|| "lobefit".into(), |own| own.display().to_string()),
    })
}

/// On Unix the binary takes this process over, signals and all.
#[cfg(unix)]
fn handed_over(command: &mut Command) -> Result<Outcome, io::Error> {
    use std::os::unix::process::CommandExt;
    Err(command.exec())
}

#[cfg(not(unix))]
fn handed_over(command: &mut Command) -> Result<Outcome, io::Error> {
    // The binary has printed its own error; a process that a signal ended has no code.
    std::process::exit(command.status()?.code().unwrap_or(1))
}
