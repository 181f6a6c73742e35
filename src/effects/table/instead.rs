//! What keeps a limit that a table does not: larger sizes, other layouts and wider texels,
//! measured.

use std::iter::successors;

use super::bake::{built, finish};
use super::job::{AUTO_SIDE, size_text};
use super::{Family, Judge, Region, Spec, TableJob};
use crate::data::{Layout, TexelFormat};
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::demand::{ROUGHNESS_WIDTH_MIN, Span};
use crate::emit::header::short;
use crate::scene::TableWant;
use crate::scene::limits::{AXIS_MAX, SLICED_AXIS_MAX, SLICED_LINES};

/// Most texels of a table that is measured to say what keeps a limit: of two axes, and of three.
/// Larger tables take more seconds than an error message is worth.
const TEXELS: [usize; 2] = [1 << 16, 1 << 20];

/// How many times smaller the error of a linear lookup gets at most as its cells halve: it goes with
/// their square. One power of it more than there are sizes left is the doubt that a search allows.
const FALL: f64 = 4.0;

/// Least n_dot_v and roughness from which on a table is measured that keeps its limit in no size.
const LOWS: [f64; 5] = [0.02, 0.05, 0.1, 0.2, 0.4];

/// What else was measured, and its error.
struct Choice {
    words: String,
    layout: Layout,
    bytes: u64,
    error: f64,
}

/// Lines that say what keeps the limit of a job whose tables of this size do not, each with its
/// bytes and its error. Measured are sizes doubled until one keeps it, of a table with slices first
/// those of the same slices: in the job's own layout, and up to the size that keeps it there in the
/// other layouts of its kind, and with f32 texels in place of f16. Where the own layout keeps it in no
/// size, the ranges over which a table of the job's own size does. `judge` has the truth of the job.
///
/// # Errors
/// A truth that cannot be integrated.
pub(super) fn instead(
    family: &dyn Family,
    (job, own): (&TableJob, &[usize]),
    judge: &Judge,
    limit: f64,
    context: &Context,
) -> Result<Vec<String>, BakeError> {
    let mut choices = Vec::new();
    // Sizes of one row of choices have one shape: the first number tells which is smaller.
    let mut smallest = |job: TableJob, from: Vec<usize>, (grown, most): (Grown, &[usize]), but: &str| {
        let mut size = Some(from);
        while let Some(of) = size.take().filter(|size| size.as_slice() <= most && is_measured(size)) {
            let choice = measured(family, (&job, &of), but, judge, context)?;
            let error = choice.error;
            choices.push(choice);
            if error <= limit {
                return Ok(Some(of));
            }
            let larger = |size: &Vec<usize>| Some(grown(size));
            let within = |size: &Vec<usize>| size.as_slice() <= most && is_measured(size);
            let further = successors(larger(&of), larger).take_while(within).count();
            let reached = (0..=further).fold(limit, |reached, _| FALL * reached);
            size = Some(grown(&of)).filter(|_| error <= reached);
        }
        Ok::<_, BakeError>(None)
    };
    let largest = vec![usize::MAX; own.len()];
    let (mut grown, mut kept) = (doubled as Grown, None);
    if own.len() > 2 && !job.want.has_one_slice() {
        kept = smallest(job.clone(), of_same_slices(own), (of_same_slices, &largest), "")?;
    }
    if kept.is_some() {
        grown = of_same_slices;
    } else {
        kept = smallest(job.clone(), doubled(own), (doubled, &largest), "")?;
    }
    let sizes = (grown, kept.as_deref().unwrap_or(&largest));
    for &layout in family.layouts().iter().filter(|layout| **layout != job.want.layout) {
        let but = format!(", layout `{}` (another fetch in the shader)", layout.name());
        smallest(
            TableJob { want: TableWant { layout, ..job.want.clone() }, ..job.clone() },
            own.to_vec(),
            sizes,
            &but,
        )?;
    }
    let finer = match job.want.format {
        TexelFormat::Unorm8 => Some(TexelFormat::Unorm16),
        TexelFormat::F16 => Some(TexelFormat::F32),
        TexelFormat::Unorm16 | TexelFormat::F32 => None,
    };
    if let Some(format) = finer {
        let but = format!(", format `{}`", format.name());
        smallest(
            TableJob { want: TableWant { format, ..job.want.clone() }, ..job.clone() },
            own.to_vec(),
            sizes,
            &but,
        )?;
    }
    let square = |size: &Vec<usize>| size.len() == 2 && size.iter().all(|n| *n <= AUTO_SIDE);
    let chosen = job.want.size.is_some() && kept.as_ref().is_some_and(square);
    let narrowed = match kept {
        Some(_) => None,
        None => narrowed(family, (job, own), (judge.truth(0).b.is_some(), limit), context)?,
    };
    Ok(said(&choices, (limit, job.want.layout), narrowed, chosen))
}

