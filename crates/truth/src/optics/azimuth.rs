//! The azimuth of the view in four channels.
//!
//! The lobe as seen from azimuth phi has the width alpha_v = sqrt(alpha_x^2 cos^2 phi + alpha_y^2
//! sin^2 phi) towards the view, the one in Smith's Lambda. With alpha_x = alpha/aspect,
//! alpha_y = alpha aspect, its logarithm runs between -ln(1/aspect) and ln(1/aspect) about
//! ln(alpha), so t = ln(alpha_v/alpha)/ln(1/aspect) lies in [-1, 1]. At a column of the layout that
//! follows the layer mu ~ alpha_v, the loss is a cubic of t within 3e-3 (at alpha = 1 and a ratio
//! of 10; 7e-4 for alpha up to 0.2), where a cubic of cos(2 phi) leaves 0.04.

use lobefit_math::{chebyshev, ops};

/// Samples in t of the least squares that yields the cubic.
const SAMPLES: usize = 8;

/// An anisotropic surface: alpha_x = alpha/aspect, alpha_y = alpha aspect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Azimuth {
    /// Geometric mean of alpha_x and alpha_y, > 0.
    pub alpha: f64,
    /// sqrt(alpha_y/alpha_x), in (0, 1].
    pub aspect: f64,
}

impl Azimuth {
    /// alpha_x and alpha_y.
    pub fn alphas(&self) -> [f64; 2] {
        [self.alpha / self.aspect, self.alpha * self.aspect]
    }

    /// alpha towards the view at t in [-1, 1]: alpha_y at -1, alpha_x at 1.
    pub fn alpha(&self, t: f64) -> f64 {
        self.alpha * ops::exp(-t * ops::log(self.aspect))
    }

    /// Azimuth of the view from the alpha_x axis at t, in [0, pi/2]; of an isotropic surface, 0.
    pub fn phi(&self, t: f64) -> f64 {
        let ([x, y], v) = (self.alphas(), self.alpha(t));
        let (cos2, sin2) = (((v - y) * (v + y)).max(0.0), ((x - v) * (x + v)).max(0.0));
        ops::atan2(sin2.sqrt(), cos2.sqrt())
    }

    /// t of an azimuth; 0 for an isotropic surface.
    pub fn t(&self, phi: f64) -> f64 {
        let ([x, y], (sine, cosine)) = (self.alphas(), ops::sincos(phi));
        let range = -ops::log(self.aspect);
        if range < 1e-9 {
            return 0.0;
        }
        let v = (x * x * cosine * cosine + y * y * sine * sine).sqrt();
        (ops::log(v / self.alpha) / range).clamp(-1.0, 1.0)
    }

    /// The values of t at which [`Azimuth::cubic`] wants a function: the Chebyshev extrema, ends
    /// included.
    pub fn samples() -> Vec<f64> {
        chebyshev::nodes(-1.0, 1.0, SAMPLES)
    }

    /// Coefficients of 1, t, t^2 and t^3 of the function with these values at [`Azimuth::samples`]:
    /// its Chebyshev series cut after the third term, near the best cubic.
    ///
    /// # Panics
    /// If there are not as many values as samples.
    pub fn cubic(values: &[f64]) -> [f64; 4] {
        assert_eq!(values.len(), SAMPLES, "a value for each sample");
        let last = SAMPLES - 1;
        let mut series = [0.0; 4];
        for (k, term) in series.iter_mut().enumerate() {
            for (i, value) in values.iter().enumerate() {
                // samples ascend: t_i = -cos(pi i/last), so T_k(t_i) = (-1)^k cos(pi k i/last)
                let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
                let end = if i == 0 || i == last { 0.5 } else { 1.0 };
                let angle = std::f64::consts::PI * (k * i) as f64 / last as f64;
                *term += sign * end * ops::cos(angle) * value;
            }
            *term *= if k == 0 { 1.0 } else { 2.0 } / last as f64;
        }
        let [a, b, c, d] = series;
        // T_2 = 2 t^2 - 1, T_3 = 4 t^3 - 3 t
        [a - c, b - 3.0 * d, 2.0 * c, 4.0 * d]
    }

    /// The cubic at t.
    pub fn at(coefficients: [f64; 4], t: f64) -> f64 {
        let [a, b, c, d] = coefficients;
        a + t * (b + t * (c + t * d))
    }
}
