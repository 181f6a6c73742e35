//! Which direction a sample draws, and the weight that makes its mean the albedo.
//!
//! E is the integral over lights of f cos(l) = D G2/(4 mu_v), so that a light drawn with density p
//! has the weight D G2/(4 mu_v p). A normal h drawn with density q gives the light mirrored about it
//! the density q/(4 v.h). So the weights are:
//! - uniform lights, p = 1/(2 pi): pi D G2/(2 mu_v);
//! - cosine-weighted lights, p = mu_l/pi: pi D G2/(4 mu_v mu_l);
//! - normals by D cos, q = D h_z: G2 (v.h)/(mu_v h_z), of facets that face the view;
//! - visible normals, q = G1(v) D (v.h)/mu_v: G2/G1(v).
//!
//! The last lies in [0, 1]. The others exceed 1, so that the loss of a sample, 1 less its weight, may be
//! negative.

use std::f64::consts::PI;

use super::Weights;
use super::lobes::shadowing_of;
use crate::optics::Smith;
use crate::optics::distribution::Distribution;
use crate::optics::fresnel;
use crate::optics::ggx::{self, Vec3};
use lobefit_math::ops;
use lobefit_math::sobol::DIMENSIONS;

/// Which direction is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Draw {
    /// Lights uniform over the hemisphere.
    UniformLight,
    /// Lights weighted by their cosine.
    CosineLight,
    /// Normals by the distribution, D cos.
    Normal,
    /// Visible normals.
    VisibleNormal,
}

impl Draw {
    /// All of them.
    pub const ALL: [Draw; 4] = [Draw::UniformLight, Draw::CosineLight, Draw::Normal, Draw::VisibleNormal];

    /// The word for it, as an option.
    pub fn name(self) -> &'static str {
        match self {
            Draw::UniformLight => "uniform",
            Draw::CosineLight => "cosine",
            Draw::Normal => "ndf",
            Draw::VisibleNormal => "visible",
        }
    }
}

/// What the estimators ask of a lobe.
pub(crate) trait Lobe: Sync {
    /// Whether visible normals are drawn by the lobe's own masking.
    const MATCHED: bool;
    fn density(&self, normal: Vec3) -> f64;
    fn lambda(&self, direction: Vec3) -> f64;
    /// Lambda of a direction on either side.
    fn lambda_towards(&self, direction: Vec3) -> f64;
    fn visible_normal(&self, view: Vec3, x: [f64; DIMENSIONS]) -> Vec3;

    /// A normal by D cos: one visible from above, where nothing is masked.
    fn normal(&self, x: [f64; DIMENSIONS]) -> Vec3 {
        self.visible_normal([0.0, 0.0, 1.0], x)
    }
}

impl<D: Distribution> Lobe for D {
    const MATCHED: bool = <D as Distribution>::MATCHED;

    fn density(&self, normal: Vec3) -> f64 {
        Distribution::density(*self, normal)
    }

    fn lambda(&self, direction: Vec3) -> f64 {
        Distribution::lambda(*self, direction[2].min(1.0))
    }

    fn lambda_towards(&self, direction: Vec3) -> f64 {
        Distribution::lambda_towards(*self, direction)
    }

    fn visible_normal(&self, view: Vec3, x: [f64; DIMENSIONS]) -> Vec3 {
        Distribution::visible_normal(*self, view, x[0], x[1])
    }
}

/// The anisotropic lobe of GGX.
impl Lobe for [f64; 2] {
    const MATCHED: bool = true;

    /// The isotropic lobe of width 1 at the normal stretched, times the stretch: 1/(pi a_x a_y
    /// ((x/a_x)^2 + (y/a_y)^2 + z^2)^2).
    fn density(&self, [x, y, z]: Vec3) -> f64 {
        let [a, b] = *self;
        ggx::distribution(1.0, [x / a, y / b, z]) / (a * b)
    }

    fn lambda(&self, direction: Vec3) -> f64 {
        self.lambda_towards(direction)
    }

    fn lambda_towards(&self, direction: Vec3) -> f64 {
        ggx::lambda_towards(*self, direction)
    }

