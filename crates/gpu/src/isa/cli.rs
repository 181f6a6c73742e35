//! `lobefit cost --isa`: what compilers make of the emitted functions.

use std::fmt::Write;
use std::path::Path;

use serde_json::json;

use super::family::{Driver, chosen, pairs};
use super::{Compiled, Jobs, Order, compile};
use crate::GpuError;
use lobefit::bake::Selection;
use lobefit::cli::CliError;
use lobefit::cli::cost::{self, NOTHING, Options, RECORD_BYTES};
use lobefit::cli::input;
use lobefit::cli::output::{Outcome, print, print_json};
use lobefit::cli::progress::Spinner;
use lobefit::emit::include::Include;
use lobefit::plan;
use lobefit::report::{GpuKind, GpuRecord};
use lobefit::store::{self, Files, Folder};
use lobefit::timing::isa::{IsaRecord, IsaRow, Precision};
use lobefit_math::correlation::Correlation;

/// Compiles, prints, compares, and writes what is to be recorded.
pub(crate) fn verb(options: &Options) -> Result<Outcome, CliError> {
    let old = options.against.as_deref().map(read).transpose()?;
    let mut place = options.record.as_deref().map(Place::open).transpose()?;
    let progress = Spinner::new(options.quiet || options.json);
    let order = order(options, old.as_ref())?;
    let compiled = match jobs(options, &order, &progress)? {
        Some((jobs, scene)) => compile(&jobs, &scene, &order, &progress)?,
        None => Vec::new(),
    };
    drop(progress);
    let Some(Compiled { record, .. }) = compiled.first() else {
        match (options.json, options.quiet) {
            (true, _) => print_json(&json!({"schema_version": 1, "rows": []}))?,
            (false, quiet) if !quiet => print(NOTHING)?,
            _ => {}
        }
        return Ok(Outcome::Done);
    };
    if let Some(function) = &options.assembly {
        return listing(function, &compiled);
    }
    if let Some(old) = old {
        return compared(options, &old, record);
    }
    if let Some(place) = &mut place {
        place.write(record)?;
    }
    if options.json {
        print(&record.bytes()?)?;
    } else if !options.quiet {
        let measured = options.from.as_deref().map(cost::times_in).transpose()?.unwrap_or_default();
        for Compiled { record, .. } in &compiled {
            print(table(record).as_bytes())?;
            print(correlations(record, &measured).as_bytes())?;
        }
    }
    Ok(Outcome::Done)
}

/// What to compile: as the options say, or as a record to compare with.
fn order<'a>(options: &'a Options, old: Option<&IsaRecord>) -> Result<Order<'a>, GpuError> {
    let (mut precisions, folder) = (Precision::ALL.to_vec(), options.drivers.as_deref());
    if let Some(old) = old {
        let families = old.families().into_iter().map(String::from).collect();
        precisions.retain(|precision| old.rows.iter().any(|row| row.precision == *precision));
        return Ok(Order { drivers: vec![(Driver::of_record(&old.driver)?, families)], folder, precisions });
    }
    if !options.precisions.is_empty() {
        precisions.retain(|precision| options.precisions.iter().any(|word| word == precision.word()));
    }
    let drivers = chosen(&options.families);
    let one = [("--record", options.record.is_some()), ("--json", options.json)];
    if let Some((option, _)) = one.into_iter().find(|(_, given)| *given && drivers.len() > 1) {
        let found = drivers.iter().map(|(driver, _)| driver.name).collect::<Vec<_>>().join(", ");
        return Err(GpuError::Driver(format!(
            "--isa: {option} takes families of one driver: a record is of one; found {found}"
        )));
    }
    Ok(Order { drivers, folder, precisions })
}

/// What is compiled, and the name of its scene; none where the bake emits no functions.
fn jobs(
    options: &Options,
    order: &Order<'_>,
    progress: &Spinner,
) -> Result<Option<(Jobs, String)>, CliError> {
    if !options.code.is_empty() {
        return Ok(Some((Jobs::of_files(&options.code, &order.precisions)?, String::new())));
    }
    let (files, scene) = baked(options, progress)?;
    let Some(include) = Include::of(&files) else { return Ok(None) };
    Ok(Some((Jobs::of(&include, &files, &order.precisions)?, scene)))
}

/// Code and manifest of the bake, and the name of its scene: baked now, or those of a folder.
fn baked(options: &Options, progress: &Spinner) -> Result<(Files, String), CliError> {
    let Some(folder) = &options.from else {
        let input = input::load(&options.scene)?;
        let plan = plan::plan(&input.scene);
        let baked = options.threads.install(|| input.bake(&plan, Selection::default(), progress))?;
        return Ok((baked.files, input.scene.name));
    };
    cost::bake_in(folder)
}

fn read(path: &Path) -> Result<IsaRecord, CliError> {
    let bytes = store::read(path, RECORD_BYTES)?;
    IsaRecord::read(&bytes).map_err(|source| CliError::Record { file: path.display().to_string(), source })
}

/// Where a record is written: the file as it was named, and its folder.
struct Place {
    shown: String,
    name: String,
    folder: Folder,
}

impl Place {
    /// Before the work: an output that cannot be written is known now, not after it.
    fn open(path: &Path) -> Result<Place, CliError> {
        let shown = path.display().to_string();
        let name = path.file_name().and_then(|name| name.to_str()).filter(|name| name.ends_with(".json"));
        let Some(name) = name else {
            return Err(CliError::Usage(format!(
                "--record {shown}: a name that ends with .json is called for"
            )));
        };
        let folder = Folder::open_flat(path.parent().unwrap_or(Path::new("")))?;
        Ok(Place { name: name.into(), shown, folder })
    }

