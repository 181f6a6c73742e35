//! `lobefit cost --isa`: what compilers make of the emitted functions.

use std::fmt::Write;
use std::path::Path;

use serde_json::json;

use super::{Compiled, compile};
use lobefit::bake::Selection;
use lobefit::cli::CliError;
use lobefit::cli::cost::{NOTHING, Options, RECORD_BYTES};
use lobefit::cli::input;
use lobefit::cli::output::{Outcome, print, print_json};
use lobefit::cli::progress::Spinner;
use lobefit::emit::manifest::Manifest;
use lobefit::plan;
use lobefit::report::{GpuKind, GpuRecord};
use lobefit::store::{self, Files, Folder, MANIFEST};
use lobefit::timing::correlation::Correlation;
use lobefit::timing::isa::{IsaRecord, IsaRow, Precision};
use lobefit::timing::record;

/// Largest file of a bake that is read, bytes.
const FILE_BYTES: u64 = 64 << 20;

/// The emitted code, in the language that is compiled.
const CODE: &str = "fits/lobefit.wgsl";

/// Compiles, prints, compares, and writes what is to be recorded.
pub(crate) fn verb(options: &Options) -> Result<Outcome, CliError> {
    let old = options.against.as_deref().map(read).transpose()?;
    let mut place = options.record.as_deref().map(Place::open).transpose()?;
    let progress = Spinner::new(options.quiet || options.json);
    let (files, scene) = baked(options, &progress)?;
    let mut families = options.families.clone();
    let mut precisions = Precision::ALL.to_vec();
    if let Some(old) = &old {
        families = old.families().into_iter().map(String::from).collect();
        precisions.retain(|precision| old.rows.iter().any(|row| row.precision == *precision));
    } else if !options.precisions.is_empty() {
        precisions.retain(|precision| options.precisions.iter().any(|word| word == precision.word()));
    }
    let compiled = compile(&files, scene, (&families, &precisions), &progress)?;
    drop(progress);
    let Some(Compiled { record, assembly }) = compiled else {
        match (options.json, options.quiet) {
            (true, _) => print_json(&json!({"schema_version": 1, "rows": []}))?,
            (false, quiet) if !quiet => print(NOTHING)?,
            _ => {}
        }
        return Ok(Outcome::Done);
    };
    if let Some(function) = &options.assembly {
        return listing(function, &assembly);
    }
    if let Some(old) = old {
        return compared(options, &old, &record);
    }
    if let Some(place) = &mut place {
        place.write(&record)?;
    }
    if options.json {
        print(&record.bytes()?)?;
    } else if !options.quiet {
        print(table(&record).as_bytes())?;
        print(correlations(&record, &measured(options)?).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// Code and manifest of the bake, and the name of its scene: baked now, or those of a folder.
fn baked(options: &Options, progress: &Spinner) -> Result<(Files, String), CliError> {
    let Some(folder) = &options.from else {
        let input = input::load(&options.scene)?;
        let plan = plan::plan(&input.scene);
        let baked = options.threads.install(|| input.bake(&plan, Selection::default(), progress))?;
        return Ok((baked.files, input.scene.name));
    };
    let files = store::read_set(folder, [CODE, MANIFEST], FILE_BYTES)?;
    let bytes = files.get(MANIFEST).ok_or_else(|| {
        CliError::Usage(format!("--from {}: holds no {MANIFEST}; bake into it first", folder.display()))
    })?;
    let manifest: Manifest = serde_json::from_slice(bytes)
        .map_err(|e| CliError::Usage(format!("--from {}: {MANIFEST}: {e}", folder.display())))?;
    let scene = manifest.made_from["name"].as_str().unwrap_or_default().to_owned();
    Ok((files, scene))
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
fn listing(function: &str, assembly: &[(String, String, Precision, String)]) -> Result<Outcome, CliError> {
    let of: Vec<_> = assembly.iter().filter(|(name, ..)| name == function).collect();
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

/// The rows in words, family by family.
fn table(record: &IsaRecord) -> String {
    let mut text = String::new();
    for family in record.families() {
        let _ = writeln!(
            text,
            "{family} by {} {}: above the same shader without the function; registers and waves of the whole\n\
             {:>5}{:>7}{:>8}{:>7}{:>7}{:>6}{:>6}{:>6}{:>7}{:>6}{:>8}{:>7}  precision   function",
            record.driver,
            record.version,
            "ops",
            "vector",
            "transc.",
            "scalar",
            "memory",
            "moves",
            "vgprs",
            "waves",
            "spills",
            "bytes",
            "latency",
            "cycles"
        );
        for row in record.rows.iter().filter(|row| row.family == family) {
            let c = &row.counts;
            let ops = row.ops.map_or_else(|| "-".into(), |ops| ops.to_string());
            let _ = writeln!(
                text,
                "{ops:>5}{:>7}{:>8}{:>7}{:>7}{:>6}{:>6}{:>6}{:>7}{:>6}{:>8}{:>7}  {:<10}  {}",
                c.vector,
                c.transcendental,
                c.scalar,
                c.memory,
                c.moves,
                c.vgprs,
                c.waves,
                c.spills,
                c.bytes,
                c.latency,
                c.inverse_throughput,
                row.precision.word(),
                row.function
            );
        }
    }
    for out in &record.left_out {
        let _ = writeln!(text, "not compiled: {} in {}: {}", out.function, out.precision.word(), out.reason);
    }
    text
}

/// Times that are recorded beside the bake.
fn measured(options: &Options) -> Result<Vec<GpuRecord>, CliError> {
    let Some(folder) = &options.from else { return Ok(Vec::new()) };
    let mut records = Vec::new();
    for entry in store::list(folder, record::FOLDER)?.iter().filter(|entry| entry.name.ends_with(".json")) {
        let path = folder.join(&entry.name);
        let read = record::read(&store::read(&path, RECORD_BYTES)?);
        records.push(read.map_err(|source| CliError::Record { file: path.display().to_string(), source })?);
    }
    Ok(records)
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
        let modelled = rows.iter().filter_map(|row| Some((f64::from(row.ops?), issued(row)))).collect();
        say(format!("{family}: operations and vector + 4 transcendental instructions"), modelled);
        for times in measured {
            let time = |row: &IsaRow| {
                let timed = times.rows.iter().filter(|t| t.kind != GpuKind::LookupFetches);
                let mut of = timed.filter(|t| t.code.as_ref() == Some(&row.source));
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
                say(format!("operations and time on {name}"), pairs(&|row| row.ops.map(f64::from)));
            }
        }
    }
    text
}
