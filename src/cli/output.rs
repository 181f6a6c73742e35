//! Standard output, standard error and the exit code.

use std::io::{self, Write};
use std::process::ExitCode;

use serde::Serialize;

use super::CliError;
use crate::report::words;
use crate::scene::escape::visible;
use crate::store::Written;

/// How a verb ended that did its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All is well: exit code 0.
    Done,
    /// A check or promise failed, and the verb has said which: exit code 1.
    Failed,
}

/// Writes a result to standard output. A reader that has gone away is no error: it has what it
/// wanted.
pub fn print(bytes: &[u8]) -> Result<(), CliError> {
    printed(io::stdout().lock().write_all(bytes))
}

/// `1 file written, 2 unchanged`.
pub fn files(written: &Written) -> String {
    let new = words::count(written.written.len(), "file", "files");
    format!("{new} written, {} unchanged", written.unchanged.len())
}

/// Ends what was written to standard output.
fn printed(done: io::Result<()>) -> Result<(), CliError> {
    match done.and_then(|()| io::stdout().flush()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(CliError::Output(e)),
        _ => Ok(()),
    }
}

/// Writes a result to standard output as JSON, one document with a line end.
pub fn print_json(value: &impl Serialize) -> Result<(), CliError> {
    let mut text = serde_json::to_vec_pretty(value)?;
    text.push(b'\n');
    print(&text)
}

/// Says something on standard error; where nobody can read it, nothing can be done about that.
pub fn say(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Says which promises of a scene are not kept. Each is a line, and lines on what would keep it: no name of
/// a scene holds the end of a line.
pub fn say_broken(promises: &[String]) {
    say_each("promise not kept", promises);
}

/// Says texts of the same kind; further lines of each are indented.
pub fn say_each(kind: &str, texts: &[String]) {
    for text in texts {
        let mut lines = text.lines().map(visible);
        say(&format!("{kind}: {}", lines.next().unwrap_or_default()));
        lines.for_each(|line| say(&format!("  {line}")));
    }
}

/// The exit code of a verb, after its error was said.
pub fn finish(done: Result<Outcome, CliError>) -> ExitCode {
    match done {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Failed) => ExitCode::from(1),
        Err(error) => {
            say(&format!("error: {error}"));
            ExitCode::from(error.exit_code())
        }
    }
}

/// Help and version on standard output with exit code 0, wrong usage on standard error with exit
/// code 2.
pub fn usage(error: &clap::Error) -> ExitCode {
    let done = error.print();
    if error.use_stderr() { ExitCode::from(2) } else { finish(printed(done).map(|()| Outcome::Done)) }
}