/// The line with the widest ranges of n_dot_v and roughness that both begin at one of [`LOWS`] over which
/// a table of two axes in this size keeps the limit, if any: others that begin apart may be wider. They end
/// at the centre of the last texel: beyond it a lookup clamps. Outside of them the table errs by more: its
/// texels are optimised for what is inside, and a shader that clamps its arguments is no nearer to the
/// truth.
fn narrowed(
    family: &dyn Family,
    (job, size): (&TableJob, &[usize]),
    (finer, limit): (bool, f64),
    context: &Context,
) -> Result<Option<String>, BakeError> {
    let &[columns, rows] = size else { return Ok(None) };
    for low in LOWS {
        let within = |[from, to]: [f64; 2], n: usize| {
            let [from, to] = [from.max(low), to.min(1.0 - 0.5 / n as f64)];
            (from + ROUGHNESS_WIDTH_MIN <= to).then_some([from, to])
        };
        let (Some(mu), Some(roughness)) =
            (within(job.region.mu, columns), within(job.region.roughness, rows))
        else {
            break;
        };
        let job = TableJob { region: Region { mu, roughness, ..job.region }, ..job.clone() };
        let judge = Judge::new(family, job.smith, job.region, finer, &context.memo)?;
        let Choice { bytes, error, .. } = measured(family, (&job, size), "", &judge, context)?;
        if error <= limit {
            return Ok(Some(format!(
                "keeps it over a part: {} over `n_dot_v` {mu:?} of the table and `roughness` {roughness:?} of the materials, up to \
                 the centres of its last texels, where a lookup clamps; outside it errs by more, clamped or not: {bytes} bytes, \
                 error {error}",
                size_text(size)
            )));
        }
    }
    Ok(None)
}

/// Side from which on f32 texels tell: in smaller tables the errors between texels are larger than
/// those of f16.
const WIDE_SIDE: usize = 64;

/// A line that names the smallest square table of a job whose size is open with a relative error
/// within a limit that no formula keeps, or the largest where even that exceeds it. By a table E is
/// divided out, so that its relative error is the furnace error.
///
/// # Errors
/// A truth that cannot be integrated.
pub fn table_instead(
    family: &dyn Family,
    job: &TableJob,
    limit: f64,
    context: &Context,
) -> Result<String, BakeError> {
    // Of one roughness fits are without it, and a table of a range about it.
    let roughness = Span::roughness(job.region.roughness, job.region.alpha_map).widened();
    let job = &TableJob { region: Region { roughness, ..job.region }, ..job.clone() };
    let judge = Judge::new(family, job.smith, job.region, false, &context.memo)?;
    let wide = |size: &Vec<usize>| (size[0] >= WIDE_SIDE).then(|| (size.clone(), TexelFormat::F32));
    let each = |size: Vec<usize>| [wide(&size), Some((size, TexelFormat::F16))].into_iter().flatten().rev();
    let mut tried: Vec<(Vec<usize>, TexelFormat)> = job.sizes().into_iter().flat_map(each).collect();
    let last = tried.pop();
    for (size, format) in tried {
        let line = in_place(family, job, (&size, format), (&judge, limit, true), context)?;
        if let Some(line) = line {
            return Ok(line);
        }
    }
    let Some((size, format)) = last else { return Ok(String::new()) };
    let line = in_place(family, job, (&size, format), (&judge, limit, false), context)?;
    Ok(line.unwrap_or_default())
}

