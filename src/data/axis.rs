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

    /// Unit coordinate of a position along `n` texels: texel i is at i.
    pub fn coordinate(self, position: f64, n: usize) -> f64 {
        match self {
            Registration::Centre => (position + 0.5) / n as f64,
            Registration::Endpoint => position / (n - 1).max(1) as f64,
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
    /// u = sqrt(mu (1 + alpha) / (mu + alpha)): resolves the layer mu ~ alpha, where the albedo of
    /// a smooth lobe depends on mu/alpha alone, at every roughness.
    #[serde(rename = "homogeneous")]
    Homogeneous,
    /// u = sqrt(mu (1 + l) / (mu + l)), l = alpha + 3 sqrt(ior - 1): the layer mu ~ alpha of a
    /// rough interface together with the onset of total internal reflection, which near ior = 1
    /// lies at mu = sqrt(2 (ior - 1)) and would else wander across the columns from slice to slice.
    #[serde(rename = "homogeneous-ior")]
    HomogeneousIor,
    /// [`Warp::Homogeneous`] in the alpha towards the view, alpha_v = sqrt(alpha_x^2 cos^2
    /// phi + alpha_y^2 sin^2 phi), with alpha_x = alpha/aspect, alpha_y = alpha aspect and
    /// aspect^2 = 1 - 0.9 anisotropy: the width in Smith's Lambda of the view.
    #[serde(rename = "homogeneous-azimuth")]
    HomogeneousAzimuth,
    /// u = anisotropy^2, scaled: the path tracer's axis, whose slice z of n has the aspect
    /// sqrt(1 - 0.9 sqrt(z/n)).
    #[serde(rename = "square")]
    Square,
    /// The axis of ior: with r = sqrt(ior - min), R = sqrt(max - min) and c = 0.001 + 0.55
    /// sqrt(alpha), u = (sqrt(r (R + c)/(R (r + c)) + 0.01) - 0.1)/(sqrt(1.01) - 0.1). Slices crowd
    /// at min = 1, where a lobe changes as soon as its refraction, ior - 1, is comparable with mu;
    /// the smoother the surface, the sooner.
    #[serde(rename = "ior")]
    Ior,
    /// u = sqrt(1 - mu), from min 1 to max 0: the axis of linearly transformed cosines.
    #[serde(rename = "grazing")]
    Grazing,
    /// The axis of anisotropy, linear in the aspect alpha_y/alpha = alpha/alpha_x = sqrt(1 - 0.9
    /// anisotropy).
    #[serde(rename = "aspect")]
    Aspect,
}

impl Warp {
    /// Every warp, in the order of the declaration.
    pub const ALL: [Warp; 9] = [
        Warp::Linear,
        Warp::Sqrt,
        Warp::Homogeneous,
        Warp::HomogeneousIor,
        Warp::HomogeneousAzimuth,
        Warp::Square,
        Warp::Ior,
        Warp::Grazing,
        Warp::Aspect,
    ];

    /// Its function in `warps.wgsl`.
    pub(super) fn function(self) -> &'static str {
        match self {
            Warp::Linear => "linear",
            Warp::Sqrt => "root",
            Warp::Homogeneous => "homogeneous",
            Warp::HomogeneousIor => "homogeneous_ior",
            Warp::HomogeneousAzimuth => "homogeneous_azimuth",
            Warp::Square => "square",
            Warp::Ior => "layered",
            Warp::Grazing => "grazing",
            Warp::Aspect => "aspect",
        }
    }
}

/// The variables of other axes that a warp may use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<T> {
    /// GGX width, the geometric mean of alpha_x and alpha_y; >= 0.
    pub alpha: T,
    /// Index of refraction, n_inside/n_outside >= 1; 1 where the quantity has none.
    pub ior: T,
    /// Anisotropy in [0, 1]; 0 where the quantity has none.
    pub anisotropy: T,
    /// Square of the cosine of the view's azimuth from the alpha_x axis; 1 where the table does not
    /// resolve the azimuth.
    pub cos2_phi: T,
}

impl Surface<f64> {
    /// A surface without an index of refraction.
    pub fn rough(alpha: f64) -> Surface<f64> {
        Surface { alpha, ior: 1.0, anisotropy: 0.0, cos2_phi: 1.0 }
    }

    /// alpha towards the view.
    fn towards(self) -> f64 {
        let q = 1.0 - SQUASH * self.anisotropy;
        self.alpha * (self.cos2_phi / q + (1.0 - self.cos2_phi) * q).sqrt()
    }
}

impl Surface<f32> {
    /// A surface without an index of refraction.
    pub fn rough(alpha: f32) -> Surface<f32> {
        Surface { alpha, ior: 1.0, anisotropy: 0.0, cos2_phi: 1.0 }
    }
}

/// Width of the onset of total internal reflection in [`Warp::HomogeneousIor`], in units of
/// sqrt(ior - 1). Empirical, as are the constants of [`Warp::Ior`]: the best of a scan of the
/// lookup's error over alpha in [0.02, 1] and ior in [1, 2].
const ONSET: f64 = 3.0;

/// c of [`Warp::Ior`] is `LAYER[0] + LAYER[1] sqrt(alpha)`; the first term only keeps 0/0 away from
/// alpha = 0.
const LAYER: [f64; 2] = [0.001, 0.55];

/// sqrt of the term that keeps the first slices of [`Warp::Ior`] from crowding too much.
const CROWDING: f64 = 0.1;

