//! A constant factor of one channel alone: of all channels together it is an encoding.

use super::best::Case;
use super::convention::Convention;
use super::defects::{Defect, Grain};
use super::errors::{Residuals, rms};
use super::judge::Judgement;
use super::sample::Sample;

/// Least share by which a factor that is named changes values.
const LEAST: f64 = 1e-3;

/// Share of the root mean square of the errors that a factor may leave, but for what rounding does.
const LEFT: f64 = 0.1;

/// Root mean square of the errors that a factor explains, beside that of rounding.
const ABOVE_ROUNDING: f64 = 3.0;

/// The factors that channels have, by channel; none where all that are judged have one, as then it is one of
/// the table.
pub(super) fn of_some(
    case: &Case,
    (sample, judgement): (&Sample, &Judgement),
    convention: &Convention,
) -> Vec<Option<Defect>> {
    let Case { table, live, fixed, .. } = *case;
    let of = |(place, k): (usize, &usize)| {
        let column = convention.columns[*k]?;
        let residuals = Residuals::new(sample, judgement, column, &sample.values[place]);
        Some((*k, factor(&residuals, Grain::of(table, *k, fixed))))
    };
    let judged: Vec<(usize, Option<Defect>)> = live.iter().enumerate().filter_map(of).collect();
    let mut found = vec![None; table.channels.len()];
    if judged.iter().any(|(_, factor)| factor.is_none()) {
        judged.into_iter().for_each(|(k, factor)| found[k] = factor);
    }
    found
}

/// The factor that all values of a channel have, if nearly all of their errors are gone without it.
fn factor(r: &Residuals, grain: Grain) -> Option<Defect> {
    let truths = || r.judged.iter().map(|i| r.truth(*i));
    let products: f64 = r.judged.iter().map(|i| r.values[*i] * r.truth(*i)).sum();
    let factor = products / truths().map(|truth| truth * truth).sum::<f64>();
    let left = rms(r.judged.iter().map(|i| r.values[*i] - factor * r.truth(*i)));
    let (own, rounding) = (r.rms(&r.judged), rms(r.judged.iter().map(|i| grain.rounding(r.values[*i]))));
    let explains = left <= (LEFT * own).max(rounding) && own > ABOVE_ROUNDING * rounding;
    // Three digits where that is a number which somebody has written.
    let short: f64 = format!("{factor:.3}").parse().unwrap_or(factor);
    let factor = if (short / factor - 1.0).abs() < LEFT * (factor - 1.0).abs() { short } else { factor };
    let worst = r.worst();
    (explains && (factor - 1.0).abs() >= LEAST).then(|| Defect::Factor {
        factor,
        column: r.column,
        most: r.errors[worst].abs(),
        texel: r.texel(worst),
    })
}
