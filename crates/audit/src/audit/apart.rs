//! Channels one by one: a file may hold several quantities, and a channel that is foreign to the
//! one that is asked for does not condemn the others.

use super::axis::AxisReading;
use super::best::{Best, Case, best, promising};
use super::column::Column;
use super::defects::Defect;
use super::encoded::follows;
use super::found::{Audit, ChannelAudit, Fit, Other};
use super::screen::Sieved;
use super::table::{AuditedTable, Source, flat, place};
use super::truth::{Spec, averaged, spec};
use super::verdict::is_loose;
use super::{AuditError, FITS, Fixed};
use crate::foreign::Channel;
use lobefit_truth::quantity::{QUANTITIES, Quantity};

/// The table with the sum of its first two channels that vary, where E is asked for: that of a table
/// of A and B.
pub(super) fn with_sum(mut table: AuditedTable, quantity: &dyn Quantity, fixed: &Fixed) -> AuditedTable {
    let splits = spec(quantity).is_some_and(|spec| spec.columns.contains(&Column::A));
    let asked = fixed.column == Some(Column::E) && fixed.meanings.is_none();
    if !(asked && splits && table.source == Source::Table) {
        return table;
    }
    if let [first, second, ..] = table.channels.iter().filter(|c| c.varies()).collect::<Vec<_>>()[..] {
        let values: Vec<f64> = first.values.iter().zip(&*second.values).map(|(a, b)| a + b).collect();
        let name = format!("{} + {}", first.name, second.name);
        table.channels.push(Channel { name, values: values.into() });
    }
    table
}

/// An audit of which some channels fit nothing, with the others judged without those; each of those
/// as the quantity that it is of, if it is of one. `sieved` has what may follow the quantity.
pub(super) fn with_others(
    done: Audit,
    case: &Case,
    quantity: &dyn Quantity,
    sieved: &Sieved,
) -> Result<Audit, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let open = fixed.meanings.is_none() && fixed.column.is_none() && table.source == Source::Table;
    if done.fit != Fit::None || live.len() < 2 || !open {
        return Ok(done);
    }
    let places = 0..live.len();
    let likely: Vec<usize> = places.filter(|k| sieved.is_promising(*k)).map(|k| live[k]).collect();
    let own = following(&Case { live: &likely, ..*case }, quantity)?;
    if own.is_empty() || own.len() == live.len() {
        return Ok(done);
    }
    let case = &Case { live: &own, ..*case };
    let Some(found) = best(case, quantity)? else { return Ok(done) };
    let mut found = found.audit(case)?;
    if found.fit == Fit::None {
        return Ok(done);
    }
    for k in live.iter().filter(|k| !own.contains(k)) {
        let axes: Vec<AxisReading> = found.best().axes.clone();
        let (own, axes) = alone(table, *k, &axes);
        let other = quantity_of(found.quantity, &axes, &Case { table: &own, live: &[0], ..*case })?;
        let channel = &mut found.channels[*k];
        let other = other.map_or(Other::Unknown, |audit| Other::Quantity(Box::new(audit)));
        *channel = ChannelAudit { other: Some(other), ..channel.clone() };
    }
    Ok(found)
}

/// Columns that stand side by side.
const HALVES: [[Column; 2]; 4] =
    [[Column::A, Column::B], [Column::B, Column::A], [Column::R, Column::T], [Column::T, Column::R]];

/// The audit, or that of both halves of an energy where a channel holds one half, and another the other half
/// times a factor: by itself that follows nothing, or another column loosely.
pub(super) fn with_half(done: Audit, case: &Case, quantity: &dyn Quantity) -> Result<Audit, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let open = fixed.meanings.is_none() && fixed.column.is_none() && table.source == Source::Table;
    let is_unknown = |c: &ChannelAudit| c.other == Some(Other::Unknown);
    if !open || !(done.channels.iter().any(is_unknown) || is_loose(&done)) {
        return Ok(done);
    }
    let columns: Vec<Option<Column>> = live.iter().map(|k| done.channels[*k].column).collect();
    for [own, other] in HALVES {
        let Some(held) = columns.iter().position(|column| *column == Some(own)) else { continue };
        for place in (0..live.len()).filter(|place| *place != held) {
            let mut meanings = columns.clone();
            meanings[place] = Some(other);
            let meant = Fixed { meanings: Some(meanings), ..fixed.clone() };
            let scaled = |fixed: &Fixed| -> Result<Option<Audit>, AuditError> {
                let case = Case { fixed, ..*case };
                let Some(both) = best(&case, quantity)? else { return Ok(None) };
                let mut both = both.audit(&case)?;
                let of = &both.channels[live[place]].defects;
                let is_scaled = of.iter().any(|defect| matches!(defect, Defect::Factor { .. }));
                both.excuse_factors();
                Ok((is_scaled && both.fit == Fit::Whole).then_some(Audit { excused: false, ..both }))
            };
            // All conventions are tried where that which was found tells a factor.
            let axes = &done.best().axes;
            let narrow = Fixed {
                axes: Some(axes.iter().map(|a| (a.scale, a.reversed)).collect()),
                registrations: Some(axes.iter().map(|a| a.registration).collect()),
                ..meant.clone()
            };
            if scaled(&narrow)?.is_some()
                && let Some(both) = scaled(&meant)?
            {
                return Ok(both);
            }
        }
    }
    Ok(done)
}