/// alpha_y/alpha_x of the strongest anisotropy is 1 - `SQUASH`.
const SQUASH: f64 = 0.9;

/// One axis of a table. The first axis is the texture's x (columns), the second its y (rows, first
/// row at the top).
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
    /// Physical value at unit coordinate `u`, the inverse of the warp that `warps.wgsl` has.
    pub fn physical(&self, u: f64, surface: Surface<f64>) -> f64 {
        let Surface { alpha, ior, .. } = surface;
        // u^2 (x + l) = x (1 + l)
        let homogeneous = |l: f64| l * u * u / ((1.0 - u * u) + l);
        match self.warp {
            Warp::Linear => self.min + u * (self.max - self.min),
            Warp::Sqrt => u * u,
            Warp::Grazing => 1.0 - u * u,
            Warp::Homogeneous => homogeneous(alpha),
            Warp::HomogeneousAzimuth => homogeneous(surface.towards()),
            Warp::Square => {
                let [low, high] = self.raw();
                (low + u * (high - low)).sqrt()
            }
            Warp::HomogeneousIor => homogeneous(alpha + ONSET * (ior - 1.0).sqrt()),
            Warp::Ior => {
                let [low, high] = self.raw();
                let root = low + u * (high - low);
                let x = (root - CROWDING) * (root + CROWDING);
                let (whole, c) = ((self.max - self.min).sqrt(), LAYER[0] + LAYER[1] * alpha.sqrt());
                let q = c * x * whole / (c + whole * (1.0 - x));
                (self.min + q * q).min(self.max)
            }
            Warp::Aspect => {
                let [low, high] = self.raw();
                let aspect = low + u * (high - low);
                ((1.0 - aspect) * (1.0 + aspect) / SQUASH).clamp(self.min, self.max)
            }
        }
    }

    /// The formula of the unit coordinate from the physical variables, as written in headers and
    /// the manifest.
    pub fn formula(&self) -> String {
        let Axis { name, min, max, .. } = self;
        match self.warp {
            Warp::Linear if (*min, *max) == (0.0, 1.0) => format!("u = {name}"),
            Warp::Linear => format!("u = ({name} - {min}) / ({max} - {min})"),
            Warp::Sqrt => format!("u = sqrt({name})"),
            Warp::Grazing => format!("u = sqrt(1 - {name})"),
            Warp::Homogeneous => format!("u = sqrt({name} * (1 + alpha) / ({name} + alpha))"),
            Warp::HomogeneousAzimuth => format!(
                "u = sqrt({name} * (1 + l) / ({name} + l)), l = alpha * sqrt(cos2_phi / q + (1 - cos2_phi) * q), \
                 q = 1 - {SQUASH} * anisotropy"
            ),
            Warp::Square => format!("u = ({name}^2 - {min}^2) / ({max}^2 - {min}^2)"),
            Warp::HomogeneousIor => {
                format!("u = sqrt({name} * (1 + l) / ({name} + l)), l = alpha + {ONSET} * sqrt(ior - 1)")
            }
            Warp::Ior => format!(
                "u = (sqrt(r * (R + c) / (R * (r + c)) + 0.01) - 0.1) / (sqrt(1.01) - 0.1), r = sqrt({name} - {min}), \
                 R = sqrt({max} - {min}), c = {} + {} * sqrt(alpha)",
                LAYER[0], LAYER[1]
            ),
            Warp::Aspect => format!(
                "u = (sqrt(1 - 0.9 * {min}) - sqrt(1 - 0.9 * {name})) / (sqrt(1 - 0.9 * {min}) - sqrt(1 - 0.9 * {max}))"
            ),
        }
    }

    /// The warp's value at u = 0 and at u = 1, before it is scaled.
    fn raw(&self) -> [f64; 2] {
        let aspect = |x: f64| (1.0 - SQUASH * x).sqrt();
        match self.warp {
            Warp::Linear => [self.min, self.max],
            Warp::Sqrt
            | Warp::Homogeneous
            | Warp::HomogeneousIor
            | Warp::HomogeneousAzimuth
            | Warp::Grazing => [0.0, 1.0],
            Warp::Square => [self.min * self.min, self.max * self.max],
            Warp::Ior => [CROWDING, (1.0 + CROWDING * CROWDING).sqrt()],
            Warp::Aspect => [aspect(self.min), aspect(self.max)],
        }
    }

    /// Scale and offset, in f32, that a shader applies to the warp's value to get the texture
    /// coordinate (on a linear axis, to the physical value itself). With end points registered,
    /// u = 0 is the first texel's centre.
    pub fn affine(&self) -> (f32, f32) {
        let n = self.size as f64;
        let (scale, offset) = match self.registration {
            Registration::Centre => (1.0, 0.0),
            Registration::Endpoint => ((n - 1.0) / n, 0.5 / n),
        };
        let [low, high] = self.raw();
        let scale = scale / (high - low);
        (scale as f32, (offset - scale * low) as f32)
    }

    /// sqrt(max - min), as a shader's constant.
    pub(super) fn whole(&self) -> f32 {
        (self.max - self.min).sqrt() as f32
    }

    /// Physical value at a position in texels; beyond the ends of the axis, that of the end.
    pub fn at(&self, position: f64, surface: Surface<f64>) -> f64 {
        self.physical(self.registration.coordinate(position, self.size).clamp(0.0, 1.0), surface)
    }

    /// Physical value of texel `i`.
    pub fn node(&self, i: usize, surface: Surface<f64>) -> f64 {
        self.at(i as f64, surface)
    }
}
