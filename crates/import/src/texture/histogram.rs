//! How often each value of a channel is there: extremes and quantiles need no more.

use super::Extremes;

/// Counts of the values of red, green, blue and alpha.
pub(super) struct Histogram {
    channels: [Vec<u64>; 4],
    /// The value that stands for 1.
    largest: usize,
}

impl Histogram {
    /// Values of 8 bits, or of 16 where `is_wide`.
    pub fn new(is_wide: bool) -> Histogram {
        let largest = if is_wide { 0xffff } else { 0xff };
        Histogram { channels: std::array::from_fn(|_| vec![0; largest + 1]), largest }
    }

    /// Counts texels of `samples` values each: grey, grey and alpha, RGB, RGB and alpha. Values of 16
    /// bits have their high byte first.
    pub fn count_texels(&mut self, row: &[u8], samples: usize) {
        let (wide, opaque) = (self.largest > 0xff, self.largest);
        let bytes = if wide { 2 } else { 1 };
        for texel in row.chunks_exact(samples * bytes) {
            let value = |k: usize| match wide {
                true => usize::from(texel[2 * k]) << 8 | usize::from(texel[2 * k + 1]),
                false => usize::from(texel[k]),
            };
            let values = match samples {
                1 => [value(0), value(0), value(0), opaque],
                2 => [value(0), value(0), value(0), value(1)],
                3 => [value(0), value(1), value(2), opaque],
                _ => [value(0), value(1), value(2), value(3)],
            };
            for (counts, value) in self.channels.iter_mut().zip(values) {
                counts[value] += 1;
            }
        }
    }

    /// Texels that were counted.
    pub fn count(&self) -> u64 {
        self.channels[0].iter().sum()
    }

    /// The extremes of each channel, and those without the share `quantile` at each end. Of no texel
    /// they are those of any.
    pub fn extremes(&self, quantile: f64) -> [Extremes; 4] {
        let dropped = (self.count() as f64 * quantile).floor() as u64;
        let value = |at: usize| at as f64 / self.largest as f64;
        let ends = |counts: &[u64], dropped: u64| {
            let beyond = |at: &usize, seen: &mut u64| {
                *seen += counts[*at];
                *seen > dropped
            };
            let (mut below, mut above) = (0, 0);
            let low = (0..counts.len()).find(|at| beyond(at, &mut below));
            let high = (0..counts.len()).rev().find(|at| beyond(at, &mut above));
            [low.map_or(0.0, value), high.map_or(1.0, value)]
        };
        std::array::from_fn(|k| Extremes {
            kept: ends(&self.channels[k], dropped),
            all: ends(&self.channels[k], 0),
        })
    }
}
