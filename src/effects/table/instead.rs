//! What keeps a limit that a table does not: larger sizes, other layouts and wider texels,
//! measured.

use std::sync::Arc;

use super::bake::finish;
use super::job::{AUTO_SIDE, size_text};
use super::{Family, Judge, TableJob};
use crate::data::TexelFormat;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::scene::limits::{AXIS_MAX, SLICED_AXIS_MAX, SLICED_LINES};

/// Most texels of a table that is measured to say what keeps a limit: of two axes, and of three.
/// Larger tables take more seconds than an error message is worth.
const TEXELS: [usize; 2] = [1 << 16, 1 << 20];

/// What else was measured, and its error.
struct Choice {
    words: String,
    bytes: u64,
    error: f64,
}

/// Lines that say what keeps the limit of a job whose tables of this size do not, each with its
/// bytes and its error. Measured are sizes doubled until one keeps it, the other layouts of its kind
/// at the job's size, and in place of f16 the smallest size with f32 texels that keeps it where f16
/// does not. `judge` has the truth of the job.
///
/// # Errors
/// A truth that cannot be integrated.
pub(super) fn instead(
    family: &dyn Family,
    (job, size): (&TableJob, &[usize]),
    judge: &Arc<Judge>,
    limit: f64,
    context: &Context,
) -> Result<Vec<String>, BakeError> {
    let of = |job: TableJob, size: &[usize], but: String| measured(family, (&job, size), but, judge, context);
    let (own, mut size, mut kept) = (size, size.to_vec(), false);
    let mut choices = Vec::new();
    while !kept && is_measured(&doubled(&size)) {
        size = doubled(&size);
        let choice = of(job.clone(), &size, String::new())?;
        kept = choice.error <= limit;
        choices.push(choice);
    }
    for &layout in family.layouts().iter().filter(|layout| **layout != job.layout) {
        let but = format!(", layout `{}`", layout.name());
        choices.push(of(TableJob { layout, ..job.clone() }, own, but)?);
    }
    let mut wider = match job.format {
        TexelFormat::F16 if kept => vec![own],
        TexelFormat::F16 => vec![own, &size],
        TexelFormat::F32 => Vec::new(),
    };
    wider.dedup();
    for size in wider {
        let format = TexelFormat::F32;
        let choice = of(TableJob { format, ..job.clone() }, size, format!(", format `{}`", format.name()))?;
        let keeps = choice.error <= limit;
        choices.push(choice);
        if keeps {
            break;
        }
    }
    let chosen = job.size.is_some() && size.len() == 2 && kept && size.iter().all(|n| *n <= AUTO_SIDE);
    Ok(said(&choices, limit, chosen))
}

/// A line for each choice that keeps the limit; where none does, what was measured, and what else a
/// scene can change.
fn said(choices: &[Choice], limit: f64, is_chosen: bool) -> Vec<String> {
    let line = |choice: &Choice| {
        let Choice { words, bytes, error } = choice;
        format!("keeps it: {words}: {bytes} bytes, error {error}")
    };
    let mut lines: Vec<String> = choices.iter().filter(|choice| choice.error <= limit).map(line).collect();
    if is_chosen {
        lines.push("keeps it: no `size`: lobefit chooses the smallest square that does".into());
    }
    if lines.is_empty() {
        let each = |choice: &Choice| format!("{} ({})", choice.words, choice.error);
        let all = choices.iter().map(each).collect::<Vec<_>>().join("; ");
        lines.push(match choices {
            [] => "a larger size is not measured".into(),
            _ => format!("measured, and not within it: {all}"),
        });
        lines.push("raise max_error, or narrow `n_dot_v` of the table or the roughness".into());
    }
    lines
}

fn doubled(size: &[usize]) -> Vec<usize> {
    size.iter().map(|n| 2 * n).collect()
}

/// Whether a size is one that a scene may ask for, and small enough.
fn is_measured(size: &[usize]) -> bool {
    let texels = size.iter().product::<usize>();
    match size {
        [columns, _, slices] => {
            let axes = size.iter().all(|n| *n <= SLICED_AXIS_MAX);
            axes && columns * slices <= SLICED_LINES && texels <= TEXELS[1]
        }
        _ => size.iter().all(|n| *n <= AXIS_MAX) && texels <= TEXELS[0],
    }
}

/// The largest lookup error of the tables of a job in a size, and the bytes of one of them; `but` says
/// what else is not the job's own.
fn measured(
    family: &dyn Family,
    (job, size): (&TableJob, &[usize]),
    but: String,
    judge: &Arc<Judge>,
    context: &Context,
) -> Result<Choice, BakeError> {
    let spec = job.spec(size.to_vec(), &size_text(size));
    let (tables, made) = family.build(&spec, &context.counter)?;
    let (mut error, mut bytes) = (0.0_f64, 0);
    for (i, table) in tables.iter().enumerate() {
        bytes = table.bytes();
        error = error.max(finish(&spec, table, made, (judge, i))?.errors.lookup.max);
    }
    Ok(Choice { words: format!("{}{but}", size_text(size)), bytes, error })
}
