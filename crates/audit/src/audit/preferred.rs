//! One plain registration of all axes before a mixture or a shift, unless that is right beyond doubt and
//! its remedy would lessen the error of the use; centres before end points, unless these are likely.
//! A biased quantiser, sampling noise or an approximation may be nearer to texels that lie elsewhere
//! without their lying there.

use super::AuditError;
use super::axis::AxisReading;
use super::best::Case;
use super::clamp::with_floors;
use super::defects::Grain;
use super::errors::Residuals;
use super::judge::{judge, rejudge};
use super::lookup::{Look, Points};
use super::plain::is_usual;
use super::sample::{Candidate, Fitted, Sample};
use super::table::Source;
use super::truth::Truth;
use super::{LAST, Registration};

/// How much worse the plain reading must rank for another to be right beyond doubt.
pub(super) const BEYOND_DOUBT: f64 = 3.0;

/// How much worse it must rank for the texels alone to say that the other is right, whatever lookups
/// between them make of it.
const OVERWHELMING: f64 = 20.0;

/// What of the root mean square of the plain lookup the remedy may leave at most; the largest error
/// may not grow either.
const LESSENED: f64 = 0.7;

/// How much better end points must rank than centres to be taken for them.
const LIKELY: f64 = 1.2;

/// The conventions with the plain form of the first before it, where that is preferred: all axes at
/// centres, or all at end points; of a function those of the usual arguments.
pub(super) fn plain_first(
    truth: &Truth,
    case: &Case,
    mut found: Vec<Candidate>,
) -> Result<Vec<Candidate>, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    if table.source == Source::Function && fixed.axes.is_none() {
        let is_nearly = |c: &Candidate| {
            let Fitted { rank, columns, .. } = &found[0].fitted;
            c.fitted.rank <= BEYOND_DOUBT * rank && c.fitted.columns == *columns
        };
        let usual = |c: &Candidate| table.axes.iter().zip(&c.axes).all(|(name, axis)| is_usual(name, axis));
        if let Some(k) = found.iter().position(|c| usual(c) && is_nearly(c)) {
            found[..=k].rotate_right(1);
        }
    }
    let best = &found[0];
    if fixed.registrations.is_some() || table.source != Source::Table {
        return Ok(found);
    }
    let sample = Sample::new(table, live, LAST[usize::from(table.size.len() == 3)], false);
    let plain = |registration| -> Result<Option<Candidate>, AuditError> {
        let mut bare = best.clone();
        for axis in &mut bare.axes {
            let floor = fixed.floor(axis.scale.input()).unwrap_or(0.0);
            *axis = AxisReading { registration, floor, ..*axis };
        }
        let bare = rejudge(truth, &sample, fixed, vec![bare], Truth::ranked)?;
        bare.first().map(|bare| with_floors(truth, &sample, fixed, bare)).transpose()
    };
    let quantised = |c: &Candidate| is_quantised(truth, case, &sample, c);
    let (centres, ends) = (plain(Registration::Centre)?, plain(Registration::Endpoint)?);
    let likely =
        |centre: &Candidate| ends.as_ref().is_none_or(|ends| centre.fitted.rank <= LIKELY * ends.fitted.rank);
    let plain = match (centres, ends.clone()) {
        (Some(centre), _) if likely(&centre) || quantised(&centre)? => centre,
        (centre, ends) => match ends.or(centre) {
            Some(plain) => plain,
            None => return Ok(found),
        },
    };
    let gain = plain.fitted.rank / best.fitted.rank;
    let worthless = |gain: f64| -> Result<bool, AuditError> {
        let registration = plain.axes[0].registration;
        Ok(gain < OVERWHELMING && !remedy_lessens(truth, case, (best, registration))?)
    };
    if gain < BEYOND_DOUBT || !is_layered(best) && worthless(gain)? || quantised(&plain)? {
        found.retain(|c| !c.like(&plain));
        found.insert(0, plain);
    }
    Ok(found)
}

/// Whether columns and rows are both at centres and slices at end points, or the other way round: both are
/// usual, and lookups next to an index of 1, where energy falls as a step, tell nothing of where slices lie.
fn is_layered(candidate: &Candidate) -> bool {
    let lies: Vec<Registration> = candidate.axes.iter().map(|axis| axis.registration).collect();
    let plain = [Registration::Centre, Registration::Endpoint];
    lies.len() == 3 && lies[0] == lies[1] && lies[1] != lies[2] && lies.iter().all(|own| plain.contains(own))
}

/// Whether lookups at the coordinates that the texels have are clearly better than those at the plain
/// ones, for every channel.
fn remedy_lessens(
    truth: &Truth,
    case: &Case,
    (best, plain): (&Candidate, Registration),
) -> Result<bool, AuditError> {
    let Case { table, live, .. } = *case;
    let convention = best.convention(truth, live, table.channels.len());
    let points = Points::new(truth, &convention, best.lobe, &table.size)?;
    let lessened = |k: &usize| -> Result<bool, AuditError> {
        let Some(column) = convention.columns[*k] else { return Ok(true) };
        let values = &table.channels[*k].values;
        let by = |registration| points.errors(&Look { size: &table.size, values, column, registration });
        Ok(match (by(None)?, by(Some(plain))?) {
            (Some(own), Some(plain)) => own.rms < LESSENED * plain.rms && own.inner <= plain.inner,
            _ => true,
        })
    };
    live.iter().try_fold(true, |all, k| Ok(all && lessened(k)?))
}

/// Whether a quantiser that rounds to one side explains all errors of a reading.
fn is_quantised(
    truth: &Truth,
    case: &Case,
    sample: &Sample,
    candidate: &Candidate,
) -> Result<bool, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let judgement = judge(truth, sample, &candidate.axes, candidate.lobe, Truth::exact)?;
    let explained = |(place, k): (usize, &usize)| {
        let Some(column) = candidate.fitted.columns[place] else { return true };
        let grain = Grain { samples: None, ..Grain::of(table, *k, fixed) };
        let residuals = Residuals::new(sample, &judgement, column, &sample.values[place]);
        let within = |i: &usize| {
            let left = grain.leaves(&residuals, *i);
            left > 0.0 && residuals.errors[*i].abs() <= left
        };
        residuals.judged.iter().all(within)
    };
    Ok(live.iter().enumerate().all(explained))
}
