//! From physical values to positions, with the ticks that people expect.

use lobefit_math::numbers;
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
pub(crate) fn name(spread: Spread) -> &'static str {
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
pub struct Tick {
    /// Where it stands.
    pub value: f64,
    /// What is written beside it.
    pub label: Option<String>,
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
    pub fn roomy(self, values: impl Iterator<Item = f64> + Clone) -> Scale {
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
    pub fn position(self, x: f64) -> f64 {
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
    pub fn ticks(self, count: usize) -> Vec<Tick> {
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
