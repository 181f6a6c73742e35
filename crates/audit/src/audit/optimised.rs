//! Texels that are off so that what is looked up between them is less so.

use std::sync::Arc;

use super::column::Column;
use super::convention::Convention;
use super::defects::Defect;
use super::errors::Residuals;
use super::extent::Extent;
use super::found::{ChannelAudit, Fit};
use super::lookup::{Look, Points};
use super::table::AuditedTable;

/// Puts true texels into the parts of a channel that are off.
pub(super) fn mend(r: &Residuals, defects: &[Defect], values: &mut Arc<Vec<f64>>) {
    // Of a lattice of a large table nothing is known of the texels between.
    let whole = r.values.len() == values.len();
    for extent in defects.iter().filter_map(part).filter(|_| whole) {
        let values = Arc::make_mut(values);
        let inside = r.judged.iter().filter(|i| r.lies_in(**i, extent));
        inside.for_each(|i| values[*i] = r.truth(*i));
    }
}

fn part(defect: &Defect) -> Option<&Extent> {
    if let Defect::Part { extent, .. } = defect { Some(extent) } else { None }
}

/// How many times larger the root mean square of lookups may be for a smaller largest error.
const TRADED: f64 = 1.5;

/// Says what they are of parts for which lookups are the better: the largest error of those at even places is
/// held against that of the table whose parts are mended.
pub(super) fn excused(
    points: &Points,
    convention: &Convention,
    [own, mended]: [&AuditedTable; 2],
    channels: &mut [ChannelAudit],
) {
    // Texels that are wrong in two channels are no better with one of them mended.
    let damaged = || used(points, convention, own)[0] >= used(points, convention, mended)[0];
    if own.channels == mended.channels || damaged() {
        return;
    }
    // One channel's texels do not answer for another's.
    for (k, channel) in channels.iter_mut().enumerate() {
        if own.channels[k] == mended.channels[k] {
            continue;
        }
        let mut one = own.clone();
        one.channels[k] = mended.channels[k].clone();
        let ([most, rms], [most_mended, rms_mended]) =
            (used(points, convention, own), used(points, convention, &one));
        if most >= most_mended || rms > TRADED * rms_mended {
            continue;
        }
        for defect in &mut channel.defects {
            if let Defect::Part { texels, .. } = defect {
                *defect = Defect::Optimised { texels: texels[0], lookups: [most, most_mended] };
            }
        }
        let is_left = |d: &Defect| matches!(d, Defect::Dead { .. } | Defect::Clamped { .. });
        if channel.fit == Fit::Part && !channel.defects.iter().any(is_left) {
            channel.fit = Fit::Whole;
        }
    }
}

/// Largest error of lookups, and root mean square: of B and of A + B, which pixels are made of, or of every
/// channel.
fn used(points: &Points, convention: &Convention, table: &AuditedTable) -> [f64; 2] {
    let b = convention.columns.iter().position(|c| *c == Some(Column::B));
    let (mut most, mut squares) = (0.0_f64, 0.0);
    for (channel, column) in table.channels.iter().zip(&convention.columns) {
        let Some(column) = *column else { continue };
        let (column, values) = match (column, b) {
            (Column::A, Some(b)) => {
                let both = channel.values.iter().zip(table.channels[b].values.iter());
                (Column::E, Arc::new(both.map(|(a, b)| a + b).collect()))
            }
            _ => (column, channel.values.clone()),
        };
        let look = Look { size: &table.size, values: &values, column, registration: None };
        let [max, rms] = points.even(&look);
        (most, squares) = (most.max(max), squares + rms * rms);
    }
    [most, squares.sqrt()]
}
