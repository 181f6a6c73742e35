//! What somebody ships, as numbers: channels over a grid, the first axis fastest.

use super::AuditError;
use crate::foreign::{Channel, ForeignTable, Step};

/// Most texels that an audit takes: 256^3.
pub const MOST_TEXELS: usize = 1 << 24;

/// What the values are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Texels.
    Table,
    /// A function, sampled at texel centres of its arguments.
    Function,
}

/// A table whose conventions are not known.
#[derive(Clone, Debug, PartialEq)]
pub struct AuditedTable {
    /// File and array, for messages.
    pub what: String,
    /// Texels along every axis, the fastest first.
    pub size: Vec<usize>,
    /// Names of the axes, or of a function's arguments.
    pub axes: Vec<String>,
    /// What the values are of.
    pub source: Source,
    /// The channels.
    pub channels: Vec<Channel>,
    /// What the format rounds values to.
    pub step: Step,
}

impl From<&ForeignTable> for AuditedTable {
    fn from(table: &ForeignTable) -> AuditedTable {
        let name = if table.name.is_empty() { String::new() } else { format!(", {}", table.name) };
        AuditedTable {
            what: format!("{}{name}", table.file),
            size: table.size.clone(),
            axes: AuditedTable::axes_of(table.size.len()),
            source: Source::Table,
            channels: table.channels.clone(),
            step: table.step,
        }
    }
}

impl AuditedTable {
    /// `x`, `y`, `z`.
    pub fn axes_of(axes: usize) -> Vec<String> {
        ["x", "y", "z"].into_iter().take(axes).map(String::from).collect()
    }

    /// The same without axes of one texel, checked: finite values in the size's number.
    pub(super) fn checked(&self) -> Result<AuditedTable, AuditError> {
        let expected = self.size.iter().try_fold(1_usize, |n, s| n.checked_mul(*s)).unwrap_or(usize::MAX);
        if expected > MOST_TEXELS {
            let reason = format!("{expected} texels; an audit takes at most {MOST_TEXELS}");
            return Err(AuditError::refused(&self.what, reason));
        }
        for channel in &self.channels {
            if channel.values.len() != expected || expected == 0 {
                let (name, found, size) = (&channel.name, channel.values.len(), &self.size);
                let reason = format!(
                    "channel `{name}` has {found} values, size {size:?} calls for {expected}; give --size and --channels"
                );
                return Err(AuditError::refused(&self.what, reason));
            }
            if let Some(i) = channel.values.iter().position(|v| !v.is_finite()) {
                return Err(self.not_finite(channel, i));
            }
        }
        let size: Vec<usize> = self.size.iter().copied().filter(|n| *n > 1).collect();
        if size.is_empty() || size.iter().any(|n| *n < 4) {
            let reason = format!(
                "{:?} texels are too few to tell how the table is meant; 4 along every axis are called for",
                self.size
            );
            return Err(AuditError::refused(&self.what, reason));
        }
        let long = |(name, n): (&String, &usize)| (*n > 1).then(|| name.clone());
        let axes = self.axes.iter().zip(&self.size).filter_map(long).collect();
        Ok(AuditedTable { size, axes, ..self.clone() })
    }

    /// The error of a value that is no number: of a function by the arguments, of a table by the
    /// texel.
    fn not_finite(&self, channel: &Channel, i: usize) -> AuditError {
        let (name, texel, value) = (&channel.name, place(i, &self.size), channel.values[i]);
        if self.source != Source::Function {
            let reason =
                format!("channel `{name}`, texel {texel:?}: {value} is not a finite number; mend the file");
            return AuditError::refused(&self.what, reason);
        }
        let part = |(axis, (at, n)): (&String, (&usize, &usize))| {
            format!("{axis} {} of the way through its range", (*at as f64 + 0.5) / *n as f64)
        };
        let at: Vec<String> = self.axes.iter().zip(texel.iter().zip(&self.size)).map(part).collect();
        let at = at.join(", ");
        let reason = format!("its {name} is {value}, not a finite number, at {at}; mend the function");
        AuditError::refused(&self.what, reason)
    }

    /// Channels that vary, by their place; all of them where a meaning is `given` for each.
    pub(super) fn live(&self, given: Option<usize>) -> Result<Vec<usize>, AuditError> {
        let varies = |c: &Channel| c.values.iter().any(|v| *v != c.values[0]);
        if given == Some(self.channels.len()) && self.channels.iter().any(varies) {
            return Ok((0..self.channels.len()).collect());
        }
        let live: Vec<usize> = (0..self.channels.len()).filter(|i| varies(&self.channels[*i])).collect();
        if live.is_empty() {
            let value = self.channels.first().map_or(0.0, |c| c.values[0]);
            let reason = format!("every channel is constant ({value}); there is nothing to measure");
            return Err(AuditError::refused(&self.what, reason));
        }
        Ok(live)
    }
}

/// Index along every axis of a flat index, the first axis fastest.
pub(super) fn place(flat: usize, size: &[usize]) -> Vec<usize> {
    let mut rest = flat;
    size.iter()
        .map(|n| {
            let i = rest % n;
            rest /= n;
            i
        })
        .collect()
}

/// Flat index of an index along every axis.
pub(super) fn flat(place: &[usize], size: &[usize]) -> usize {
    place.iter().zip(size).rev().fold(0, |sum, (i, n)| sum * n + i)
}
