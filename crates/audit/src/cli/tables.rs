//! Which table of a file is meant, and which quantity the file says that it stands for.

use super::{Options, Read, Wanted, file_name, named, sidecar};
use crate::audit::{self, AuditedTable};
use crate::foreign::{self, Hints};
use lobefit::cli::CliError;
use lobefit::cli::options::quantity_of;
use lobefit::cli::output::say;

/// What the file is measured as: what the options say, or else what the file says of itself.
pub(super) fn wanted(options: &Options, bytes: &[u8], is_shader: bool) -> Result<Wanted, CliError> {
    let file = options.file.display();
    match (options.stands_for, is_shader) {
        (Some(wanted), _) => Ok(wanted),
        (None, false) if let Some(name) = stated(options, bytes)? => {
            let found = quantity_of(&name).map(|quantity| (quantity, None));
            found.map_err(|why| CliError::Usage(format!("{file}: says that it is of `{name}`: {why}")))
        }
        _ => Err(CliError::Usage(format!(
            "{file}: does not say which quantity it stands for; say it by --as: {}{}",
            audit::audited(),
            lacking(options, bytes)
        ))),
    }
}

/// The quantity that the file's sidecar or its header names; none of another's file.
fn stated(options: &Options, bytes: &[u8]) -> Result<Option<String>, CliError> {
    if let Ok(Some(beside)) = sidecar::beside(options, bytes.len()) {
        return Ok(Some(beside.said.quantity));
    }
    let file = options.file.display().to_string();
    let tables = read(options, bytes, &Hints { layer: None, ..hints(options) })?;
    let names = tables.iter().map(|table| audit::stated_quantity(&table.note));
    let names = names.collect::<Result<Vec<Option<&str>>, String>>();
    let names = names.map_err(|why| CliError::Usage(format!("{file}: its attribute `lobefit`: {why}")))?;
    let mut names: Vec<&str> = names.into_iter().flatten().collect();
    names.dedup();
    match names[..] {
        [] => Ok(None),
        [one] => Ok(Some(one.to_string())),
        _ => Err(CliError::Usage(format!("{file}: has tables of {}; choose one by --as", names.join(", ")))),
    }
}

/// The tables of a file as its header has them, or the hints.
fn read(options: &Options, bytes: &[u8], hints: &Hints) -> Result<Vec<foreign::ForeignTable>, CliError> {
    let tables = foreign::read_table(bytes, &options.file.display().to_string(), hints);
    tables.map_err(|error| match lacking(options, bytes) {
        lacking if lacking.is_empty() => error.into(),
        lacking => CliError::Usage(format!("{error}{lacking}")),
    })
}

/// What a file lacks, behind another message.
fn lacking(options: &Options, bytes: &[u8]) -> String {
    sidecar::lacking(options, bytes).map_or_else(String::new, |lacking| format!("; {lacking}"))
}

/// A table as the sidecar of its file has it, what it is called in messages, and why the sidecar is not
/// followed.
type Named = (foreign::ForeignTable, String, Option<String>);

/// The tables of a file.
fn tables(options: &Options, bytes: &[u8]) -> Result<Vec<Named>, CliError> {
    let (beside, refused) = match sidecar::beside(options, bytes.len()) {
        Ok(beside) => (beside, None),
        Err(refused) => (None, Some(refused)),
    };
    let hints = beside.iter().fold(hints(options), |hints, beside| beside.hints(hints));
    let tables = read(options, bytes, &hints)?;
    let with = |table: foreign::ForeignTable| {
        let what = named(options, &table.name);
        match beside.as_ref().map(|beside| (&beside.name, beside.named(&table))) {
            None => (table, what, refused.clone()),
            Some((_, Ok(said))) => (said, format!("{what} with its sidecar"), None),
            Some((name, Err(reason))) => (table, what, Some(sidecar::refused(options, name, &reason))),
        }
    };
    Ok(tables.into_iter().map(with).collect())
}

/// The table that is meant, and what the file is.
pub(super) fn table(options: &Options, wanted: Wanted, bytes: &[u8]) -> Result<Read, CliError> {
    let tables = tables(options, bytes)?;
    let (table, what, refused) = chosen(options, wanted, &tables)?.clone();
    grouped(options, &table);
    let audited = AuditedTable { what, ..AuditedTable::from(&table) };
    Ok(Read { audited, inverse: None, function: None, holds: table.what, note: table.note, refused })
}

/// Says how many channels a stated size makes of a list that states none.
fn grouped(options: &Options, table: &foreign::ForeignTable) {
    let listed = ["array", "raw"].iter().any(|kind| table.what.starts_with(kind));
    let count = table.channels.len();
    if listed && count > 1 && options.size.is_some() && options.channels.is_none() && !options.quiet {
        let (file, values) = (file_name(options), count * table.texels());
        say(&format!(
            "{file}: its {values} values are {} texels of {count} channels in the size that is given; --channels states another number",
            table.texels()
        ));
    }
}

/// The table that is meant, of a file that may hold several.
fn chosen<'a>(options: &Options, wanted: Wanted, tables: &'a [Named]) -> Result<&'a Named, CliError> {
    let inputs = audit::inputs_of(wanted.0) - usize::from(options.at.is_some());
    let axes = |(t, ..): &&Named| t.size.iter().filter(|n| **n > 1).count() == inputs;
    let fitting: Vec<&Named> = tables.iter().filter(axes).collect();
    match (fitting.as_slice(), tables) {
        ([one], _) => Ok(one),
        ([], [one, ..]) => Ok(one),
        (several, _) => {
            let names: Vec<&str> = several.iter().map(|(t, ..)| t.name.as_str()).collect();
            let names = names.join("`, `");
            Err(CliError::Usage(format!(
                "{}: holds several tables of {inputs} axes: `{names}`; choose one by --symbol or --layer",
                options.file.display()
            )))
        }
    }
}

fn hints(options: &Options) -> Hints {
    Hints {
        size: options.size.clone().map(|s| s.0),
        channels: options.channels,
        format: options.raw_format,
        symbol: options.symbol.clone(),
        layer: options.layer.clone(),
    }
}
