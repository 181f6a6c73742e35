//! What a file says of itself, where no option says how it is to be read.

use super::{Options, Wanted};
use crate::audit::{self, AuditError, AuditedTable, Declared, Fixed};
use lobefit::cli::CliError;
use lobefit::cli::progress::Spinner;

/// An option that bears on texels alone.
fn texels_only(options: &Options) -> Option<&'static str> {
    let given = [("--samples", options.samples.is_some()), ("--points", options.points > 0)];
    given.into_iter().find(|(_, given)| *given).map(|(option, _)| option)
}

/// The table as its own statement has it, or in words why that is not followed. A file without a statement
/// has no such table, nor has one of which options say how it is read.
pub(super) fn stated(
    options: &Options,
    (quantity, column): Wanted,
    fixed: &Fixed,
    audited: &AuditedTable,
    note: &str,
    progress: &Spinner,
) -> Result<Result<Option<Declared>, String>, CliError> {
    if note.is_empty() || !fixed.is_free() {
        return Ok(Ok(None));
    }
    progress.stage("what the file says of itself");
    let found = options.threads.install(|| Ok(audit::declared(audited, quantity, column, note)))?;
    match found {
        Ok(found) => match texels_only(options) {
            Some(option) => Err(CliError::Usage(format!(
                "{option}: {} says itself how it is looked up, and is judged at lookups, not at texels; an option that says how it is \
                 read (--registration) has it judged as any table",
                super::file_name(options)
            ))),
            None => Ok(Ok(Some(found))),
        },
        Err(AuditError::Statement { reason, .. }) => {
            let what = super::file_name(options);
            Ok(Err(format!(
                "{what}: what it says of itself is not followed ({reason}); it is read as any table"
            )))
        }
        Err(error) => Err(error.into()),
    }
}
