//! `lobefit cost --weights`: what kinds of work cost on the GPUs of each vendor.

use std::fmt::Write;
use std::path::Path;

use super::{Fitted, Times, fitted, weights};
use lobefit::cli::CliError;
use lobefit::cli::cost::{Options, bake_in, counts_in, times_in};
use lobefit::cli::output::{Outcome, print};
use lobefit::data::Agreement;
use lobefit::emit::include::Include;
use lobefit::store::{Files, Folder};

/// Fits, prints, and writes what is to be recorded.
pub(crate) fn verb(options: &Options, from: &Path) -> Result<Outcome, CliError> {
    let (files, scene) = bake_in(from)?;
    let records = counts_in(&options.records)?;
    let times = times_in(&options.records)?;
    let include = Include::of(&files).unwrap_or_else(|| Include::new(String::new()));
    let fitted = fitted(&include, &scene, &records, &times)
        .map_err(|e| CliError::Usage(format!("--from {}: {e}", from.display())))?;
    if fitted.is_empty() {
        return Err(CliError::Usage(format!(
            "--records {}: no record in reports/isa is of the scene {scene} and of the code in {}; make some with lobefit cost --isa --record",
            options.records.display(),
            from.display()
        )));
    }
    let bytes = weights(&fitted).bytes()?;
    if let Some(path) = &options.record {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let mut folder = Folder::open_flat(path.parent().unwrap_or(Path::new("")))?;
        folder.write(&Files::from([(name, bytes.clone())]))?;
    }
    if options.json {
        print(&bytes)?;
    } else if !options.quiet {
        print(table(&fitted).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// The models in words.
fn table(fitted: &[Fitted]) -> String {
    let mut text = String::new();
    for Fitted { vendor, model, times } in fitted {
        let paid = model.prices.iter().filter(|(_, price)| **price > 0.0);
        let prices: Vec<String> =
            paid.map(|(name, price)| format!("{} {price}", name.replace('_', "-"))).collect();
        let _ = writeln!(text, "{} ({}, {}), {}", vendor.word(), model.family, model.compiler, model.unit);
        let _ =
            writeln!(text, "  prices: {}; three channels beside one: {}", prices.join(", "), model.coloured);
        for (what, found) in [
            ("model and compiled code", model.agreement),
            ("the same of formulas that took no part", model.left_out),
            ("operations and compiled code", model.operations),
        ] {
            let Agreement { pearson, spearman, formulas } = found;
            let _ =
                writeln!(text, "  {what}: Pearson {pearson:.3}, Spearman {spearman:.3}, {formulas} formulas");
        }
        for Times { device, operations, model, compiled, picoseconds } in times {
            for (what, found) in [("operations", operations), ("model", model), ("compiled code", compiled)] {
                let found = match found {
                    Some(c) => {
                        format!("Pearson {:.3}, Spearman {:.3}, {} formulas", c.values, c.ranks, c.count)
                    }
                    None => "too few formulas for a correlation".into(),
                };
                let _ = writeln!(text, "  {what} and time on {device}: {found}");
            }
            if compiled.is_some() {
                let [vector, moves, transcendental] = picoseconds.map(|time| format!("{time:.4}"));
                let _ = writeln!(
                    text,
                    "  picoseconds on {device}: {vector} a vector instruction, {moves} a move of a literal, {transcendental} a transcendental one"
                );
            }
        }
    }
    text
}
