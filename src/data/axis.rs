//! Table axes: which physical value a texel stands for, and where a lookup finds it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where texel i samples its axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Registration {
    /// u = (i + 0.5) / n: what a texture unit does with a normalised coordinate.
    Centre,
    /// u = i / (n - 1): the ends of the axis are texels; a shader remaps u to (u (n-1) + 0.5) / n.
    Endpoint,
}

impl Registration {
    /// The word used in headers and the manifest.
    pub fn name(self) -> &'static str {
        match self {
            Registration::Centre => "centre",
            Registration::Endpoint => "endpoint",
        }
    }

    /// Unit coordinate of texel `i` of `n`.
    pub fn coordinate(self, i: usize, n: usize) -> f64 {
        match self {
            Registration::Centre => (i as f64 + 0.5) / n as f64,
            Registration::Endpoint => i as f64 / (n - 1) as f64,
        }
    }
}

/// The formula of the unit texture coordinate from the physical variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
pub enum Warp {
    /// u = (x - min) / (max - min).
    #[serde(rename = "linear")]
    Linear,
    /// u = sqrt(mu): texels dense at grazing angles.
    #[serde(rename = "sqrt")]
    Sqrt,
    /// u = sqrt(mu (1 + alpha) / (mu + alpha)): resolves the layer mu ~ alpha, where the albedo of a smooth lobe
    /// depends on mu/alpha alone, at every roughness.
    #[serde(rename = "homogeneous")]
    Homogeneous,
}

/// One axis of a table. The first axis is the texture's x (columns), the second its y (rows, first row at the top).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Physical variable: `mu`, `roughness`, ...
    pub name: String,
    /// Number of texels.
    pub size: usize,
    /// Where texel i samples the axis.
    pub registration: Registration,
    /// Texture coordinate from the physical variables.
    pub warp: Warp,
    /// Physical value at u = 0.
    pub min: f64,
    /// Physical value at u = 1.
    pub max: f64,
}

impl Axis {
    /// Physical value at unit coordinate `u`, the inverse of the warp.
    pub fn physical(&self, u: f64, alpha: f64) -> f64 {
        match self.warp {
            Warp::Linear => self.min + u * (self.max - self.min),
            Warp::Sqrt => u * u,
            // u^2 (x + alpha) = x (1 + alpha)
            Warp::Homogeneous => alpha * u * u / ((1.0 - u * u) + alpha),
        }
    }

    /// The formula of the unit coordinate from the physical variables, as written in headers and the manifest.
    pub fn formula(&self) -> String {
        let Axis { name, min, max, .. } = self;
        match self.warp {
            Warp::Linear if (*min, *max) == (0.0, 1.0) => format!("u = {name}"),
            Warp::Linear => format!("u = ({name} - {min}) / ({max} - {min})"),
            Warp::Sqrt => format!("u = sqrt({name})"),
            Warp::Homogeneous => format!("u = sqrt({name} * (1 + alpha) / ({name} + alpha))"),
        }
    }

    /// Scale and offset, in f32, that a shader applies to get the texture coordinate: to the physical value itself on a linear
    /// axis, else to the warped unit coordinate. With end points registered, u = 0 is the first texel's centre.
    pub fn affine(&self) -> (f32, f32) {
        let n = self.size as f64;
        let (scale, offset) = match self.registration {
            Registration::Centre => (1.0, 0.0),
            Registration::Endpoint => ((n - 1.0) / n, 0.5 / n),
        };
        if self.warp != Warp::Linear {
            return (scale as f32, offset as f32);
        }
        let scale = scale / (self.max - self.min);
        (scale as f32, (offset - scale * self.min) as f32)
    }

    /// The texture coordinate in a shader's arithmetic.
    pub fn texture_coordinate(&self, x: f32, alpha: f32) -> f32 {
        let unit = match self.warp {
            Warp::Linear => x,
            Warp::Sqrt => x.sqrt(),
            Warp::Homogeneous => (x * (1.0 + alpha) / (x + alpha)).sqrt(),
        };
        match self.affine() {
            (1.0, 0.0) => unit,
            (scale, offset) => unit * scale + offset,
        }
    }

    /// Physical value of texel `i`.
    pub fn node(&self, i: usize, alpha: f64) -> f64 {
        self.physical(self.registration.coordinate(i, self.size), alpha)
    }
}
