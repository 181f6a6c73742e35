//! `lobefit cost --gpu`: times of the emitted WGSL on a graphics processor, and their records.

use std::path::{Path, PathBuf};

use super::super::CliError;
#[cfg(feature = "gpu")]
use super::super::input;
use super::super::output::{Outcome, print};
#[cfg(feature = "gpu")]
use super::NOTHING;
use super::Options;
use crate::report::GpuRecord;
use crate::store::{self, Files, Folder};
use crate::timing::record;

/// Largest record that is read, bytes.
pub(in crate::cli) const RECORD_BYTES: u64 = 16 << 20;

/// A record and its page: the folder they lie in, and their names there.
struct Place {
    folder: PathBuf,
    names: [String; 2],
}

impl Place {
    fn of(option: &str, record: &Path) -> Result<Place, CliError> {
        let shown = record.display().to_string();
        let stem = record.file_stem().and_then(|stem| stem.to_str());
        match stem {
            Some(stem) if record.extension().is_some_and(|e| e == "json") => Ok(Place {
                folder: record.parent().map(Path::to_path_buf).unwrap_or_default(),
                names: [format!("{stem}.json"), format!("{stem}.html")],
            }),
            _ => Err(CliError::Usage(format!(
                "{option} {}: a name that ends with .json is called for; the page lies beside it",
                crate::scene::escape::visible(&shown)
            ))),
        }
    }

    /// A record and its page as files.
    fn files(&self, record: &GpuRecord) -> Result<Files, CliError> {
        let shown = self.folder.join(&self.names[0]).display().to_string();
        let (page, figures) =
            record::page(record).map_err(|source| CliError::Record { file: shown, source })?;
        let [json, html] = self.names.clone();
        Ok(Files::from([(json, figures), (html, page.into_bytes())]))
    }

    fn write(&self, folder: &mut Folder, record: &GpuRecord, quiet: bool) -> Result<(), CliError> {
        let written = folder.write(&self.files(record)?)?;
        if !quiet {
            let (new, same) = (written.written.len(), written.unchanged.len());
            let names = self.names.join(", ");
            print(format!("{names}: {new} files written, {same} unchanged\n").as_bytes())?;
        }
        Ok(())
    }
}

/// Writes the page of a record again, and the record as this version writes it.
pub(super) fn page(options: &Options, path: &Path) -> Result<Outcome, CliError> {
    let place = Place::of("--page", path)?;
    let bytes = store::read(path, RECORD_BYTES)?;
    let record = record::read(&bytes)
        .map_err(|source| CliError::Record { file: path.display().to_string(), source })?;
    let mut folder = Folder::open_flat(&place.folder)?;
    place.write(&mut folder, &record, options.quiet)?;
    Ok(Outcome::Done)
}

/// A build without the feature.
#[cfg(not(feature = "gpu"))]
pub(super) fn run(_: &Options) -> Result<Outcome, CliError> {
    Err(CliError::Usage(
        "--gpu: this build drives no graphics processor; build one that does: cargo build --release --features gpu"
            .into(),
    ))
}

/// Measures, prints, and writes what is to be recorded.
#[cfg(feature = "gpu")]
pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    use super::super::output::print_json;
    use super::super::progress::Spinner;
    use crate::bake::Selection;
    use crate::plan;
    use crate::timing::gpu::{Work, measure};
    use serde_json::json;

    let input = input::load(&options.scene)?;
    let place = options.record.as_deref().map(|path| Place::of("--record", path)).transpose()?;
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = place.as_ref().map(|place| Folder::open_flat(&place.folder)).transpose()?;
    let progress = Spinner::new(options.quiet || options.json);
    let plan = plan::plan(&input.scene);
    let baked = options.threads.install(|| input.bake(&plan, Selection::default(), &progress))?;
    let work = if options.reduced { Work::REDUCED } else { Work::FULL };
    let origin = super::origin(&input, "lobefit cost --gpu --record FILE.json")?;
    let record = measure(&baked, options.adapter.as_deref(), work, origin.clone(), &progress);
    let record = record.map_err(Box::new)?;
    drop(progress);
    let Some(record) = record else {
        match (options.json, options.quiet) {
            (true, _) => print_json(&json!({"schema_version": 1, "origin": origin, "rows": []}))?,
            (false, quiet) if !quiet => print(NOTHING)?,
            _ => {}
        }
        return Ok(Outcome::Done);
    };
    if options.json {
        let place = Place { folder: PathBuf::new(), names: ["json".into(), "html".into()] };
        print(place.files(&record)?.get("json").map_or(&[], Vec::as_slice))?;
    } else if !options.quiet {
        print(table(&record).as_bytes())?;
    }
    if let (Some(place), Some(folder)) = (&place, &mut folder) {
        place.write(folder, &record, options.quiet || options.json)?;
    }
    Ok(Outcome::Done)
}

/// The rows in words.
#[cfg(feature = "gpu")]
fn table(record: &GpuRecord) -> String {
    use crate::report::{GpuClock, GpuKind, GpuRow};
    use std::fmt::Write;

    let device = &record.device;
    let clock = match record.clock {
        GpuClock::Timestamps => "time stamps of the device",
        GpuClock::Wall => "wall time, since the driver offers no time stamps",
    };
    let mut text =
        format!("{} ({}), {}, {}; {clock}\n", device.adapter, device.kind, device.driver, device.backend);
    let line = |row: &GpuRow| {
        let fetched = if row.kind == GpuKind::LookupFetches { " with fetches" } else { "" };
        let time = match row.evaluations_per_second {
            Some(rate) => format!("{:>12.6} ns {:>10.3} G/s", row.nanoseconds.median, 1e-9 * rate),
            None => format!("{:>12} ns {:>10} G/s", "below noise", "-"),
        };
        let spread = [row.ratio.median, row.ratio.low, row.ratio.high].map(|x| format!("{x:.3}"));
        format!("{time}  x{} of the loop [{}, {}]  {}{fetched}\n", spread[0], spread[1], spread[2], row.name)
    };
    text.extend(record.rows.iter().map(line));
    for out in &record.left_out {
        let _ = writeln!(text, "not measured: {}: {}", out.function, out.reason);
    }
    text
}
