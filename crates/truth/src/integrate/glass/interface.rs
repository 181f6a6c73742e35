//! A smooth dielectric interface: refraction and Fresnel, stable for every index of
//! refraction >= 1.

use crate::optics::fresnel;

/// Where the ray comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the medium of index 1.
    Outside,
    /// From the medium of index `ior`.
    Inside,
}

impl Side {
    /// Both sides.
    pub const ALL: [Side; 2] = [Side::Outside, Side::Inside];

    /// The word used in options and columns.
    pub fn name(self) -> &'static str {
        match self {
            Side::Outside => "outside",
            Side::Inside => "inside",
        }
    }
}

/// An interface seen from one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interface {
    /// n_inside / n_outside.
    pub ior: f64,
    /// n_view / n_far.
    pub eta: f64,
    /// 1 - eta^2, from (ior - 1) without cancellation: positive from outside.
    pub contrast: f64,
}

/// What a facet at one angle to the view does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Facet {
    /// Reflectance.
    pub fresnel: f64,
    /// cos and sin of the angle from the straight-through direction to the refracted one, positive
    /// towards the facet's normal; (1, 0) at total reflection.
    pub deviation: [f64; 2],
}

impl Interface {
    pub fn new(ior: f64, side: Side) -> Interface {
        let excess = (ior - 1.0) * (ior + 1.0);
        match side {
            Side::Outside => Interface { ior, eta: 1.0 / ior, contrast: excess / (ior * ior) },
            Side::Inside => Interface { ior, eta: ior, contrast: -excess },
        }
    }

    /// sin and cos of the critical angle, from inside.
    pub fn critical(&self) -> Option<[f64; 2]> {
        (self.contrast < 0.0).then(|| [1.0 / self.eta, (-self.contrast).sqrt() / self.eta])
    }

    /// Reflectance at the cosine c of the angle of incidence.
    pub fn fresnel(&self, c: f64) -> f64 {
        self.facet(c, ((1.0 - c) * (1.0 + c)).sqrt()).fresnel
    }

    /// A facet at cosine c and sine s to the view.
    ///
    /// With c_t the cosine of refraction, c_t^2 = 1 - eta^2 + eta^2 c^2.
    #[inline(always)]
    pub fn facet(&self, c: f64, s: f64) -> Facet {
        let square = self.contrast + self.eta * self.eta * c * c;
        // Both are computed: lanes take no branches.
        let (total, c_t) = (square <= 0.0, square.max(0.0).sqrt());
        let fresnel = fresnel::unpolarised(self.eta, self.contrast, c, s * s, c_t);
        // sin(i - t) = s (c_t - eta c), cos(i - t) = c c_t + eta s^2
        let straight = c * c_t + self.eta * s * s;
        let turned = s * self.contrast / (self.eta * c + c_t);
        Facet {
            fresnel: if total { 1.0 } else { fresnel },
            deviation: [if total { 1.0 } else { straight }, if total { 0.0 } else { turned }],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hemispherical averages in closed form (Walsh; Duntley), to 16 digits.
    #[test]
    fn fresnel_averages_are_the_closed_forms() {
        let rule = lobefit_math::gauss::Gauss::new(64);
        for (ior, outside, inside) in [
            (1.5, 0.09177795934235121, 0.5963457597077116),
            (1.33, 0.06593084929940542, 1.0 - (1.0 - 0.06593084929940542) / (1.33 * 1.33)),
            (2.0, 0.160596637069606, 1.0 - (1.0 - 0.160596637069606) / 4.0),
        ] {
            let from_outside = Interface::new(ior, Side::Outside);
            let average = rule.integrate(0.0, 1.0, |c| 2.0 * c * from_outside.fresnel(c));
            assert!((average - outside).abs() < 1e-13, "{ior}: {average}");
            let from_inside = Interface::new(ior, Side::Inside);
            let critical = from_inside.critical().expect("from inside")[1];
            // Square-root at the critical angle: c = critical + t^2.
            let end = (1.0 - critical).sqrt();
            let partial = rule.integrate(0.0, end, |t| {
                let c = critical + t * t;
                2.0 * c * from_inside.fresnel(c) * 2.0 * t
            });
            let average = partial + critical * critical;
            assert!((average - inside).abs() < 1e-13, "{ior}: {average} {inside}");
        }
    }

    #[test]
    fn refraction_there_and_back_closes() {
        for ior in [1.0001, 1.02, 1.5, 2.5] {
            let (there, back) = (Interface::new(ior, Side::Outside), Interface::new(ior, Side::Inside));
            for c in [1.0, 0.9, 0.5, 0.1] {
                let s = ((1.0_f64 - c) * (1.0 + c)).sqrt();
                let facet = there.facet(c, s);
                let [cos_d, sin_d] = facet.deviation;
                assert!((cos_d * cos_d + sin_d * sin_d - 1.0).abs() < 1e-14);
                // The refracted angle is i - deviation; from there the reflectance is the same.
                let (c_t, s_t) = (c * cos_d + s * sin_d, s * cos_d - c * sin_d);
                assert!((s_t * ior - s).abs() < 1e-14, "Snell's law at {ior} {c}");
                let other = back.facet(c_t, s_t);
                assert!((other.fresnel - facet.fresnel).abs() < 1e-12, "{ior} {c}: {facet:?} {other:?}");
                assert!((other.deviation[1] + sin_d).abs() < 1e-13, "{ior} {c}");
            }
        }
    }
}
