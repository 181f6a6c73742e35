//! `lobefit cost --gpu`, `--isa` and `--weights`: what the emitted WGSL costs on graphics processors.

use std::ffi::OsString;
use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use serde_json::json;

use crate::{Work, isa, measure, weights};
use lobefit::bake::Selection;
use lobefit::cli::CliError;
use lobefit::cli::cost::{self, NOTHING, RecordPlace};
use lobefit::cli::declared;
use lobefit::cli::input;
use lobefit::cli::output::{self, Outcome, print, print_json};
use lobefit::cli::progress::Spinner;
use lobefit::plan;
use lobefit::report::{GpuClock, GpuKind, GpuRecord, GpuRow};
use lobefit::timing::record;

/// Time the emitted WGSL on a graphics processor, count its machine instructions, or price kinds of work
#[derive(Parser)]
#[command(name = "lobefit cost", bin_name = "lobefit cost", version, after_help = cost::EXAMPLES)]
struct Options {
    #[command(flatten)]
    all: cost::Options,
}

/// Runs the verb on its arguments (the first is the program's name), `--gpu`, `--isa` or `--weights`
/// among them.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if let [_, word, driver, answer] = arguments.as_slice()
        && word == isa::WORKER
    {
        return isa::worker(&driver.to_string_lossy(), Path::new(answer));
    }
    match &declared::parsed::<Options>(arguments) {
        Ok(options) if options.all.isa => output::finish(isa::verb(&options.all)),
        Ok(options) if options.all.gpu => output::finish(verb(&options.all)),
        Ok(Options { all: all @ cost::Options { weights: true, from: Some(from), .. } }) => {
            output::finish(weights::verb(all, from))
        }
        Ok(_) => output::finish(Err(CliError::Usage(
            "--gpu, --isa or --weights is called for; `lobefit cost` does the rest".into(),
        ))),
        Err(usage) => output::usage(usage),
    }
}

/// Measures, prints, and writes what is to be recorded.
fn verb(options: &cost::Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let place = options.record.as_deref().map(|path| RecordPlace::of("--record", path)).transpose()?;
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = place.as_ref().map(RecordPlace::open).transpose()?;
    let progress = Spinner::new(options.quiet || options.json);
    let plan = plan::plan(&input.scene);
    let baked = options.threads.install(|| input.bake(&plan, Selection::default(), &progress))?;
    let work = if options.reduced { Work::REDUCED } else { Work::FULL };
    let origin = cost::origin(&input, &plan, "lobefit cost --gpu --record FILE.json")?;
    let record = measure(&baked, options.adapter.as_deref(), work, origin.clone(), &progress)?;
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
        let shown = |source| CliError::Record { file: "the record".into(), source };
        print(&record::page(&record).map_err(shown)?.1)?;
    } else if !options.quiet {
        print(table(&record).as_bytes())?;
    }
    if let (Some(place), Some(folder)) = (&place, &mut folder) {
        place.write(folder, &record, options.quiet || options.json)?;
    }
    Ok(Outcome::Done)
}

/// The rows in words.
fn table(record: &GpuRecord) -> String {
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
