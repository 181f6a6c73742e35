//! From physical values to positions, with the ticks that people expect.

use crate::report::numbers;
use lobefit_math::ops;

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Evenly.
    Linear,
    /// By logarithm; values must be positive.
    Log,
    /// By square root; values must not be negative.
    Root,
}

/// A spread as the page's script names it.
pub(super) fn name(spread: Spread) -> &'static str {
    match spread {
        Spread::Linear => "linear",
        Spread::Log => "log",
        Spread::Root => "root",
    }
}

/// An axis: a spread over an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// How values are spread between the ends.
    pub spread: Spread,
    /// Value at the low end.
    pub min: f64,
    /// Value at the high end, above the low one.
    pub max: f64,
}

/// A tick: its value, its label (minor ticks have none).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: Option<String>,
}

impl Scale {
    /// The scale that holds all values, rounded outward to ticks (linear) or to decades, 2 and 5
    /// (log). Values are finite, one or more; for `Log` positive, for `Root` not negative.
    pub fn around(spread: Spread, values: impl Iterator<Item = f64> + Clone) -> Scale {
        let min = values.clone().fold(f64::INFINITY, f64::min);
        let max = values.fold(f64::NEG_INFINITY, f64::max);
        match spread {
            Spread::Log => {
                let (low, high) = (decade_below(min), decade_above(max));
                Scale { spread, min: low, max: if high > low { high } else { low * 10.0 } }
            }
            Spread::Root => {
                // An axis from 0 on would be empty for long.
                let min = if min < max && root(min) > EMPTY * root(max) { min } else { 0.0 };
                Scale { spread, min, max: if max > 0.0 { max * 1.04 } else { 1.0 } }
            }
            Spread::Linear => {
                // Differences below the digits of a label would give a row of equal labels.
                let span = (max - min).max(max.abs().max(min.abs()) * 1e-9);
                let span = if span > 0.0 { span } else { 0.1 };
                let step = nice_step(span, 6);
                Scale { spread, min: (min / step).floor() * step, max: (max / step).ceil() * step }.widened()
            }
        }
    }

    /// The scale with room beyond an end on which a value sits, so that a mark there is not cut by
    /// the frame.
    pub(crate) fn roomy(self, values: impl Iterator<Item = f64> + Clone) -> Scale {
        const ROOM: f64 = 0.05;
        let near = |end: f64| values.clone().any(|v| (self.position(v) - end).abs() < ROOM / 2.0);
        let (below, above) = (if near(0.0) { ROOM } else { 0.0 }, if near(1.0) { ROOM } else { 0.0 });
        let (min, max) = match self.spread {
            Spread::Log => {
                let span = ops::log(self.max / self.min);
                (self.min * ops::exp(-below * span), self.max * ops::exp(above * span))
            }
            Spread::Linear => {
                let span = self.max - self.min;
                (self.min - below * span, self.max + above * span)
            }
            Spread::Root => {
                let span = root(self.max) - root(self.min);
                let moved = |end: f64, by: f64| if by == 0.0 { end } else { square(root(end) + by * span) };
                (moved(self.min, -below), moved(self.max, above))
            }
        };
        Scale { spread: self.spread, min, max }
    }

    /// Position in [0, 1] of a value, clamped to the scale.
    pub(crate) fn position(self, x: f64) -> f64 {
        let t = match self.spread {
            Spread::Linear => (x - self.min) / (self.max - self.min),
            Spread::Log => {
                let (low, high) = (ops::log(self.min), ops::log(self.max));
                (ops::log(x.max(f64::MIN_POSITIVE)) - low) / (high - low)
            }
            Spread::Root => (root(x) - root(self.min)) / (root(self.max) - root(self.min)),
        };
        t.clamp(0.0, 1.0)
    }

    /// Ticks inside the scale; about `count` of them have labels.
    pub(crate) fn ticks(self, count: usize) -> Vec<Tick> {
        match self.spread {
            Spread::Linear => linear_ticks(self.min, self.max, count),
            Spread::Log => log_ticks(self.min, self.max, count),
            Spread::Root => self.root_ticks(count),
        }
    }

