//! A view onto an anisotropic lobe.

use crate::optics::Smith;
use lobefit_math::ops;

/// A fixed view direction onto a lobe.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub smith: Smith,
    pub alpha: [f64; 2],
    pub mu: f64,
    pub sine: f64,
    /// cos and sin of the view's azimuth.
    pub azimuth: [f64; 2],
    /// Stretched length of the view.
    pub s_v: f64,
}

impl View {
    pub fn new(smith: Smith, alpha: [f64; 2], mu: f64, phi: f64) -> View {
        let (sin_phi, cos_phi) = ops::sincos(phi);
        View::towards(smith, alpha, mu, [cos_phi, sin_phi])
    }

    /// The view of azimuth (cos, sin).
    pub fn towards(smith: Smith, alpha: [f64; 2], mu: f64, azimuth: [f64; 2]) -> View {
        let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
        let (x, y) = (alpha[0] * sine * azimuth[0], alpha[1] * sine * azimuth[1]);
        View { smith, alpha, mu, sine, azimuth, s_v: (mu * mu + x * x + y * y).sqrt() }
    }

    /// Stretched length of a direction.
    pub fn stretched(&self, direction: [f64; 3]) -> f64 {
        let (x, y) = (self.alpha[0] * direction[0], self.alpha[1] * direction[1]);
        (x * x + y * y + direction[2] * direction[2]).sqrt()
    }
}
