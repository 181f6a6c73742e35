//! The lobes as textbooks write them, and a plain rule over all directions: nothing of the
//! program's own integrators.
//!
//! Walter, Marschner, Li & Torrance, "Microfacet models for refraction through rough surfaces",
//! 2007; Heitz, "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014.

use lobefit::data::Smith;
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;

/// A direction: x, y, and z along the normal.
pub type Vector = [f64; 3];

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn normalised(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// The direction of a cosine and an azimuth from the x axis.
pub fn direction(cosine: f64, phi: f64) -> Vector {
    let (sine, (s, c)) = ((1.0 - cosine * cosine).sqrt(), ops::sincos(phi));
    [sine * c, sine * s, cosine]
}

/// A rule over the directions of a hemisphere: Gauss in the cosine, the trapezoidal rule in the
/// azimuth.
pub struct Hemisphere {
    cosines: Gauss,
    /// Cosine and sine of each azimuth.
    azimuths: Vec<[f64; 2]>,
}

impl Hemisphere {
    pub fn new(cosines: usize, azimuths: usize) -> Hemisphere {
        let step = 2.0 * std::f64::consts::PI / azimuths as f64;
        let azimuth = |k: usize| {
            let (s, c) = ops::sincos((k as f64 + 0.5) * step);
            [c, s]
        };
        Hemisphere { cosines: Gauss::new(cosines), azimuths: (0..azimuths).map(azimuth).collect() }
    }

    /// The integrals of several functions of the direction over the solid angle of a range of
    /// cosines.
    pub fn integrate<const N: usize>(
        &self,
        [low, high]: [f64; 2],
        f: impl Fn(Vector) -> [f64; N],
    ) -> [f64; N] {
        let step = 2.0 * std::f64::consts::PI / self.azimuths.len() as f64;
        let mut sums = [0.0; N];
        for (x, w) in self.cosines.nodes.iter().zip(&self.cosines.weights) {
            let half = 0.5 * (high - low);
            let (cosine, weight) = (low + half * (1.0 + x), half * w * step);
            let sine = (1.0 - cosine * cosine).sqrt();
            for [c, s] in &self.azimuths {
                for (sum, value) in sums.iter_mut().zip(f([sine * c, sine * s, cosine])) {
                    *sum += weight * value;
                }
            }
        }
        sums
    }
}

/// GGX facets with Smith's shadowing.
#[derive(Clone, Copy, Debug)]
pub struct Facets {
    pub smith: Smith,
    pub alpha: [f64; 2],
}

impl Facets {
    /// Heitz 2014, eq. 85.
    fn distribution(&self, h: Vector) -> f64 {
        let ([ax, ay], [x, y, z]) = (self.alpha, h);
        if z <= 0.0 {
            return 0.0;
        }
        let stretched = (x / ax) * (x / ax) + (y / ay) * (y / ay) + z * z;
        1.0 / (std::f64::consts::PI * ax * ay * stretched * stretched)
    }

    /// Heitz 2014, eq. 86; of directions on either side.
    fn lambda(&self, [x, y, z]: Vector) -> f64 {
        let [ax, ay] = self.alpha;
        let square = ((ax * x) * (ax * x) + (ay * y) * (ay * y)) / (z * z);
        0.5 * ((1.0 + square).sqrt() - 1.0)
    }

    fn shadowing(&self, v: Vector, l: Vector) -> f64 {
        let (v, l) = (self.lambda(v), self.lambda(l));
        match self.smith {
            Smith::Correlated => 1.0 / (1.0 + v + l),
            Smith::Separable => 1.0 / ((1.0 + v) * (1.0 + l)),
        }
    }

    /// BRDF times the cosine of the light for F = 1, and the cosine between view and facet: Walter
    /// et al., eq. 20.
    pub fn reflected(&self, v: Vector, l: Vector) -> (f64, f64) {
        let h = normalised([v[0] + l[0], v[1] + l[1], v[2] + l[2]]);
        (self.distribution(h) * self.shadowing(v, l) / (4.0 * v[2]), dot(v, h))
    }

    /// Cosines, below the surface, of the light that facets turned to the outside send there:
    /// h = -(from v + to l) is above the horizon on one side of l_z = -v_z from/to, and at the
    /// horizon itself, where D is not 0, the lobe ends abruptly.
    pub fn below(v: Vector, [from, to]: [f64; 2]) -> [f64; 2] {
        let edge = (v[2] * from / to).min(1.0);
        if to > from { [edge, 1.0] } else { [0.0, edge] }
    }

    /// BTDF times the cosine of the light, from a medium of index `from` to one of index `to`:
    /// Walter et al., eq. 21. `l` is below the surface.
    pub fn transmitted(&self, v: Vector, l: Vector, [from, to]: [f64; 2]) -> f64 {
        let half = normalised([0, 1, 2].map(|k| from * v[k] + to * l[k]));
        let h = if half[2] > 0.0 { half } else { half.map(|x| -x) };
        let (vh, lh) = (dot(v, h), dot(l, h));
        if vh <= 0.0 || lh >= 0.0 {
            return 0.0;
        }
        let through = 1.0 - fresnel(vh, to / from);
        let sum = from * vh + to * lh;
        let jacobian = to * to * lh.abs() / (sum * sum);
        vh / v[2] * jacobian * through * self.shadowing(v, l) * self.distribution(h)
    }
}

/// Reflectance of a dielectric at the cosine c of incidence, with the ratio of the far to the near
/// index: Walter et al., eq. 22.
pub fn fresnel(c: f64, ratio: f64) -> f64 {
    let square = ratio * ratio - 1.0 + c * c;
    if square <= 0.0 {
        return 1.0;
    }
    let g = square.sqrt();
    let (a, b) = ((g - c) / (g + c), (c * (g + c) - 1.0) / (c * (g - c) + 1.0));
    0.5 * a * a * (1.0 + b * b)
}

/// (1 - c)^5, Schlick's approximation of what F has beyond F0.
pub fn schlick(c: f64) -> f64 {
    let x = 1.0 - c;
    x * x * (x * x) * x
}