/// The channels that follow a convention of a quantity each on its own.
pub(super) fn following(case: &Case, quantity: &dyn Quantity) -> Result<Vec<usize>, AuditError> {
    let mut own = Vec::new();
    for one in case.live.chunks(1) {
        if follows(&Case { live: one, ..*case }, quantity)? {
            own.push(one[0]);
        }
    }
    Ok(own)
}

/// The table of one channel, and how its axes are read: without those along which it is the same, as an
/// average over the cosine is that stands beside what it is of.
fn alone(table: &AuditedTable, channel: usize, axes: &[AxisReading]) -> (AuditedTable, Vec<AxisReading>) {
    let own = &table.channels[channel];
    let places = |i: usize| place(i, &table.size);
    let first_along = |axis: usize, i: usize| {
        let mut at = places(i);
        at[axis] = 0;
        flat(&at, &table.size)
    };
    let varies =
        |axis: &usize| (0..own.values.len()).any(|i| own.values[i] != own.values[first_along(*axis, i)]);
    let kept: Vec<usize> = (0..axes.len()).filter(varies).collect();
    let is_kept = |i: &usize| places(*i).iter().enumerate().all(|(axis, k)| *k == 0 || kept.contains(&axis));
    let values: Vec<f64> = (0..own.values.len()).filter(is_kept).map(|i| own.values[i]).collect();
    let of = |axis: &usize| table.dead.get(*axis).cloned().unwrap_or_default();
    let alone = AuditedTable {
        channels: vec![Channel { name: own.name.clone(), values: values.into() }],
        what: format!("channel {}", own.name),
        size: kept.iter().map(|axis| table.size[*axis]).collect(),
        axes: kept.iter().map(|axis| table.axes[*axis].clone()).collect(),
        dead: kept.iter().map(of).collect(),
        ..table.clone()
    };
    (alone, kept.iter().map(|axis| axes[*axis]).collect())
}

/// The other quantity that a channel is of, or the average of the same, with the axes of those beside it.
fn quantity_of(beside: &str, axes: &[AxisReading], channel: &Case) -> Result<Option<Audit>, AuditError> {
    let fixed = Fixed {
        axes: Some(axes.iter().map(|a| (a.scale, a.reversed)).collect()),
        registrations: Some(axes.iter().map(|a| a.registration).collect()),
        ..Fixed::default()
    };
    let mut inputs: Vec<_> = axes.iter().map(|a| a.scale.input()).collect();
    inputs.sort();
    let case = Case { fixed: &fixed, ..*channel };
    let mut found: Vec<Best> = Vec::new();
    let sorted = |spec: Spec| {
        let mut own = spec.inputs.to_vec();
        own.sort();
        own
    };
    for quantity in QUANTITIES {
        let other = spec(quantity).filter(|_| quantity.name() != beside);
        let is_of = other.into_iter().chain(averaged(quantity)).any(|spec| sorted(spec) == inputs);
        if !is_of || promising(&case, quantity)?.is_empty() {
            continue;
        }
        found.extend(best(&case, quantity)?);
    }
    // One that fits goes before one of which a part does: a channel may stand at what its format holds.
    found.sort_by(|a, b| {
        let rank = |best: &Best| best.found[0].fitted.rank;
        (a.off > FITS).cmp(&(b.off > FITS)).then(rank(a).total_cmp(&rank(b)))
    });
    let audit = found.first().map(|best| best.audit(&case)).transpose()?;
    Ok(audit.filter(|audit| audit.fit != Fit::None))
}
