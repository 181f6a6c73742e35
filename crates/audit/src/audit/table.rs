//! What somebody ships, as numbers: channels over a grid, the first axis fastest.

use super::AuditError;
use super::function::AT_ONE;
pub(super) use crate::foreign::place;
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
    /// What the format rounds values to,
    pub step: Step,
    /// which were multiplied by this since.
    pub scale: f64,
    /// Along every axis the ends that were never filled, which an audit finds.
    pub dead: Vec<Vec<usize>>,
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
            scale: 1.0,
            dead: Vec::new(),
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
            let slices = match size[..] {
                [_, _, n] if n < 4 => format!("; --layer takes one of its slices, 0 to {}", n - 1),
                _ => String::new(),
            };
            let reason = format!(
                "{:?} texels are too few to tell how the table is meant; 4 along every axis are called for{slices}",
                self.size
            );
            return Err(AuditError::refused(&self.what, reason));
        }
        let long = |(name, n): (&String, &usize)| (*n > 1).then(|| name.clone());
        let axes = self.axes.iter().zip(&self.size).filter_map(long).collect();
        let checked = AuditedTable { size, axes, ..self.clone() };
        Ok(AuditedTable { dead: checked.dead(), ..checked })
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

    /// First and last lines along every axis that hold one value throughout, far from what lies beside
    /// them: they were never filled.
    fn dead(&self) -> Vec<Vec<usize>> {
        let live: Vec<&Channel> = self.channels.iter().filter(|c| c.varies()).collect();
        let ends = |(axis, n): (usize, &usize)| {
            let is_dead = |(end, beside): &(usize, usize)| {
                let lines: Vec<_> =
                    live.iter().map(|c| Line::of(&self.size, &c.values, axis, [*end, *beside])).collect();
                lines.iter().all(|line| line.constant) && lines.iter().any(|line| line.jumps)
            };
            let both = [(0, 1), (n - 1, n - 2)].into_iter().filter(is_dead);
            both.map(|(end, _)| end).collect()
        };
        if self.source != Source::Table || self.size.len() < 2 {
            return vec![Vec::new(); self.size.len()];
        }
        self.size.iter().enumerate().map(ends).collect()
    }

    /// The first of the channels that are the same as one, if it is not this one.
    pub(super) fn same(&self, channel: usize) -> Option<usize> {
        (0..channel).find(|k| self.channels[*k].values == self.channels[channel].values)
    }

    /// Whether a channel is of a function at an f0 of 1.
    pub(super) fn is_at_one(&self, channel: &Channel) -> bool {
        self.source == Source::Function && channel.name.ends_with(AT_ONE)
    }

    /// Channels that vary and are not the same as one before, by their place; all of them where a meaning
    /// is `given` for each. Of a function of f0 E may be constant where B varies.
    pub(super) fn live(&self, given: Option<usize>) -> Result<Vec<usize>, AuditError> {
        let some = self.channels.iter().any(Channel::varies);
        if given == Some(self.channels.len()) && some {
            return Ok((0..self.channels.len()).collect());
        }
        let lives = |i: &usize| self.channels[*i].varies() || some && self.is_at_one(&self.channels[*i]);
        let mut live: Vec<usize> = (0..self.channels.len()).filter(lives).collect();
        let first = |i: &usize| self.source == Source::Function || self.same(*i).is_none();
        let distinct: Vec<usize> = live.iter().copied().filter(first).collect();
        if given.is_none_or(|n| n == distinct.len()) {
            live = distinct;
        }
        if live.is_empty() {
            let value = self.channels.first().map_or(0.0, |c| c.values[0]);
            let reason = format!("every channel is constant ({value}); there is nothing to measure");
            return Err(AuditError::refused(&self.what, reason));
        }
        Ok(live)
    }
}

/// A line at the end of an axis.
struct Line {
    /// Whether all of its values are the same.
    constant: bool,
    /// Whether the line beside it is farther from it than half of what the rest of the table spans.
    jumps: bool,
}

impl Line {
    /// The line at the first of two places of an axis, beside the second.
    fn of(size: &[usize], values: &[f64], axis: usize, [end, beside]: [usize; 2]) -> Line {
        let step: usize = size[..axis].iter().product();
        let along = |i: usize| i / step % size[axis];
        let (mut range, mut rest) = ([f64::INFINITY, f64::NEG_INFINITY], [f64::INFINITY, f64::NEG_INFINITY]);
        let (mut apart, mut count) = (0.0, 0);
        for (i, value) in values.iter().enumerate() {
            let own = if along(i) == end { &mut range } else { &mut rest };
            *own = [own[0].min(*value), own[1].max(*value)];
            if along(i) == beside {
                let at = if end < beside { i - step } else { i + step };
                (apart, count) = (apart + (value - values[at]).abs(), count + 1);
            }
        }
        Line { constant: range[0] == range[1], jumps: apart / f64::from(count) > 0.5 * (rest[1] - rest[0]) }
    }
}

/// Flat index of an index along every axis.
pub(super) fn flat(place: &[usize], size: &[usize]) -> usize {
    place.iter().zip(size).rev().fold(0, |sum, (i, n)| sum * n + i)
}