    /// Counts of another compiler are other counts: the name must say whose they are.
    fn write(&mut self, record: &IsaRecord) -> Result<(), CliError> {
        let compiler = record.compiler();
        if !self.name.starts_with(&compiler) {
            return Err(CliError::Usage(format!(
                "--record {}: compiled by {compiler}; take a name that begins so",
                self.shown
            )));
        }
        self.folder.write(&Files::from([(self.name.clone(), record.bytes()?)]))?;
        Ok(())
    }
}

/// The machine code of a function.
fn listing(function: &str, compiled: &[Compiled]) -> Result<Outcome, CliError> {
    let all = compiled.iter().flat_map(|compiled| &compiled.assembly);
    let of: Vec<_> = all.filter(|(name, ..)| name == function).collect();
    if of.is_empty() {
        let message = format!("--assembly {function}: no function of this name is emitted");
        return Err(CliError::Usage(message));
    }
    for (_, family, precision, code) in of {
        print(format!("; {function}, {family}, {}\n{code}\n", precision.word()).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// What grew since a record: exit code 1 where anything did.
fn compared(options: &Options, old: &IsaRecord, new: &IsaRecord) -> Result<Outcome, CliError> {
    let found = old.compare(new);
    if options.json {
        print_json(&found)?;
    } else if !options.quiet {
        let mut text: String = found.grown.iter().map(|grown| format!("{grown}\n")).collect();
        let _ = match found.recorded == found.compiled {
            true => writeln!(text, "{} rows compared, {} counts grew", found.rows, found.grown.len()),
            false => writeln!(
                text,
                "note: recorded by {}, compiled by {}: not compared",
                found.recorded, found.compiled
            ),
        };
        print(text.as_bytes())?;
    }
    Ok(if found.grown.is_empty() { Outcome::Done } else { Outcome::Failed })
}

/// Heads of the columns, each with the count that stands in it where that has another name ([`pairs`]).
const COLUMNS: &str = "vector transc.=transcendental scalar memory moves slots \
    vgprs sgprs waves spills bytes latency cycles=inverse_throughput";

/// The rows in words, family by family; columns are those that the driver states.
fn table(record: &IsaRecord) -> String {
    let mut text = String::new();
    for family in record.families() {
        let rows = || record.rows.iter().filter(|row| row.family == family);
        let stated = |row: &IsaRow, of: &str| {
            row.counts.stated().into_iter().find(|(name, _)| *name == of).map(|(_, count)| count)
        };
        let columns = pairs(COLUMNS).filter(|(_, name)| rows().any(|row| stated(row, name).is_some()));
        let columns: Vec<_> = columns.collect();
        let heads: String = columns.iter().map(|(head, _)| format!("{head:>8}")).collect();
        let _ = writeln!(
            text,
            "{family} by {} {}: above the same shader without the function; registers and waves of the whole\n\
             {:>5}{heads}  precision   function",
            record.driver, record.version, "ops"
        );
        for row in rows() {
            let ops = record.ops(&row.function).map_or_else(|| "-".into(), |ops| ops.to_string());
            let cell = |(_, name): &(&str, &str)| {
                format!("{:>8}", stated(row, name).map_or_else(|| "-".into(), |count| count.to_string()))
            };
            let cells: String = columns.iter().map(cell).collect();
            let _ = writeln!(text, "{ops:>5}{cells}  {:<10}  {}", row.precision.word(), row.function);
        }
    }
    for out in &record.left_out {
        let _ = writeln!(text, "not compiled: {} in {}: {}", out.function, out.precision.word(), out.reason);
    }
    text
}

/// Whether operations by the model, vector instructions and recorded times put functions in the
/// same order.
fn correlations(record: &IsaRecord, measured: &[GpuRecord]) -> String {
    let mut text = String::new();
    let mut say = |what: String, pairs: Vec<(f64, f64)>| {
        let _ = match Correlation::of(&pairs) {
            Some(c) => {
                writeln!(
                    text,
                    "{what}: Pearson {:.3}, Spearman {:.3}, {} functions",
                    c.values, c.ranks, c.count
                )
            }
            None => writeln!(text, "{what}: too few functions for a correlation"),
        };
    };
    for family in record.families() {
        let rows = record.rows.iter().filter(|row| row.family == family && row.precision == Precision::F32);
        let rows: Vec<&IsaRow> = rows.collect();
        let issued = |row: &IsaRow| row.counts.issued() as f64;
        let ops = |row: &IsaRow| record.ops(&row.function).map(f64::from);
        let modelled = rows.iter().filter_map(|row| Some((ops(row)?, issued(row)))).collect();
        say(format!("{family}: operations and vector + 4 transcendental instructions"), modelled);
        for times in measured {
            let time = |row: &IsaRow| {
                let timed = times.rows.iter().filter(|t| t.kind != GpuKind::LookupFetches);
                let mut of =
                    timed.filter(|t| t.code.as_ref().is_some_and(|hash| record.is_of(&row.function, hash)));
                of.find(|t| t.function.as_ref() == Some(&row.function)).map(|t| t.nanoseconds.median)
            };
            let name = &times.device.adapter;
            let pairs = |cost: &dyn Fn(&IsaRow) -> Option<f64>| {
                rows.iter().filter_map(|row| Some((cost(row)?, time(row)?))).collect()
            };
            say(
                format!("{family}: vector + 4 transcendental instructions and time on {name}"),
                pairs(&|row| Some(issued(row))),
            );
            if record.families().first() == Some(&family) {
                say(format!("operations and time on {name}"), pairs(&ops));
            }
        }
    }
    text
}
