//! Error against evaluations and seconds of every way to compute a quantity, measured on one thread, and the
//! records of it.

use super::Versioned;
use super::record::RecordError;
use super::seconds;
use crate::bake::BakeError;
use crate::report::numbers::{brief, rounded};
use crate::report::{OfflineRecord, OfflineStudy, SCHEMA_VERSION};
use lobefit_truth::accuracy::{Study, tables};
use lobefit_truth::quantity::QUANTITIES;
use std::time::Instant;

/// The folder of a bake in which records are looked for.
pub const FOLDER: &str = "reports/offline";

/// Largest power of two of samples.
pub const MOST: u32 = 18;

/// Seconds of an execution that is not repeated.
const LONG: f64 = 0.1;

/// Digits of errors and seconds in a record.
const DIGITS: usize = 3;

/// Measures every quantity, with up to `2^most` samples.
///
/// # Errors
/// A truth that cannot be integrated.
pub fn offline(device: String, most: u32, say: impl Fn(&str) + Sync) -> Result<OfflineRecord, BakeError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|e| BakeError::Internal(format!("cannot start a thread: {e}")))?;
    let both = QUANTITIES.into_iter().flat_map(|quantity| [(quantity, false), (quantity, true)]);
    let studied = |(quantity, is_hard)| {
        let study = Study::new(quantity, is_hard)?;
        say(&format!("{} at {}", quantity.name(), at(&study)));
        measured(&study, most, is_hard)
    };
    Ok(OfflineRecord { device, studies: pool.install(|| both.map(studied).collect::<Result<_, _>>())? })
}

/// Seconds of one execution: of a long one by the first run.
fn clock(work: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    work();
    let once = start.elapsed().as_secs_f64();
    if once > LONG { once } else { seconds(work) }
}

fn measured(study: &Study, most: u32, is_hard: bool) -> Result<OfflineStudy, BakeError> {
    let round = |values: &mut Vec<f64>| values.iter_mut().for_each(|x| *x = rounded(*x, DIGITS));
    let mut curves = study.curves(most, &clock)?;
    curves.iter_mut().flat_map(|curve| [&mut curve.error, &mut curve.seconds]).for_each(round);
    let path_tracer = study.path_tracer(&clock);
    let wanted = path_tracer.is_some() && !is_hard;
    let mut tables = if wanted { tables(study, &clock)? } else { None };
    tables.iter_mut().flat_map(|t| [&mut t.error, &mut t.direct, &mut t.shared]).for_each(round);
    Ok(OfflineStudy {
        quantity: study.quantity.name().into(),
        output: study.output().into(),
        at: at(study),
        bound: rounded(study.truth[1], DIGITS),
        curves,
        path_tracer,
        walk: study.walk(&clock).transpose()?,
        tables,
    })
}

/// Inputs and choices, in words.
fn at(study: &Study) -> String {
    let inputs = study.quantity.inputs().iter().zip(&study.x);
    let inputs = inputs.map(|(input, x)| format!("{} {}", input.name, brief(*x, 3)));
    let words = study.quantity.choices().iter().filter_map(|choice| study.variant.word(*choice));
    inputs.chain(words.map(String::from)).collect::<Vec<_>>().join(", ")
}

/// A record from its bytes.
///
/// # Errors
/// Bytes that are no such record, one of another version.
pub fn read(bytes: &[u8]) -> Result<OfflineRecord, RecordError> {
    let foreign =
        |e: serde_json::Error| RecordError::Foreign { of: "cost --offline --record", reason: e.to_string() };
    let Versioned { schema_version } = serde_json::from_slice(bytes).map_err(foreign)?;
    if schema_version != SCHEMA_VERSION {
        return Err(foreign(serde::de::Error::custom(format!("schema_version {schema_version}"))));
    }
    serde_json::from_slice(bytes).map_err(foreign)
}