/// What is said of a table in place of a fit; `None` where it has to keep the limit and does not.
fn in_place(
    family: &dyn Family,
    job: &TableJob,
    (size, format): (&[usize], TexelFormat),
    (judge, limit, must): (&Judge, f64, bool),
    context: &Context,
) -> Result<Option<String>, BakeError> {
    let spec = Spec { format, ..job.spec(size.to_vec(), &size_text(size)) };
    let (tables, made) = built(family, &spec, context)?;
    let lacks = || BakeError::Internal("a job without a table".into());
    let table = tables.first().ok_or_else(lacks)?;
    if must && judge.exceeds((table, spec.decode()), 0, limit)? {
        return Ok(None);
    }
    let judge = judge.closer((table, spec.decode()), (family, 0), &context.memo)?;
    let certificate = finish(&spec, table, made, judge)?.approximation.certificate;
    let is_kept = certificate.max_rel <= limit;
    if must && !is_kept {
        return Ok(None);
    }
    let keeps = if is_kept { "keeps it" } else { "nearest" };
    let format = match format {
        TexelFormat::F32 => format!(", \"format\": \"{}\"", format.name()),
        _ => String::new(),
    };
    Ok(Some(format!(
        "{keeps}: a table in place of `fit`, `\"tables\": [{{\"size\": {size:?}{format}, \"max_error\": {}}}]`: {} bytes, \
         1/E within {} of 1/E of the truth",
        certificate.max_abs,
        table.bytes(),
        short(certificate.max_rel)
    )))
}

/// A line for each choice that keeps the limit, and for each range; where none does, what was
/// measured, and what else a scene can change.
fn said(
    choices: &[Choice],
    (limit, layout): (f64, Layout),
    narrowed: Option<String>,
    is_chosen: bool,
) -> Vec<String> {
    let line = |choice: &Choice| {
        let Choice { words, bytes, error, .. } = choice;
        format!("keeps it: {words}: {bytes} bytes, error {error}")
    };
    let mut keep: Vec<&Choice> = choices.iter().filter(|choice| choice.error <= limit).collect();
    keep.sort_by_key(|choice| choice.bytes);
    let mut lines: Vec<String> = keep.iter().copied().map(line).collect();
    let is_own = |choice: &&Choice| choice.layout == layout;
    if let (false, Some(most)) = (keep.iter().any(is_own), choices.iter().rfind(is_own))
        && !keep.is_empty()
    {
        let Choice { words, error, .. } = most;
        lines.push(format!("layout `{}` does not over these ranges, up to {words} ({error})", layout.name()));
    }
    lines.extend(narrowed);
    if is_chosen {
        lines.push(
            "keeps it: no `size`: lobefit chooses the smallest square of 16, 32, 64 or 128 that does".into(),
        );
    }
    if lines.is_empty() {
        let each = |choice: &Choice| format!("{} ({})", choice.words, choice.error);
        let all = choices.iter().map(each).collect::<Vec<_>>().join("; ");
        lines.push(match choices {
            [] => "a larger size is not measured".into(),
            _ => format!(
                "measured, and not within it: {all}; with twice as many texels a side an error falls to a quarter at best"
            ),
        });
        let least = choices.iter().min_by(|a, b| a.error.total_cmp(&b.error));
        let to = |Choice { words, error, .. }: &Choice| format!("raise max_error to {error}, with {words}");
        lines.push(least.map_or_else(|| "raise max_error".into(), to));
    }
    lines
}

/// The next size to measure.
type Grown = fn(&[usize]) -> Vec<usize>;

/// Twice as many columns and rows in as many slices.
fn of_same_slices(size: &[usize]) -> Vec<usize> {
    size.iter().enumerate().map(|(axis, n)| if axis < 2 { 2 * n } else { *n }).collect()
}

fn doubled(size: &[usize]) -> Vec<usize> {
    // One slice stays one.
    size.iter().map(|n| if *n == 1 { 1 } else { 2 * n }).collect()
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
    but: &str,
    judge: &Judge,
    context: &Context,
) -> Result<Choice, BakeError> {
    let spec = job.spec(size.to_vec(), &size_text(size));
    let (tables, made) = built(family, &spec, context)?;
    let (mut error, mut bytes) = (0.0_f64, 0);
    for (i, table) in tables.iter().enumerate() {
        bytes = table.bytes();
        let closer = judge.closer((table, spec.decode()), (family, i), &context.memo)?;
        error = error.max(finish(&spec, table, made, closer)?.errors.lookup.max);
    }
    let words = format!("{}{but}", size_text(size));
    Ok(Choice { words, layout: job.want.layout, bytes, error })
}
