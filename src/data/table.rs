//! A sampled quantity: axes, channels, texels.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AlphaMap, Axis, Registration, Smith, Warp};

/// How a texel is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TexelFormat {
    /// 8-bit integers / 255: numbers in [0, 1].
    Unorm8,
    /// 16-bit integers / 65535: numbers in [0, 1], in the bytes of a half with a step of 1.5e-5.
    Unorm16,
    /// IEEE half.
    F16,
    /// IEEE single.
    F32,
}

impl TexelFormat {
    /// The word used in file names, headers and the manifest.
    pub fn name(self) -> &'static str {
        match self {
            TexelFormat::Unorm8 => "unorm8",
            TexelFormat::Unorm16 => "unorm16",
            TexelFormat::F16 => "f16",
            TexelFormat::F32 => "f32",
        }
    }

    /// Bytes of one channel of one texel.
    pub fn bytes(self) -> u64 {
        match self {
            TexelFormat::Unorm8 => 1,
            TexelFormat::Unorm16 | TexelFormat::F16 => 2,
            TexelFormat::F32 => 4,
        }
    }

    /// The largest integer of a format of integers.
    pub fn steps(self) -> Option<f64> {
        match self {
            TexelFormat::Unorm8 => Some(255.0),
            TexelFormat::Unorm16 => Some(65535.0),
            TexelFormat::F16 | TexelFormat::F32 => None,
        }
    }

    /// The value as stored and read back: of a format of integers the nearest in [0, 1], and what is
    /// not finite as it is.
    pub fn quantise(self, x: f64) -> f64 {
        if let (Some(steps), true) = (self.steps(), x.is_finite()) {
            return (x.clamp(0.0, 1.0) * steps).round() / steps;
        }
        match self {
            TexelFormat::F16 => half::f16::from_f64(x).to_f64(),
            TexelFormat::F32 => f64::from(x as f32),
            TexelFormat::Unorm8 | TexelFormat::Unorm16 => x,
        }
    }

    /// Appends a number as it is stored, little-endian: of a format of integers the nearest in [0, 1].
    pub fn write(self, x: f64, bytes: &mut Vec<u8>) {
        match self {
            TexelFormat::Unorm8 => bytes.push((255.0 * x).round() as u8),
            TexelFormat::Unorm16 => bytes.extend(((65535.0 * x).round() as u16).to_le_bytes()),
            TexelFormat::F16 => bytes.extend(half::f16::from_f64(x).to_le_bytes()),
            TexelFormat::F32 => bytes.extend((x as f32).to_le_bytes()),
        }
    }

    /// The numbers that are stored in these bytes.
    pub fn read(self, bytes: &[u8]) -> Vec<f64> {
        match self {
            TexelFormat::Unorm8 => bytes.iter().map(|b| f64::from(*b) / 255.0).collect(),
            TexelFormat::Unorm16 => {
                bytes.as_chunks().0.iter().map(|b| f64::from(u16::from_le_bytes(*b)) / 65535.0).collect()
            }
            TexelFormat::F16 => {
                bytes.as_chunks().0.iter().map(|b| half::f16::from_le_bytes(*b).to_f64()).collect()
            }
            TexelFormat::F32 => bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b).into()).collect(),
        }
    }
}

/// One channel: its name in the file and its texels, the first axis fastest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Channel {
    /// Name in the file.
    pub name: String,
    /// As many values as the product of the axes' sizes.
    pub texels: Vec<f64>,
}

impl Channel {
    /// A channel of these texels.
    pub fn new(name: &str, texels: Vec<f64>) -> Channel {
        Channel { name: name.into(), texels }
    }
}

impl Axis {
    /// An axis whose ends are texels.
    pub fn ends(name: &str, size: usize, warp: Warp, [min, max]: [f64; 2]) -> Axis {
        Axis { name: name.into(), size, registration: Registration::Endpoint, warp, min, max }
    }
}

