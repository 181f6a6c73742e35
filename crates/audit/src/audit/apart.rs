//! Channels one by one: a file may hold several quantities, and a channel that is foreign to the
//! one that is asked for does not condemn the others.

use super::best::{Best, Case, best, promising};
use super::column::Column;
use super::encoded::follows;
use super::found::{Audit, ChannelAudit, Fit, Other};
use super::screen::Sieved;
use super::table::{AuditedTable, Source};
use super::truth::spec;
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
        let other = quantity_of(&found, &Case { table: &alone(table, *k), live: &[0], ..*case })?;
        let channel = &mut found.channels[*k];
        let other = other.map_or(Other::Unknown, |audit| Other::Quantity(Box::new(audit)));
        *channel = ChannelAudit { other: Some(other), ..channel.clone() };
    }
    Ok(found)
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

/// The table of one channel.
fn alone(table: &AuditedTable, channel: usize) -> AuditedTable {
    let channels = vec![table.channels[channel].clone()];
    AuditedTable { channels, what: format!("channel {}", table.channels[channel].name), ..table.clone() }
}

/// The other quantity that a channel is of, with the axes of those beside it.
fn quantity_of(beside: &Audit, channel: &Case) -> Result<Option<Audit>, AuditError> {
    let axes = &beside.best().axes;
    let fixed = Fixed {
        axes: Some(axes.iter().map(|a| (a.scale, a.reversed)).collect()),
        registrations: Some(axes.iter().map(|a| a.registration).collect()),
        ..Fixed::default()
    };
    let mut inputs: Vec<_> = axes.iter().map(|a| a.scale.input()).collect();
    inputs.sort();
    let case = Case { fixed: &fixed, ..*channel };
    let mut found: Vec<Best> = Vec::new();
    for quantity in QUANTITIES.into_iter().filter(|q| q.name() != beside.quantity) {
        let mut own = spec(quantity).map_or(Vec::new(), |spec| spec.inputs.to_vec());
        own.sort();
        if own != inputs || promising(&case, quantity)?.is_empty() {
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
