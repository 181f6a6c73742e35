//! GGX with Schlick's approximation of Smith's shadowing (Schlick 1994, sec. 4.1), as Karis (2013)
//! has it: G1 = mu/(mu (1 - k) + k), G2 = G1(v) G1(l).

use super::distribution::{Distribution, Ggx, Polar};
use super::ggx::Vec3;

/// The distribution of GGX with Schlick's G1 of a k in [0, 1/2].
#[derive(Clone, Copy, Debug)]
pub struct SchlickSmith {
    ggx: Ggx,
    k: f64,
}

impl SchlickSmith {
    /// k = alpha/2: of light from images (Karis 2013, "Specular BRDF").
    pub fn of_images(alpha: f64) -> SchlickSmith {
        SchlickSmith { ggx: Ggx(alpha), k: 0.5 * alpha }
    }

    /// k = (roughness + 1)^2/8, roughness = sqrt(alpha): of analytic lights (Karis 2013, eq. 4). It
    /// is 1/8 for a mirror, whose E is G1^2 then.
    pub fn of_lights(alpha: f64) -> SchlickSmith {
        let grown = alpha.sqrt() + 1.0;
        SchlickSmith { ggx: Ggx(alpha), k: 0.125 * grown * grown }
    }

    /// k = alpha, which engines use for want of Karis' half.
    pub fn of_alpha(alpha: f64) -> SchlickSmith {
        SchlickSmith { ggx: Ggx(alpha), k: alpha }
    }
}

impl Distribution for SchlickSmith {
    #[inline(always)]
    fn alpha(self) -> f64 {
        self.ggx.alpha()
    }

    fn density(self, normal: Vec3) -> f64 {
        self.ggx.density(normal)
    }

    const REACH: f64 = Ggx::REACH;

    const MATCHED: bool = false;

    #[inline(always)]
    fn density_of_half(self, polar: &Polar, t: f64) -> f64 {
        self.ggx.density_of_half(polar, t)
    }

    #[inline(always)]
    fn fall(self, polar: &Polar) -> f64 {
        self.ggx.fall(polar)
    }

    #[inline(always)]
    fn azimuth_integral(self, polar: &Polar) -> f64 {
        self.ggx.azimuth_integral(polar)
    }

    /// G1 = 2 mu/(mu + s) is Schlick's for s = mu (1 - 2 k) + 2 k.
    #[inline(always)]
    fn area(self, cosine: f64, _: f64) -> f64 {
        cosine + 2.0 * self.k * (1.0 - cosine)
    }

    #[inline(always)]
    fn lift(self, cosine: f64, _: f64, _: f64) -> f64 {
        2.0 * self.k * (1.0 - cosine)
    }

    /// A normal of GGX's own masking.
    fn visible_normal(self, view: Vec3, u: f64, v: f64) -> Vec3 {
        self.ggx.visible_normal(view, u, v)
    }
}
