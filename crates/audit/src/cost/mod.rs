//! What a function costs in compiled instructions, beside our formulas of the same use. The package
//! `lobefit-gpu` compiles all of them; this one knows its program, and nothing of GPUs.

mod ours;
mod served;

use std::ffi::OsStr;

use crate::audit::Audit;
use crate::foreign::ShaderFunction;
use crate::report::{AuditCompiled, AuditCost, AuditFamily};
use lobefit::bake::Progress;
use lobefit::cli::{CliError, external};
use lobefit::store::{self, Files, Folder};
use lobefit::timing::isa::{IsaRecord, IsaRow};
use ours::Formula;
use served::Served;

/// The name that the audited function is compiled under.
const AUDITED: &str = "audited_function";

/// What an audited function costs, and for each family of GPUs two formulas of ours: the cheapest
/// whose error is no larger, and the most accurate that takes no more instructions.
///
/// Errors are compared over the domain of our certificates; ours are what the certificates state,
/// that of the function is the largest at the places of the audit.
///
/// # Errors
/// A function that WGSL cannot say; what the bake of our formulas says; what the package says that
/// compiles, or that it is not built.
pub fn cost(
    function: &ShaderFunction,
    audit: &Audit,
    progress: &dyn Progress,
) -> Result<AuditCost, CliError> {
    progress.stage("machine code");
    // What cannot be compiled is said before ours are baked, which takes most of the time.
    let audited = Files::from([(file(AUDITED), function.wgsl(AUDITED)?.into_bytes())]);
    let record = compiled(&audited)?;
    let served = served::served(audit);
    let ours = match served {
        Some(served) => ours::formulas(served, audit.best().lobe.form.smith, progress)?,
        None => Vec::new(),
    };
    let axes = || audit.best().axes.iter().map(|axis| axis.scale.input().name());
    let mut domain = ours.first().map(|formula| formula.domain.clone()).unwrap_or_default();
    domain.retain(|input, _| axes().any(|name| name == input));
    let error = served.filter(|_| !ours.is_empty()).and_then(|of| of.used_as.worst(audit, &domain));
    let sources: Files = ours.iter().map(|of| (file(&of.name), of.code.clone().into_bytes())).collect();
    let rows_of_ours = if ours.is_empty() { Vec::new() } else { compiled(&sources)?.rows };
    let families = record.families().into_iter().filter_map(|family| {
        let audited = record.rows.iter().find(|row| row.family == family)?;
        let beside = |formula: &Formula| {
            let own = |row: &&IsaRow| row.family == family && row.function == formula.name;
            let row = rows_of_ours.iter().find(own)?;
            Some(of_row(&formula.name, Some(formula.error), row))
        };
        let ours = error.map_or(Vec::new(), |_| ours.iter().filter_map(beside).collect());
        let audited = of_row(&function.name, error.filter(|error| error.is_finite()), audited);
        Some(nearest(family, audited, &ours, error))
    });
    let families = families.collect();
    Ok(AuditCost {
        compiler: record.compiler(),
        used_as: served.map(|served| served.used_as.word().into()),
        error_of: served.map(|served: &Served| served.error.into()),
        lobe: Some(audit.best().lobe.words()).filter(|words| !words.is_empty()),
        domain,
        families,
    })
}

fn file(name: &str) -> String {
    format!("{name}.wgsl")
}

fn of_row(function: &str, error: Option<f64>, row: &IsaRow) -> AuditCompiled {
    AuditCompiled { function: function.into(), error, counts: row.counts }
}

/// A function of an error, and the two of ours that are to be held beside it.
fn nearest(family: &str, audited: AuditCompiled, ours: &[AuditCompiled], error: Option<f64>) -> AuditFamily {
    let (issued, off) =
        (|of: &AuditCompiled| of.counts.issued(), |of: &AuditCompiled| of.error.unwrap_or(f64::INFINITY));
    let within = ours.iter().filter(|of| error.is_some_and(|error| off(of) <= error));
    let cheapest = within.min_by(|a, b| issued(a).cmp(&issued(b)).then(off(a).total_cmp(&off(b))));
    let affordable = ours.iter().filter(|of| issued(of) <= issued(&audited));
    let most_accurate = affordable.min_by(|a, b| off(a).total_cmp(&off(b)).then(issued(a).cmp(&issued(b))));
    AuditFamily {
        family: family.into(),
        cheapest: cheapest.cloned(),
        most_accurate: most_accurate.cloned(),
        audited,
    }
}

/// What the package that compiles makes of files, each of a function of the file's name.
fn compiled(sources: &Files) -> Result<IsaRecord, CliError> {
    let place = store::temporary()?;
    Folder::open_flat(place.path())?.write(sources)?;
    let paths: Vec<_> = sources.keys().map(|name| place.path().join(name)).collect();
    let mut words = ["--isa", "--json", "--precisions", "f32"].map(OsStr::new).to_vec();
    words.extend(paths.iter().flat_map(|path| [OsStr::new("--code"), path.as_os_str()]));
    let printed = external::ask("lobefit-gpu", &words)?;
    let shown = |source| CliError::Record { file: "what lobefit-gpu prints".into(), source };
    IsaRecord::read(&printed).map_err(shown)
}
