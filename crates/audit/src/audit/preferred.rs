//! The plain registration before another, unless the other is right beyond doubt and its remedy would
//! lessen the error of the use. A biased quantiser, sampling noise or an approximation may be nearer
//! to texels that lie elsewhere without their lying there.

use super::AuditError;
use super::convention::Fixed;
use super::defects::{Grain, stored};
use super::errors::Residuals;
use super::judge::{judge, rejudge, with_floors};
use super::lookup::{Look, Points};
use super::sample::{Candidate, Sample};
use super::table::{AuditedTable, Source};
use super::truth::Truth;
use super::{LAST, Registration};

/// How much worse the plain reading must rank for another to be right beyond doubt.
const BEYOND_DOUBT: f64 = 3.0;

/// How much worse it must rank for the texels alone to say that the other is right, whatever lookups
/// between them make of it.
const OVERWHELMING: f64 = 20.0;

/// What of the root mean square of the plain lookup the remedy may leave at most; the largest error
/// may not grow either.
const LESSENED: f64 = 0.7;

/// The conventions with the plain form of the first before it, where that is preferred.
pub(super) fn plain_first(
    truth: &Truth,
    table: &AuditedTable,
    live: &[usize],
    fixed: &Fixed,
    mut found: Vec<Candidate>,
) -> Result<Vec<Candidate>, AuditError> {
    let best = &found[0];
    let plain = |c: &Candidate| c.axes.iter().all(|a| a.registration == a.registration.plain());
    if fixed.registrations.is_some() || table.source != Source::Table || plain(best) {
        return Ok(found);
    }
    let mut axes = best.axes.clone();
    for axis in &mut axes {
        axis.registration = axis.registration.plain();
        axis.floor = fixed.floor(axis.scale.input()).unwrap_or(0.0);
    }
    let sample = Sample::new(table, live, LAST[usize::from(table.size.len() == 3)], false);
    let bare = rejudge(truth, &sample, fixed, vec![Candidate { axes, ..best.clone() }], 1)?;
    let Some(bare) = bare.first() else { return Ok(found) };
    let candidate = with_floors(truth, &sample, fixed, bare)?;
    let gain = candidate.fitted.rank / best.fitted.rank;
    let worthless = |gain: f64| -> Result<bool, AuditError> {
        Ok(gain < OVERWHELMING && !remedy_lessens(truth, table, live, best)?)
    };
    let doubt = gain < BEYOND_DOUBT || worthless(gain)?;
    if doubt || is_quantised(truth, table, (&sample, live), &candidate)? {
        found.retain(|c| !c.like(&candidate));
        found.insert(0, candidate);
    }
    Ok(found)
}

/// Whether lookups at the coordinates that the texels have are clearly better than those of a texture
/// unit that takes them for centres, for every channel.
fn remedy_lessens(
    truth: &Truth,
    table: &AuditedTable,
    live: &[usize],
    best: &Candidate,
) -> Result<bool, AuditError> {
    let convention = best.convention(truth, live, table.channels.len());
    let points = Points::new(truth, &convention, best.lobe)?;
    let lessened = |k: &usize| -> Result<bool, AuditError> {
        let Some(column) = convention.columns[*k] else { return Ok(true) };
        let values = &table.channels[*k].values;
        let by = |registration| points.errors(&Look { size: &table.size, values, column, registration });
        Ok(match (by(None)?, by(Some(Registration::Centre))?) {
            (Some(own), Some(plain)) => own.rms < LESSENED * plain.rms && own.inner <= plain.inner,
            _ => true,
        })
    };
    live.iter().try_fold(true, |all, k| Ok(all && lessened(k)?))
}

/// Whether a quantiser that rounds to one side explains all errors of a reading.
fn is_quantised(
    truth: &Truth,
    table: &AuditedTable,
    (sample, live): (&Sample, &[usize]),
    candidate: &Candidate,
) -> Result<bool, AuditError> {
    let judgement = judge(truth, sample, &candidate.axes, candidate.lobe)?;
    let explained = |(place, k): (usize, &usize)| {
        let Some(column) = candidate.fitted.columns[place] else { return true };
        let step = stored(table.step, &table.channels[*k].values);
        let grain = Grain { step, samples: None };
        let residuals = Residuals::new(sample, &judgement, column, &sample.values[place]);
        let within = |i: &usize| {
            let left = grain.leaves(&residuals, *i);
            left > 0.0 && residuals.errors[*i].abs() <= left
        };
        residuals.judged.iter().all(within)
    };
    Ok(live.iter().enumerate().all(explained))
}
