//! What keeps a limit that a table does not: larger sizes, other layouts and wider texels,
//! measured.

use std::sync::Arc;

use super::bake::finish;
use super::job::{AUTO_SIDE, size_text};
use super::{Family, Judge, TableJob};
use crate::data::{Layout, TexelFormat};
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::scene::limits::{AXIS_MAX, SLICED_AXIS_MAX, SLICED_LINES};

/// Most texels of a table that is measured to say what keeps a limit: of two axes, and of three.
/// Larger tables take more seconds than an error message is worth.
const TEXELS: [usize; 2] = [1 << 16, 1 << 20];

/// Ends what keeps the limit.
const KEEPS: &str = " keeps it";

/// In words, what keeps the limit of a job whose tables of this size do not: sizes doubled until
/// one keeps it, the other layouts of its kind at the job's size, and in place of f16 the smallest
/// of these sizes with f32 texels that keeps it. `judge` has the truth of the job.
///
/// # Errors
/// A truth that cannot be integrated.
pub(super) fn instead(
    family: &dyn Family,
    (job, size): (&TableJob, &[usize]),
    judge: &Arc<Judge>,
    limit: f64,
    context: &Context,
) -> Result<String, BakeError> {
    let of = |job: TableJob, size: &[usize]| measured(family, (&job, size), judge, context);
    let error = |layout: Layout, size: &[usize]| of(TableJob { layout, ..job.clone() }, size);
    let words = |size: &[usize], error: f64| {
        format!("{}: {error}{}", size_text(size), if error <= limit { KEEPS } else { "" })
    };
    let mut parts = Vec::new();
    let (mut size, mut kept) = (size.to_vec(), false);
    let own = size.clone();
    while !kept && is_measured(&doubled(&size)) {
        size = doubled(&size);
        let error = error(job.layout, &size)?;
        kept = error <= limit;
        parts.push(words(&size, error));
    }
    for &layout in family.layouts().iter().filter(|layout| **layout != job.layout) {
        parts.push(format!("layout `{}` at {}", layout.name(), words(&own, error(layout, &own)?)));
    }
    let mut any = parts.iter().any(|part| part.ends_with(KEEPS));
    let mut wider = if job.format == TexelFormat::F16 { vec![own, size.clone()] } else { Vec::new() };
    wider.dedup();
    for size in wider {
        let error = of(TableJob { format: TexelFormat::F32, ..job.clone() }, &size)?;
        if error <= limit {
            any = true;
            parts.push(format!("format `f32` at {}", words(&size, error)));
            break;
        }
    }
    let chosen = job.size.is_some() && size.len() == 2 && kept && size.iter().all(|n| *n <= AUTO_SIDE);
    parts.extend(chosen.then(|| "without `size` lobefit chooses one that keeps it".to_string()));
    if parts.is_empty() {
        return Ok("a larger size is not measured: raise max_error, or the lower end of roughness".into());
    }
    if !any {
        let wider = if job.format == TexelFormat::F16 { ", nor do `f32` texels at these sizes" } else { "" };
        parts.push(format!(
            "none of these keeps it{wider}: raise max_error, or narrow `n_dot_v` of the table or the roughness"
        ));
    }
    Ok(format!("measured instead: {}", parts.join("; ")))
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

/// The largest lookup error of the tables of a job in a size.
fn measured(
    family: &dyn Family,
    (job, size): (&TableJob, &[usize]),
    judge: &Arc<Judge>,
    context: &Context,
) -> Result<f64, BakeError> {
    let spec = job.spec(size.to_vec(), &size_text(size));
    let (tables, made) = family.build(&spec, &context.counter)?;
    let mut worst = 0.0_f64;
    for (i, table) in tables.iter().enumerate() {
        worst = worst.max(finish(&spec, table, made, (judge, i))?.errors.lookup.max);
    }
    Ok(worst)
}
