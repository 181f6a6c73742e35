//! Colour maps and how values are spread over them; one place, so that the same colour means the
//! same everywhere.

use plotters::style::RGBColor;

use super::Scale;
use super::scale::{Spread, Tick, exponent};
use lobefit_math::numbers;

/// Entries of a colour map; odd, so that zero has an entry of its own in the signed maps.
pub(crate) const LEVELS: usize = 255;

/// Line colours that stay apart under colour-vision deficiency (Okabe and Ito 2008, without black
/// and yellow).
pub(crate) const LINES: [RGBColor; 7] = [
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x56, 0xB4, 0xE9),
    RGBColor(0x88, 0x22, 0x55),
];

/// Ten points of viridis (van der Walt and Smith 2015).
const VIRIDIS: [u32; 10] =
    [0x440154, 0x482878, 0x3E4A89, 0x31688E, 0x26828E, 0x1F9E89, 0x35B779, 0x6DCD59, 0xB4DE2C, 0xFDE725];

/// ColorBrewer's RdBu (Brewer 2003), reversed, its middle made white: blue below zero, red above.
const BLUE_WHITE_RED: [u32; 11] = [
    0x053061, 0x2166AC, 0x4393C3, 0x92C5DE, 0xD1E5F0, 0xFFFFFF, 0xFDDBC7, 0xF4A582, 0xD6604D, 0xB2182B,
    0x67001F,
];

/// As above with a grey middle: the furnace's walls.
const BLUE_GREY_RED: [u32; 7] = [0x053061, 0x2166AC, 0x7FA3CB, 0xC8C8C8, 0xE0906F, 0xB2182B, 0x67001F];

/// Radiance: linear grey, shown through the sRGB curve.
const RADIANCE: [u32; 9] =
    [0x000000, 0x636363, 0x898989, 0xA5A5A5, 0xBCBCBC, 0xCFCFCF, 0xE1E1E1, 0xF0F0F0, 0xFFFFFF];

/// What the colours of a picture mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shade {
    /// Magnitudes from `min` to `max`, dark to light.
    Magnitude {
        /// Value of the darkest colour.
        min: f64,
        /// Value of the lightest colour.
        max: f64,
        /// Linear or logarithmic.
        spread: Spread,
    },
    /// Signed values, blue below zero, white at zero, red above; `Root` spreads small values apart.
    Signed {
        /// Magnitude of the deepest colours.
        limit: f64,
        /// Linear, or by square root of the magnitude.
        spread: Spread,
    },
    /// Departure from the white environment (which is grey), blue for lost and red for gained
    /// energy.
    Departure {
        /// Departure of the deepest colours.
        limit: f64,
    },
    /// Radiance from black to `white`.
    Radiance {
        /// Radiance of white.
        white: f64,
    },
}

impl Shade {
    /// Index of the colour of a value in the palette, clamped to the ends.
    pub fn level(self, value: f64) -> u8 {
        (self.position(value) * (LEVELS - 1) as f64).round() as u8
    }

    /// Position in [0, 1] of a value on the colour bar.
    pub(crate) fn position(self, value: f64) -> f64 {
        match self {
            Shade::Magnitude { min, max, spread } => Scale { spread, min, max }.position(value),
            Shade::Signed { limit, spread } => {
                let half = Scale { spread, min: 0.0, max: limit }.position(value.abs()) / 2.0;
                if value < 0.0 { 0.5 - half } else { 0.5 + half }
            }
            Shade::Departure { limit } => {
                Scale { spread: Spread::Linear, min: -limit, max: limit }.position(value)
            }
            Shade::Radiance { white } => {
                Scale { spread: Spread::Linear, min: 0.0, max: white }.position(value)
            }
        }
    }

    /// Red, green and blue of the colours in turn, from the bar's lower end to its upper.
    pub fn palette(self) -> Vec<u8> {
        let stops: &[u32] = match self {
            Shade::Magnitude { .. } => &VIRIDIS,
            Shade::Signed { .. } => &BLUE_WHITE_RED,
            Shade::Departure { .. } => &BLUE_GREY_RED,
            Shade::Radiance { .. } => &RADIANCE,
        };
        (0..LEVELS).flat_map(|i| blend(stops, i as f64 / (LEVELS - 1) as f64)).collect()
    }

    /// Candidate ticks of the colour bar, the most wanted first.
    pub(crate) fn ticks(self) -> Vec<Tick> {
        let linear = |min, max| Scale { spread: Spread::Linear, min, max }.ticks(6);
        match self {
            Shade::Magnitude { min, max, spread } => Scale { spread, min, max }.ticks(6),
            Shade::Signed { limit, spread: Spread::Linear } | Shade::Departure { limit } => {
                linear(-limit, limit)
            }
            Shade::Signed { limit, .. } => rooted(limit),
            Shade::Radiance { white } => linear(0.0, white),
        }
    }
}

/// Zero, both ends, then 1-2-5 values downwards.
fn rooted(limit: f64) -> Vec<Tick> {
    let mut values = vec![0.0, limit, -limit];
    let top = exponent(limit);
    for e in (top - 4..=top).rev() {
        for m in [1, 5, 2] {
            let value: f64 = format!("{m}e{e}").parse().unwrap_or(limit);
            if value < limit {
                values.extend([value, -value]);
            }
        }
    }
    values.into_iter().map(|value| Tick { value, label: Some(numbers::tick(value)) }).collect()
}

/// Colour at `t` in [0, 1] between equally spaced stops.
fn blend(stops: &[u32], t: f64) -> [u8; 3] {
    let last = stops.len() - 1;
    let at = t * last as f64;
    let i = (at.floor() as usize).min(last - 1);
    let fraction = at - i as f64;
    [16, 8, 0].map(|shift| {
        let channel = |c: u32| f64::from((c >> shift) & 0xFF);
        (channel(stops[i]) * (1.0 - fraction) + channel(stops[i + 1]) * fraction).round() as u8
    })
}
