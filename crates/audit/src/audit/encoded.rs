//! Values that were encoded for display: a table that was saved as a picture, and fits only once
//! that is undone.

use super::table::{AuditedTable, Source};
use super::truth::Truth;
use super::verdict::{long, opening};
use super::{Audit, AuditError, Fit, Fixed, candidates, finish};
use crate::foreign::{Channel, Step};
use lobefit_math::ops;

/// Most axes of a table of which this is tried: of three every try takes seconds, and pictures have
/// two.
const AXES: usize = 2;

/// What is said of a table that fits nothing, but does when its values are decoded from sRGB; none
/// if it does not.
pub(super) fn srgb(
    truth: &Truth,
    table: &AuditedTable,
    live: &[usize],
    fixed: &Fixed,
    done: &Audit,
) -> Result<Option<String>, AuditError> {
    let values = || live.iter().flat_map(|k| &table.channels[*k].values);
    let picture = table.source == Source::Table && table.size.len() <= AXES;
    if done.fit != Fit::None || !picture || !values().all(|v| (0.0..=1.0).contains(v)) {
        return Ok(None);
    }
    let channel = |c: &Channel| Channel {
        name: c.name.clone(),
        values: c.values.iter().map(|v| decoded(*v)).collect(),
    };
    let linear = AuditedTable {
        channels: table.channels.iter().map(channel).collect(),
        step: Step::None,
        ..table.clone()
    };
    let (found, _) = candidates(truth, &linear, live, fixed, &|_| ())?;
    let linear = finish(truth, &linear, live, fixed, &found, None)?;
    Ok((linear.fit == Fit::Whole).then(|| {
        format!(
            "But with its values decoded from sRGB it is {} Its values were encoded for display: store them as they are, or sample it as an \
             sRGB texture. So read it is off by at most {}.",
            opening(&linear),
            long(linear.worst())
        )
    }))
}

/// The linear value of an sRGB one in [0, 1] (IEC 61966-2-1).
fn decoded(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ops::pow((x + 0.055) / 1.055, 2.4) }
}