/// Most axes of a table. Those beyond the three of a texture lie one behind the other along its slices.
pub const AXES: usize = 5;

/// A table: columns along `axes[0]`, rows along `axes[1]`, slices along `axes[2]`, as far as there
/// are axes; those beyond vary slower, the last one slowest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Name, `ggx-dfg-...`.
    pub name: String,
    /// Quantity it samples.
    pub quantity: String,
    /// Shadowing form, of a quantity that has it.
    pub smith: Option<Smith>,
    /// How roughness becomes alpha on its roughness axis.
    pub alpha_map: AlphaMap,
    /// One to [`AXES`], the fastest first.
    pub axes: Vec<Axis>,
    /// Channels, all of the same size.
    pub channels: Vec<Channel>,
    /// How a texel is stored.
    pub format: TexelFormat,
}

/// A table whose shape contradicts itself or whose texels are not finite.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A channel's texel count is not the product of the axes' sizes.
    #[error("table {table}: channel {channel} has {found} texels, its axes call for {expected}")]
    Shape {
        /// Table's name.
        table: String,
        /// Channel's name.
        channel: String,
        /// Texels found.
        found: usize,
        /// Texels called for.
        expected: usize,
    },
    /// No axis, more than a table has, or an axis without texels.
    #[error("table {table}: axes of sizes {sizes:?}; a table has one to {AXES} axes, each with texels")]
    Axes {
        /// Table's name.
        table: String,
        /// Sizes of its axes.
        sizes: Vec<usize>,
    },
    /// A texel is NaN or infinite.
    #[error("table {table}: channel {channel}, texel {texel:?}: value {value} is not finite")]
    NotFinite {
        /// Table's name.
        table: String,
        /// Channel's name.
        channel: String,
        /// The texel along each axis.
        texel: Vec<usize>,
        /// Its value.
        value: f64,
    },
}

impl Table {
    /// Checks that every channel has the axes' size and finite texels.
    pub fn validate(&self) -> Result<(), TableError> {
        let sizes: Vec<usize> = self.axes.iter().map(|a| a.size).collect();
        if !(1..=AXES).contains(&sizes.len()) || sizes.contains(&0) {
            return Err(TableError::Axes { table: self.name.clone(), sizes });
        }
        let expected = sizes.iter().product();
        for channel in &self.channels {
            if channel.texels.len() != expected {
                return Err(TableError::Shape {
                    table: self.name.clone(),
                    channel: channel.name.clone(),
                    found: channel.texels.len(),
                    expected,
                });
            }
            if let Some(i) = channel.texels.iter().position(|t| !t.is_finite()) {
                return Err(TableError::NotFinite {
                    table: self.name.clone(),
                    channel: channel.name.clone(),
                    texel: self.place(i),
                    value: channel.texels[i],
                });
            }
        }
        Ok(())
    }

    /// Where texel `i` of a channel lies along each axis.
    pub fn place(&self, mut i: usize) -> Vec<usize> {
        let along = |axis: &Axis| {
            let at = i % axis.size;
            i /= axis.size;
            at
        };
        self.axes.iter().map(along).collect()
    }

    /// Width, height and depth of the texture: 1 along an axis that the table does not have; the depth holds
    /// all axes from the third on, the third fastest.
    pub fn size(&self) -> [usize; 3] {
        let size = |k: usize| self.axes.get(k).map_or(1, |axis| axis.size);
        [size(0), size(1), self.axes.iter().skip(2).map(|axis| axis.size).product()]
    }

    /// Bytes of all texels.
    pub fn bytes(&self) -> u64 {
        self.channels.iter().map(|c| c.texels.len() as u64).sum::<u64>() * self.format.bytes()
    }

    /// The table with every texel rounded to its format.
    pub fn quantised(&self) -> Table {
        let mut out = self.clone();
        for channel in &mut out.channels {
            for texel in &mut channel.texels {
                *texel = self.format.quantise(*texel);
            }
        }
        out
    }
}
