//! How the levels of a prefiltered chain hold roughness.

use serde::{Deserialize, Serialize};

use lobefit_math::ops;

/// A published map of roughness r in [0, 1] to a level, of chains whose last level is `count - 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum MipMap {
    /// r (count - 1).
    #[serde(rename = "linear")]
    Linear,
    /// r (2 - r) (count - 1): Filament.
    #[serde(rename = "r(2-r)")]
    Steep,
    /// r (1.7 - 0.7 r) (count - 1): Unity.
    #[serde(rename = "r(1.7-0.7r)")]
    Steeper,
    /// count - 2 + 1.2 log2 r, at least 0: Unreal, whose last level but one has roughness 1.
    #[serde(rename = "log")]
    Log,
}

/// Levels for a factor of 2 of roughness, in a logarithmic chain.
pub const LOG_SCALE: f64 = 1.2;

/// Roughness below which a logarithmic chain does not look: that of the shader that it is from.
pub const LOG_FROM: f64 = 1e-3;

impl MipMap {
    /// The word used in scenes.
    pub fn name(self) -> &'static str {
        match self {
            MipMap::Linear => "linear",
            MipMap::Steep => "r(2-r)",
            MipMap::Steeper => "r(1.7-0.7r)",
            MipMap::Log => "log",
        }
    }

    /// What stands for it in the names of functions.
    pub fn identifier(self) -> &'static str {
        match self {
            MipMap::Linear => "linear",
            MipMap::Steep => "quadratic_2",
            MipMap::Steeper => "quadratic_17",
            MipMap::Log => "log",
        }
    }
}

/// A chain of prefiltered levels.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MipChain {
    /// By a published map.
    Mapped {
        /// The map.
        map: MipMap,
        /// Number of levels, at least 2; of a logarithmic chain at least 3.
        count: u32,
    },
    /// By the roughness of every level, strictly increasing in [0, 1], at least two; between levels
    /// it is interpolated linearly.
    Given(Vec<f64>),
}

impl MipChain {
    /// In words.
    pub fn text(&self) -> String {
        match self {
            MipChain::Mapped { map, count } => format!("{} over {count} levels", map.name()),
            MipChain::Given(levels) => {
                let levels: Vec<String> = levels.iter().map(f64::to_string).collect();
                format!("levels of roughness {}", levels.join(", "))
            }
        }
    }

    /// Number of levels.
    pub fn count(&self) -> usize {
        match self {
            MipChain::Mapped { count, .. } => *count as usize,
            MipChain::Given(levels) => levels.len(),
        }
    }

    /// The level of the widest lobe.
    pub fn widest(&self) -> f64 {
        let last = self.count() as f64 - 1.0;
        if matches!(self, MipChain::Mapped { map: MipMap::Log, .. }) { last - 1.0 } else { last }
    }

    /// The level that holds a roughness, in [0, [`MipChain::widest`]]; roughness that no level
    /// holds is that of the nearest.
    pub fn level(&self, roughness: f64) -> f64 {
        let r = roughness.clamp(0.0, 1.0);
        let last = self.count() as f64 - 1.0;
        match self {
            MipChain::Mapped { map: MipMap::Linear, .. } => r * last,
            MipChain::Mapped { map: MipMap::Steep, .. } => r * (2.0 - r) * last,
            MipChain::Mapped { map: MipMap::Steeper, .. } => r * (1.7 - 0.7 * r) * last,
            MipChain::Mapped { map: MipMap::Log, .. } => {
                (last - 1.0 + LOG_SCALE * ops::log2(r.max(LOG_FROM))).max(0.0)
            }
            MipChain::Given(levels) => {
                levels.windows(2).map(|pair| ((r - pair[0]) / (pair[1] - pair[0])).clamp(0.0, 1.0)).sum()
            }
        }
    }

    /// The roughness of a level, which is clamped to [0, [`MipChain::widest`]]: the inverse of
    /// [`MipChain::level`].
    pub fn roughness(&self, level: f64) -> f64 {
        let level = level.clamp(0.0, self.widest());
        let part = level / (self.count() as f64 - 1.0);
        match self {
            MipChain::Mapped { map: MipMap::Linear, .. } => part,
            // the roots of the quadratics, without their cancellation at 0
            MipChain::Mapped { map: MipMap::Steep, .. } => part / (1.0 + (1.0 - part).sqrt()),
            MipChain::Mapped { map: MipMap::Steeper, .. } => 2.0 * part / (1.7 + (2.89 - 2.8 * part).sqrt()),
            MipChain::Mapped { map: MipMap::Log, .. } => ops::exp2((level - self.widest()) / LOG_SCALE),
            MipChain::Given(levels) => {
                let step =
                    |(i, pair): (usize, &[f64])| (pair[1] - pair[0]) * (level - i as f64).clamp(0.0, 1.0);
                levels[0] + levels.windows(2).enumerate().map(step).sum::<f64>()
            }
        }
    }
}
