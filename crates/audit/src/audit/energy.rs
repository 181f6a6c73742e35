//! How much of the light comes back by a table.

use super::block::ONE_SIGN;
use super::column::Column;
use super::convention::Convention;
use super::defects::{Defect, Grain, is_of_rounding, missing_loss, noise};
use super::errors::Residuals;
use super::found::Furnace;
use super::inputs_at;
use super::judge::Judgement;
use super::sample::Sample;
use super::table::{AuditedTable, place};

/// Channels whose sum is an albedo, and that.
const HALVES: [[Column; 3]; 2] = [[Column::A, Column::B, Column::E], [Column::R, Column::T, Column::RT]];

/// The sum of two channels that is an albedo, with the first of them.
pub(super) struct Sum {
    pub channel: usize,
    column: Column,
    values: Vec<f64>,
    /// Whether no channel holds it itself.
    is_alone: bool,
}

impl Sum {
    /// The sum of A and B, or of R and T; none where the channels are no such halves.
    pub(super) fn of(sample: &Sample, convention: &Convention, live: &[usize]) -> Option<Sum> {
        let place = |wanted| live.iter().position(|k| convention.columns[*k] == Some(wanted));
        let both = |[a, b, column]: [Column; 3]| Some((place(a)?, place(b)?, column));
        let (a, b, column) = HALVES.into_iter().find_map(both)?;
        let values = sample.values[a].iter().zip(&sample.values[b]).map(|(a, b)| a + b).collect();
        let is_alone = !live.iter().filter_map(|k| convention.columns[*k]).any(|c| c.albedo(0.5).is_some());
        Some(Sum { channel: live[a], column, values, is_alone })
    }
}

/// E over the table's E, less 1, at the texels; from the one channel that holds an albedo, or from
/// two whose `sum` is one.
pub(super) fn furnace(
    (table, convention): (&AuditedTable, &Convention),
    sample: &Sample,
    judgement: &Judgement,
    live: &[usize],
    sum: Option<&Sum>,
) -> Option<Furnace> {
    let own = |k: usize| convention.columns[k].filter(|column| column.albedo(0.5).is_some());
    let albedo = live.iter().zip(&sample.values).find_map(|(k, values)| Some((own(*k)?, values)));
    let (column, values) = albedo.or_else(|| sum.map(|sum| (sum.column, &sum.values)))?;
    let mut out: Option<Furnace> = None;
    let mut dark = 0;
    let dims = sample.dims();
    for i in (0..judgement.base.len()).filter(|i| judgement.judged[*i]) {
        let albedo = |value| column.albedo(value);
        let (stored, truth) = (albedo(values[i])?, albedo(column.value(judgement.base[i]))?);
        // A lobe that gains of its own, and not by an error of the truth, is not compensated.
        if truth > 1.001 {
            return None;
        }
        // A compensation divides by the stored E: there is none of one that is 0 or less.
        let lit = stored > 0.0;
        dark += usize::from(!lit);
        let off = if lit { truth / stored - 1.0 } else { f64::INFINITY };
        let worse = out.as_ref().is_none_or(|f| off.abs() > f.range[0].abs().max(f.range[1].abs()));
        let places: Vec<usize> = place(i, &dims).iter().zip(&sample.at).map(|(k, at)| at[*k]).collect();
        let range = out.as_ref().map_or([off; 2], |f| [f.range[0].min(off), f.range[1].max(off)]);
        let at = match out {
            Some(f) if !worse => f.at,
            _ => inputs_at(convention, &table.size, &places),
        };
        out = Some(Furnace { column, range, at, dark });
    }
    out.map(|f| Furnace { dark, ..f })
}

/// A truth from which on nearly all of the light comes back.
const BRIGHT: f64 = 0.95;

/// Gains below it are errors of a quadrature, and no eye sees them.
const LEAST_GAIN: f64 = 1e-4;

/// How many times the errors that jump from texel to texel a gain is above.
const ABOVE_NOISE: f64 = 6.0;

/// Adds to the defects of a channel what is wrong with the energy of it, or of its `sum` with another: a
/// gain, and of a sum a missing loss, which is why a part of it stands out. A gain has that loss in it.
pub(super) fn energy(
    r: &Residuals,
    sum: Option<&Sum>,
    grain: Grain,
    alpha: impl Fn(&[usize]) -> Option<f64>,
    defects: &mut Vec<Defect>,
) {
    let whole = sum.map(|sum| Residuals::new(r.sample, r.judgement, sum.column, &sum.values));
    let steps = if whole.is_some() { 2.0 } else { 1.0 };
    let is_other = |d: &Defect| matches!(d, Defect::Factor { .. } | Defect::Flipped { .. });
    let is_alone = sum.is_some_and(|sum| sum.is_alone) && !defects.iter().any(is_other);
    let whole_loss = whole.as_ref().filter(|_| is_alone);
    if let Some(missing) = whole_loss.and_then(|whole| missing_loss(whole, grain, steps, alpha)) {
        defects.retain(|defect| !matches!(defect, Defect::Part { .. }));
        defects.push(missing);
    }
    if let Some(gain) = gain(whole.as_ref().unwrap_or(r), grain, steps) {
        defects.retain(|defect| !matches!(defect, Defect::MissingLoss { .. }));
        defects.push(gain);
    }
}

/// The share of the light that comes back, by a value of a column. Columns without one cannot gain energy: a
/// normalisation below 1 takes light away, and radiance grows on its way into a denser medium.
fn comes_back(column: Column, value: f64) -> Option<f64> {
    match column {
        Column::R | Column::T | Column::AverageR => Some(value),
        Column::LossR => Some(1.0 - value),
        Column::Excess => None,
        _ if column.is_normalisation() => None,
        _ => column.albedo(value),
    }
}

/// More energy than comes in: beyond what formats leave, of so many steps each, and what jumps from texel to
/// texel, where the albedo is too high throughout if nearly all of the light comes back, as that of samples
/// is not.
fn gain(r: &Residuals, grain: Grain, steps: f64) -> Option<Defect> {
    let albedos = |i: usize| comes_back(r.column, r.values[i]).zip(comes_back(r.column, r.truth(i)));
    let (mut sums, mut worst) = ([0.0; 2], (0.0, 0, 1.0));
    for i in &r.judged {
        let Some((stored, truth)) = albedos(*i) else { continue };
        if truth >= BRIGHT {
            sums = [sums[0] + stored - truth, sums[1] + (stored - truth).abs()];
        }
        // A lobe that gains of its own has no bound.
        if truth > 1.0 + 1e-6 {
            return None;
        }
        if stored - 1.0 > worst.0 {
            worst = (stored - 1.0, *i, stored);
        }
    }
    let (over, i, albedo) = worst;
    // What jumps as rounding does is counted with it.
    let jumps =
        Some(noise(r, &r.judged)).filter(|jumps| !is_of_rounding(*jumps, r, &r.judged, grain)).unwrap_or(0.0);
    let left = (steps * grain.leaves(r, i) + ABOVE_NOISE * jumps).max(LEAST_GAIN);
    (over > left && sums[0] > ONE_SIGN * sums[1]).then(|| Defect::Gain {
        column: r.column,
        albedo,
        texel: r.texel(i),
    })
}
