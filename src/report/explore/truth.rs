//! The truth as texels, which the page interpolates.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};

/// Texels along the view.
pub const SIDE: usize = 64;

/// Texels along a roughness of one value: as many as the interpolation reads.
pub const ROWS: usize = 4;

/// The truth over roughness and mu. Row j lies at roughness `low + (high - low) (j/(rows - 1))^2`,
/// for narrow lobes change fastest; column i where `across` is i/(columns - 1). Between texels the
/// page takes cubics through the four nearest along each axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruthTexels {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Range of roughness.
    pub roughness: [f64; 2],
    /// Range of mu.
    pub mu: [f64; 2],
    /// Values of the 16-bit numbers 0 and 65535, of each channel.
    pub ranges: Vec<[f64; 2]>,
    /// Base64 of the numbers, little endian, channels side by side, columns fastest.
    pub data: String,
    /// Largest error of the interpolated channels that was measured, half way between texels.
    pub error: f64,
}

impl TruthTexels {
    /// Texels of channels, columns fastest; the error is still to be measured.
    pub fn new([roughness, mu]: [[f64; 2]; 2], size: [usize; 2], channels: &[Vec<f64>]) -> TruthTexels {
        let ranges: Vec<[f64; 2]> = channels.iter().map(|channel| range(channel)).collect();
        let whole = |value: f64, [low, high]: [f64; 2]| {
            // the conversion of a float saturates at both ends
            if low < high { ((value - low) / (high - low) * STEPS).round() as u16 } else { 0 }
        };
        let mut bytes = Vec::new();
        for texel in 0..size[0] * size[1] {
            for (channel, range) in channels.iter().zip(&ranges) {
                bytes.extend(whole(channel[texel], *range).to_le_bytes());
            }
        }
        TruthTexels { size, roughness, mu, ranges, data: STANDARD.encode(bytes), error: 0.0 }
    }

    /// The values of the texels as they are stored, channel by channel.
    pub fn values(channels: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let stored = |channel: &Vec<f64>| {
            let [low, high] = range(channel);
            let step = (high - low) / STEPS;
            let at = |value: &f64| if step > 0.0 { low + ((value - low) / step).round() * step } else { low };
            channel.iter().map(at).collect()
        };
        channels.iter().map(stored).collect()
    }
}

const STEPS: f64 = 65_535.0;

fn range(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(*v), high.max(*v)])
}

/// The column of a view, from 0 to 1: half of it in the coordinate that resolves the layer mu ~
/// alpha at every width, half of it in sqrt(mu) for what lies beyond the layer.
pub fn across(mu: f64, [low, high]: [f64; 2], alpha: f64) -> f64 {
    let layer = |mu: f64| (mu * (1.0 + alpha) / (mu + alpha)).sqrt();
    let part = |of: &dyn Fn(f64) -> f64| (of(mu) - of(low)) / (of(high) - of(low));
    0.5 * part(&layer) + 0.5 * part(&f64::sqrt)
}

/// The view at a column, by bisection.
pub fn view(column: f64, [low, high]: [f64; 2], alpha: f64) -> f64 {
    let mut ends = [low, high];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (ends[0] + ends[1]);
        ends[usize::from(across(middle, [low, high], alpha) >= column)] = middle;
    }
    0.5 * (ends[0] + ends[1])
}

/// Below the rounding of an f64.
const HALVINGS: usize = 60;

/// The value of texels at a place counted in texels along each axis, as `explore.glsl` takes it.
pub fn between(texels: &[f64], size: [usize; 2], place: [f64; 2]) -> f64 {
    let [(column, across), (row, along)] = [0, 1].map(|axis| weights(place[axis], size[axis]));
    let of_row = |j: usize| -> f64 {
        let start = (row + j) * size[0] + column;
        across.iter().zip(&texels[start..]).map(|(weight, texel)| weight * texel).sum()
    };
    along.iter().enumerate().map(|(j, weight)| weight * of_row(j)).sum()
}

/// The first of four texels around a place, and Lagrange's weights of a cubic through them.
fn weights(place: f64, texels: usize) -> (usize, [f64; 4]) {
    let first = (place.floor() - 1.0).clamp(0.0, (texels - 4) as f64);
    let q = place - first;
    let [a, b, c] = [q - 1.0, q - 2.0, q - 3.0];
    (first as usize, [-a * b * c / 6.0, q * b * c / 2.0, -q * a * c / 2.0, q * a * b / 6.0])
}