    /// Zero, then ones, fives, twos and others times powers of ten as far as they find room, in
    /// rising order.
    fn root_ticks(self, count: usize) -> Vec<Tick> {
        let apart = 0.8 / count.max(1) as f64;
        let top = exponent(self.max);
        let mut values: Vec<f64> = if self.min > 0.0 { Vec::new() } else { vec![0.0] };
        for m in [1, 5, 2, 3, 4, 8, 6] {
            for e in (top - 2..=top).rev() {
                let value: f64 = format!("{m}e{e}").parse().unwrap_or(0.0);
                let room = |known: &f64| (self.position(*known) - self.position(value)).abs() >= apart;
                // Beside tens a part of one, of operations say, is no value that anybody looks for.
                let whole = value >= 1.0 || self.max < 10.0;
                if whole && (self.min..=self.max).contains(&value) && values.iter().all(room) {
                    values.push(value);
                }
            }
        }
        values.sort_by(f64::total_cmp);
        if values.len() < 2 {
            return linear_ticks(self.min, self.max, count);
        }
        values.into_iter().map(|value| Tick { value, label: Some(numbers::tick(value)) }).collect()
    }

    /// A scale of positive length.
    fn widened(self) -> Scale {
        if self.max > self.min {
            self
        } else {
            Scale { max: self.min + self.min.abs().max(1.0) * 0.1, ..self }
        }
    }
}

/// Part of an axis by square root that may be empty before its first value.
const EMPTY: f64 = 0.2;

/// The root of a value, with its sign: room below 0 has positions too.
fn root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

/// The value with this root.
fn square(root: f64) -> f64 {
    root * root.abs()
}

/// Ticks at multiples of 1, 2, 2.5 or 5 times a power of ten: two at least, for one tells no scale.
fn linear_ticks(min: f64, max: f64, count: usize) -> Vec<Tick> {
    let tick = |value: f64| Tick { value, label: Some(numbers::tick(value)) };
    let multiples = |count: usize| {
        let step = nice_step(max - min, count);
        // A millionth of a step forgives the rounding of min and max.
        let (first, last) = ((min / step - 1e-6).ceil(), (max / step + 1e-6).floor());
        let inside = (last - first).max(-1.0) + 1.0;
        (0..inside as usize).map(|i| tick((first + i as f64) * step)).collect::<Vec<Tick>>()
    };
    // A step of at most a third of the axis has two multiples in it.
    let enough = (count..=count.max(1) + 6).map(multiples).find(|ticks| ticks.len() > 1);
    // The axis is a single value.
    enough.unwrap_or_else(|| vec![tick(min)])
}

/// Decades with labels, thinned to about `count`; 2..9 without, or 2 and 5 labelled where decades
/// are few.
fn log_ticks(min: f64, max: f64, count: usize) -> Vec<Tick> {
    let low = exponent(min * (1.0 + 1e-9));
    let high = exponent(max * (1.0 + 1e-9));
    let decades = (high - low).max(1) as usize;
    let every = decades.div_ceil(count.max(1)) as i32;
    let inside = |v: f64| v >= min * (1.0 - 1e-9) && v <= max * (1.0 + 1e-9);
    // One notation along an axis: powers where plain numbers would not do for all of it.
    let plain = low >= -3 && high <= 4;
    let label = |v: f64| if plain || v == 1.0 { numbers::tick(v) } else { numbers::power_of_ten(v) };
    let mut ticks = Vec::new();
    for e in low..=high {
        for m in 1..10 {
            let value: f64 = format!("{m}e{e}").parse().unwrap_or(f64::NAN);
            let labelled = (m == 1 && (e - low) % every == 0) || (decades <= 2 && (m == 2 || m == 5));
            if inside(value) && (m == 1 || decades <= 8) {
                ticks.push(Tick { value, label: labelled.then(|| label(value)) });
            }
        }
    }
    // A part of a decade may hold one of these, or none.
    if ticks.iter().filter(|tick| tick.label.is_some()).count() < 2 {
        ticks.iter_mut().for_each(|tick| tick.label = Some(label(tick.value)));
    }
    if ticks.len() < 2 { linear_ticks(min, max, count) } else { ticks }
}

/// The step of 1, 2, 2.5 or 5 times a power of ten that gives at most `count` intervals.
fn nice_step(span: f64, count: usize) -> f64 {
    let raw = span / count.max(1) as f64;
    let e = exponent(raw);
    for m in ["1", "2", "2.5", "5", "10"] {
        let step: f64 = format!("{m}e{e}").parse().unwrap_or(raw);
        if step >= raw * (1.0 - 1e-9) {
            return step;
        }
    }
    raw
}