    fn visible_normal(&self, view: Vec3, x: [f64; DIMENSIONS]) -> Vec3 {
        ggx::visible_normal(*self, view, x[0], x[1])
    }
}

/// The view of a cosine, in the plane of x and z.
pub(crate) fn view(mu: f64) -> Vec3 {
    [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu]
}

/// Weights of one sample: kept light, the same times (1 - v.h)^5, lost light.
pub(super) fn sample<L: Lobe>(
    (smith, draw): (Smith, Draw),
    lobe: &L,
    view: Vec3,
    x: [f64; DIMENSIONS],
) -> Weights {
    match draw {
        Draw::VisibleNormal if L::MATCHED => by_visible_normal(smith, lobe, view, x),
        Draw::Normal => by_normal(smith, lobe, view, x),
        Draw::CosineLight => {
            let mu_l = x[1].max(f64::MIN_POSITIVE).sqrt();
            by_light(smith, lobe, view, (x[0], mu_l, 0.5 / mu_l))
        }
        Draw::VisibleNormal | Draw::UniformLight => {
            by_light(smith, lobe, view, (x[0], x[1].max(f64::MIN_POSITIVE), 1.0))
        }
    }
}

/// The light that a sample of visible normals keeps.
pub(crate) fn traced<'a, L: Lobe + 'a>(
    smith: Smith,
    lobe: L,
    view: Vec3,
) -> Box<dyn Fn([f64; 3]) -> f64 + 'a> {
    Box::new(move |x| sample((smith, Draw::VisibleNormal), &lobe, view, x)[0])
}

fn by_visible_normal<L: Lobe>(smith: Smith, lobe: &L, view: Vec3, x: [f64; DIMENSIONS]) -> Weights {
    let normal = lobe.visible_normal(view, x);
    let (light, cosine) = ggx::mirror(view, normal);
    if light[2] <= 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let (kept, lost) = shadowing_of(smith, lobe.lambda(view), lobe.lambda(light));
    [kept, kept * fresnel::schlick_weight(1.0 - cosine.min(1.0)), lost]
}

fn by_normal<L: Lobe>(smith: Smith, lobe: &L, view: Vec3, x: [f64; DIMENSIONS]) -> Weights {
    let normal = lobe.normal(x);
    let (light, cosine) = ggx::mirror(view, normal);
    if cosine <= 0.0 || light[2] <= 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let kept = masking(smith, lobe, view, light) * cosine / (view[2] * normal[2]);
    [kept, kept * fresnel::schlick_weight(1.0 - cosine.min(1.0)), 1.0 - kept]
}

/// A light by its azimuth in turns and its cosine, of a density that is that of uniform lights divided by
/// `scale`.
fn by_light<L: Lobe>(smith: Smith, lobe: &L, view: Vec3, (turns, mu_l, scale): (f64, f64, f64)) -> Weights {
    let sine = ((1.0 - mu_l) * (1.0 + mu_l)).sqrt();
    let (sin_azimuth, cos_azimuth) = ops::sincos(2.0 * PI * turns);
    let light = [sine * cos_azimuth, sine * sin_azimuth, mu_l];
    let sum = [light[0] + view[0], light[1] + view[1], light[2] + view[2]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    let half = [sum[0] / length, sum[1] / length, sum[2] / length];
    // 2 pi f cos = 2 pi D G2/(4 mu_v)
    let kept = 0.5 * PI * lobe.density(half) * masking(smith, lobe, view, light) / view[2] * scale;
    [kept, kept * fresnel::schlick_weight(1.0 - 0.5 * length), 1.0 - kept]
}

/// G2.
fn masking<L: Lobe>(smith: Smith, lobe: &L, view: Vec3, light: Vec3) -> f64 {
    let (of_view, of_light) = (lobe.lambda(view), lobe.lambda(light));
    match smith {
        Smith::Correlated => 1.0 / (1.0 + of_view + of_light),
        Smith::Separable => 1.0 / ((1.0 + of_view) * (1.0 + of_light)),
    }
}
