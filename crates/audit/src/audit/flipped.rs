//! A channel that is flipped beside others that are not: of all channels together it is how an axis is read.

use super::best::Case;
use super::column::Column;
use super::convention::{Convention, Fixed};
use super::defects::Defect;
use super::errors::Residuals;
use super::judge::{Judgement, judge, rejudge};
use super::sample::{Candidate, Sample};
use super::table::{Source, flat, place};
use super::truth::Truth;
use super::{AuditError, FITS};

/// The conventions with that first whose axes all rise, where the best has some that fall, and channels that
/// fit by it are those that do not fit by the other.
pub(super) fn rising_first(
    truth: &Truth,
    case: &Case,
    sample: &Sample,
    mut found: Vec<Candidate>,
) -> Result<Vec<Candidate>, AuditError> {
    let Case { table, fixed, .. } = *case;
    let Some(first) = found.first().filter(|_| table.source == Source::Table && fixed.axes.is_none()) else {
        return Ok(found);
    };
    let mut rising = first.clone();
    rising.axes.iter_mut().for_each(|axis| axis.reversed = false);
    if rising.axes == first.axes || sample.values.len() < 2 {
        return Ok(found);
    }
    let fits = |candidate: &Candidate| -> Result<Vec<bool>, AuditError> {
        let judgement = judge(truth, sample, &candidate.axes, candidate.lobe, Truth::quick)?;
        let fits = |(column, own): (&Option<Column>, &Vec<f64>)| {
            let residuals = column.map(|column| Residuals::new(sample, &judgement, column, own));
            residuals.is_some_and(|r| r.misfit(&r.judged) <= FITS)
        };
        Ok(candidate.fitted.columns.iter().zip(&sample.values).map(fits).collect())
    };
    let falling = fits(first)?;
    let Some(free) = rejudge(truth, sample, fixed, vec![rising], Truth::quick)?.pop() else {
        return Ok(found);
    };
    let rising = fits(&free)?;
    if [true, false].iter().all(|fits| falling.contains(fits))
        && falling.iter().zip(&rising).all(|(a, b)| a != b)
    {
        let columns = falling.iter().zip(first.fitted.columns.iter().zip(&free.fitted.columns));
        let meanings = columns.map(|(falls, (own, other))| if *falls { *own } else { *other }).collect();
        let meant = Fixed { meanings: Some(meanings), ..fixed.clone() };
        let rising = rejudge(truth, sample, &meant, vec![free], Truth::quick)?;
        // What fits better does so by the channel that is flipped.
        found.retain(|c| rising.iter().all(|own| own.fitted.rank < c.fitted.rank));
        found.splice(..0, rising);
    }
    Ok(found)
}

/// The channels that are flipped along some axes, by channel; none where all that are judged are, and none of
/// a table of which some texels alone are looked at.
pub(super) fn of_some(
    case: &Case,
    (sample, judgement): (&Sample, &Judgement),
    convention: &Convention,
) -> Vec<Option<Defect>> {
    let Case { table, live, .. } = *case;
    let mut found = vec![None; table.channels.len()];
    if sample.dims() != table.size {
        return found;
    }
    let mut is_alone = true;
    for (values, k) in sample.values.iter().zip(live) {
        let Some(column) = convention.columns[*k] else { continue };
        let own = Residuals::new(sample, judgement, column, values);
        if own.misfit(&own.judged) <= FITS {
            is_alone = false;
            continue;
        }
        let axes = (1..1 << table.size.len()).map(|set| {
            (0..table.size.len()).filter(move |axis| set >> axis & 1 == 1).collect::<Vec<usize>>()
        });
        let is_flipped = |axes: &Vec<usize>| {
            let turned = turned(values, &table.size, axes);
            let other = Residuals::new(sample, judgement, column, &turned);
            other.misfit(&other.judged) <= FITS
        };
        let worst = own.worst();
        let (most, texel) = (own.errors[worst].abs(), own.texel(worst));
        found[*k] =
            axes.into_iter().find(is_flipped).map(|axes| Defect::Flipped { axes, column, most, texel });
    }
    if is_alone { vec![None; found.len()] } else { found }
}

/// Values with some axes turned round.
fn turned(values: &[f64], size: &[usize], axes: &[usize]) -> Vec<f64> {
    let of = |i: usize| {
        let mut at = place(i, size);
        axes.iter().for_each(|axis| at[*axis] = size[*axis] - 1 - at[*axis]);
        values[flat(&at, size)]
    };
    (0..values.len()).map(of).collect()
}
