//! Lobes as densities of directions.

use crate::matrix::Matrix;
use lobefit_math::vector::{Vec3, dot, normalise, plus};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::{Smith, ggx};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::sheen::lobe as charlie;
use lobefit_truth::quantity::{GGX_REFLECTION, Quantity, SheenCharlie, Variant};

/// A lobe with F = 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobe {
    /// GGX with this shadowing.
    Ggx(Smith),
    /// Charlie with Neubelt's visibility.
    Charlie,
}

/// The least alpha at which there is a matrix: of GGX that of the rules of its albedo; below
/// Charlie's, a ring along the horizon, no matrix is near it.
const LEAST: [f64; 2] = [1e-4, 1e-2];

impl Lobe {
    /// The quantity of its albedo.
    pub fn quantity(self) -> &'static dyn Quantity {
        match self {
            Lobe::Ggx(_) => GGX_REFLECTION,
            Lobe::Charlie => &SheenCharlie,
        }
    }

    /// How names of its tables and functions begin.
    pub fn name(self) -> &'static str {
        match self {
            Lobe::Ggx(_) => "ggx",
            Lobe::Charlie => "sheen",
        }
    }

    /// The quantity that its matrices stand for, in headers.
    pub fn transformed(self) -> &'static str {
        match self {
            Lobe::Ggx(_) => "ggx-ltc",
            Lobe::Charlie => "sheen-ltc",
        }
    }

    /// The least alpha at which there is a matrix.
    pub fn least(self) -> f64 {
        LEAST[usize::from(self == Lobe::Charlie)]
    }

    /// An alpha within the range of matrices.
    pub fn within(self, alpha: f64) -> f64 {
        alpha.max(self.least())
    }

    /// A matrix of about the width of the lobe at mu = 1.
    pub(crate) fn first(self, alpha: f64) -> Matrix {
        let m33 = if self == Lobe::Charlie { 1.0 } else { alpha };
        Matrix { m33, ..Matrix::IDENTITY }
    }

    /// Where searches begin beside a known matrix: of Charlie's ring also at the cosine.
    pub(crate) fn starts(self, beside: Matrix) -> Vec<Matrix> {
        match self {
            Lobe::Ggx(_) => vec![beside],
            Lobe::Charlie => vec![beside, Matrix::IDENTITY],
        }
    }

    /// E and B, the albedo at f0 = 0, at places of alpha and mu; a sheen has no Fresnel term: B = 0.
    ///
    /// # Errors
    /// A place outside the domain.
    pub fn albedo(self, places: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, IntegrateError> {
        let column = |k: usize| places.iter().map(|place| place[k]).collect::<Vec<f64>>();
        let points = Points::new([("alpha", column(0)), ("mu", column(1))]);
        let (variant, outputs): (Variant, &[&str]) = match self {
            Lobe::Ggx(smith) => (Variant::from(smith), &["E", "B"]),
            Lobe::Charlie => (Variant::default(), &["E"]),
        };
        let quantity = self.quantity();
        let truth = quantity.truth(&variant, &points, outputs, quantity.tolerance_of_many(&variant))?;
        let value = |k: usize, i: usize| truth.columns.get(k).map_or(0.0, |column: &Vec<f64>| column[i]);
        Ok((0..places.len()).map(|i| [value(0, i), value(1, i)]).collect())
    }
}

/// A lobe seen from somewhere.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The lobe.
    pub lobe: Lobe,
    /// Its width.
    pub alpha: f64,
    /// Cosine of the view.
    pub mu: f64,
    /// The directional albedo.
    pub albedo: f64,
    direction: Vec3,
    stretched: f64,
}

impl View {
    /// alpha of the range of [`Lobe::within`], mu in [0, 1].
    ///
    /// # Errors
    /// A place outside the domain of the albedo.
    pub fn new(lobe: Lobe, alpha: f64, mu: f64) -> Result<View, IntegrateError> {
        let albedo = lobe.albedo(&[[alpha, mu]])?[0][0];
        Ok(View::of(lobe, [alpha, mu], albedo))
    }

    /// The same with a known albedo.
    pub fn of(lobe: Lobe, [alpha, mu]: [f64; 2], albedo: f64) -> View {
        let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
        let stretched = ggx::stretched_length(alpha, mu);
        View { lobe, alpha, mu, albedo, direction: [sine, 0.0, mu], stretched }
    }

    /// The direction of the mirrored view.
    pub fn mirrored(&self) -> Vec3 {
        [-self.direction[0], 0.0, self.mu]
    }

    /// The share of the lobe's light per solid angle from a direction of unit length: f mu_l / E,
    /// whose integral over the hemisphere is 1.
    #[inline]
    pub fn density(&self, light: Vec3) -> f64 {
        let mu_l = light[2];
        if mu_l <= 0.0 {
            return 0.0;
        }
        let sum = plus(self.direction, light);
        if dot(sum, sum) == 0.0 {
            return 0.0;
        }
        let half = normalise(sum);
        let value = match self.lobe {
            Lobe::Ggx(smith) => {
                let s_l = ggx::stretched_length(self.alpha, mu_l);
                let shadowed = ggx::visibility(smith, self.mu, self.stretched, mu_l, s_l);
                ggx::distribution(self.alpha, half) * shadowed * mu_l
            }
            Lobe::Charlie => 0.25 * charlie::distribution(self.alpha, half) * charlie::lit(self.mu, mu_l),
        };
        value / self.albedo
    }
}
