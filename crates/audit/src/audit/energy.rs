//! How much of the light comes back by a table.

use super::block::ONE_SIGN;
use super::column::Column;
use super::convention::Convention;
use super::defects::{Defect, Grain, holds_albedo, noise};
use super::errors::Residuals;
use super::found::Furnace;
use super::inputs_at;
use super::judge::Judgement;
use super::sample::Sample;
use super::table::{AuditedTable, place};

/// E over the table's E, less 1, at the texels; from the one channel that holds an albedo, or from
/// A and B.
pub(super) fn furnace(
    table: &AuditedTable,
    convention: &Convention,
    sample: &Sample,
    judgement: &Judgement,
    live: &[usize],
) -> Option<Furnace> {
    let channel = |wanted: &dyn Fn(Column) -> bool| {
        live.iter().position(|k| convention.columns[*k].is_some_and(wanted)).map(|p| (live[p], p))
    };
    let albedo = channel(&holds_albedo);
    let sum = channel(&|c| c == Column::A).zip(channel(&|c| c == Column::B));
    let at = |i: usize| -> Option<(f64, f64)> {
        if let Some((k, p)) = albedo {
            let column = convention.columns[k]?;
            return Some((column.albedo(sample.values[p][i])?, column.true_albedo(judgement.base[i])?));
        }
        let ((_, a), (_, b)) = sum?;
        Some((sample.values[a][i] + sample.values[b][i], judgement.base[i][0]))
    };
    let mut out: Option<Furnace> = None;
    let mut dark = 0;
    let dims = sample.dims();
    for i in (0..judgement.base.len()).filter(|i| judgement.judged[*i]) {
        let (stored, truth) = at(i)?;
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
        out = Some(Furnace { range, at, dark });
    }
    out.map(|f| Furnace { dark, ..f })
}

/// The sum of A and B, for a channel of A beside one of B.
pub(super) fn sum(
    sample: &Sample,
    convention: &Convention,
    live: &[usize],
    channel: usize,
) -> Option<Vec<f64>> {
    let place = |wanted| live.iter().position(|k| convention.columns[*k] == Some(wanted));
    let [a, b] = [place(Column::A)?, place(Column::B)?];
    let both = sample.values[a].iter().zip(&sample.values[b]);
    (live[a] == channel).then(|| both.map(|(a, b)| a + b).collect())
}

/// A truth from which on nearly all of the light comes back.
const BRIGHT: f64 = 0.95;

/// How many times the errors that jump from texel to texel a gain is above.
const ABOVE_NOISE: f64 = 6.0;

/// Adds a gain of energy by a channel, or by the `whole` of it and another, to its defects; a loss that is
/// missing is part of one.
pub(super) fn gains(r: &Residuals, whole: Option<&[f64]>, grain: Grain, defects: &mut Vec<Defect>) {
    let whole = whole.map(|values| Residuals::new(r.sample, r.judgement, Column::E, values));
    if let Some(gain) = gain(whole.as_ref().unwrap_or(r), grain) {
        defects.retain(|defect| !matches!(defect, Defect::MissingLoss { .. }));
        defects.push(gain);
    }
}

/// More energy than comes in: beyond what formats leave and what jumps from texel to texel, where the albedo
/// is too high throughout if nearly all of the light comes back, as that of samples is not.
fn gain(r: &Residuals, grain: Grain) -> Option<Defect> {
    let albedos = |i: usize| r.column.albedo(r.values[i]).zip(r.column.albedo(r.truth(i)));
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
    let left = 2.0 * grain.leaves(r, i) + ABOVE_NOISE * noise(r);
    (over > left && sums[0] > ONE_SIGN * sums[1]).then(|| Defect::Gain { albedo, texel: r.texel(i) })
}