/// Decimal exponent of a positive finite number, exactly, from its decimal form.
pub(crate) fn exponent(x: f64) -> i32 {
    let text = format!("{x:e}");
    text.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

/// The next of 1, 2, 5 times a power of ten at or below `x`.
fn decade_below(x: f64) -> f64 {
    let e = exponent(x);
    [format!("5e{e}"), format!("2e{e}"), format!("1e{e}")]
        .iter()
        .filter_map(|t| t.parse().ok())
        .find(|&v: &f64| v <= x)
        .unwrap_or(x)
}

/// The next of 1, 2, 5 times a power of ten at or above `x`.
fn decade_above(x: f64) -> f64 {
    let e = exponent(x);
    [format!("1e{e}"), format!("2e{e}"), format!("5e{e}")]
        .iter()
        .filter_map(|t| t.parse().ok())
        .find(|&v: &f64| v >= x)
        .unwrap_or_else(|| format!("1e{}", e + 1).parse().unwrap_or(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers() {
        let labels =
            |s: Scale, n| -> Vec<String> { s.ticks(n).into_iter().filter_map(|t| t.label).collect() };
        let linear = Scale { spread: Spread::Linear, min: 0.02, max: 1.0 };
        assert_eq!(labels(linear, 5), ["0.2", "0.4", "0.6", "0.8", "1"]);
        let log = Scale { spread: Spread::Log, min: 1e-3, max: 0.2 };
        assert_eq!(labels(log, 5), ["0.001", "0.002", "0.005", "0.01", "0.02", "0.05", "0.1", "0.2"]);
    }

    #[test]
    fn an_axis_has_two_ticks_at_least() {
        for (spread, min, max, wanted) in [
            (Spread::Linear, 0.02, 0.33, &["0.1", "0.2", "0.3"][..]),
            (Spread::Linear, 0.1, 0.26, &["0.1", "0.2"]),
            (Spread::Log, 0.15, 0.45, &["0.2", "0.3", "0.4"]),
            (Spread::Log, 0.21, 0.29, &["0.22", "0.24", "0.26", "0.28"]),
        ] {
            let ticks = Scale { spread, min, max }.ticks(2).into_iter();
            let labels: Vec<String> = ticks.filter_map(|tick| tick.label).collect();
            assert_eq!(labels, wanted, "{spread:?} {min} {max}");
        }
    }

    #[test]
    fn a_root_axis_has_ticks_at_any_size() {
        for max in [0.7, 3.0, 56.0, 1584.0] {
            let scale = Scale::around(Spread::Root, [max].into_iter());
            let labels: Vec<String> = scale.ticks(10).into_iter().filter_map(|t| t.label).collect();
            assert!((5..=11).contains(&labels.len()), "{max}: {labels:?}");
        }
        let scale = Scale { spread: Spread::Root, min: 0.0, max: 56.0 };
        let labels: Vec<String> = scale.ticks(10).into_iter().filter_map(|t| t.label).collect();
        assert_eq!(labels, ["0", "1", "5", "10", "20", "30", "40", "50"]);
        let fine: Vec<String> = scale.ticks(15).into_iter().filter_map(|t| t.label).collect();
        assert_eq!(fine[..3], ["0", "1", "2"], "whole operations alone");
    }

    #[test]
    fn an_axis_by_root_begins_near_its_first_value() {
        let late = [3.0, 4.0, 5.0, 12.0];
        let scale = Scale::around(Spread::Root, late.into_iter()).roomy(late.into_iter());
        assert!((0.03..0.1).contains(&scale.position(3.0)), "{scale:?}");
        let labels: Vec<String> = scale.ticks(10).into_iter().filter_map(|t| t.label).collect();
        assert_eq!((labels[0].as_str(), labels.last().map(String::as_str)), ("3", Some("10")));
        let early = [1.0, 60.0];
        assert_eq!(Scale::around(Spread::Root, early.into_iter()).min, 0.0);
        let one_tick = [41.0, 43.0, 48.0];
        let scale = Scale::around(Spread::Root, one_tick.into_iter());
        assert!(scale.ticks(10).len() > 1, "{:?}", scale.ticks(10));
    }

    #[test]
    fn a_value_on_the_frame_gets_room() {
        for spread in [Spread::Linear, Spread::Log, Spread::Root] {
            let values = [0.01, 0.4, 1.0];
            let scale = Scale { spread, min: 0.01, max: 2.0 };
            let roomy = scale.roomy(values.iter().copied());
            assert!(roomy.position(0.01) > 0.03, "{roomy:?}");
            assert_eq!(roomy.max, 2.0, "nothing sits at the upper end");
        }
    }

    #[test]
    fn a_scale_holds_its_values() {
        let values = [3.2, 3.2];
        for spread in [Spread::Linear, Spread::Log, Spread::Root] {
            let scale = Scale::around(spread, values.iter().copied());
            assert!(scale.min <= 3.2 && scale.max >= 3.2 && scale.min < scale.max, "{scale:?}");
        }
    }
}
