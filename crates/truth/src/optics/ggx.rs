//! The GGX microfacet distribution (Trowbridge and Reitz 1975, Walter et al. 2007), isotropic, with
//! Smith shadowing (Heitz 2014), and its visible normals. Directions are (x, y, z) about the macro
//! normal z.

use crate::optics::Smith;
use lobefit_math::ops;
pub use lobefit_math::vector::Vec3;

/// sqrt(mu^2 + alpha^2 (1 - mu^2)): the length of the stretched direction. For mu in [0, 1] it lies
/// in [min(alpha, 1), max(alpha, 1)].
#[inline(always)]
pub fn stretched_length(alpha: f64, mu: f64) -> f64 {
    (mu * mu + alpha * alpha * ((1.0 - mu) * (1.0 + mu))).sqrt()
}

/// Smith's Lambda, (sqrt(1 + alpha^2 tan^2) - 1)/2 (Heitz 2014, eq. 72), without cancellation at
/// small alpha. mu in (0, 1]; infinite at mu = 0.
#[inline(always)]
pub fn lambda(alpha: f64, mu: f64) -> f64 {
    let square = alpha * alpha * ((1.0 - mu) * (1.0 + mu)) / (mu * mu);
    square / (2.0 * (1.0 + (1.0 + square).sqrt()))
}

/// [`lambda`] of an anisotropic lobe towards a direction on either side of the surface; infinite at
/// z = 0.
#[inline(always)]
pub fn lambda_towards(alpha: [f64; 2], direction: Vec3) -> f64 {
    let (x, y, z) = (alpha[0] * direction[0], alpha[1] * direction[1], direction[2]);
    let square = (x * x + y * y) / (z * z);
    square / (2.0 * (1.0 + (1.0 + square).sqrt()))
}

/// [`Smith::lit_given_visible`] of two cosines in (0, 1].
#[inline(always)]
pub fn lit_given_visible(smith: Smith, alpha: f64, mu_v: f64, mu_l: f64) -> f64 {
    smith.lit_given_visible(lambda(alpha, mu_v), lambda(alpha, mu_l))
}

/// G2/(4 mu_l mu_v), finite where one cosine is 0: correlated 1/(2 (mu_l s_v + mu_v s_l)),
/// separable 1/((mu_v + s_v)(mu_l + s_l)), s = [`stretched_length`]. Exactly the same with the two
/// directions exchanged; infinite for the correlated form at mu_l = mu_v = 0.
#[inline(always)]
pub fn visibility(smith: Smith, mu_v: f64, s_v: f64, mu_l: f64, s_l: f64) -> f64 {
    match smith {
        Smith::Correlated => 0.5 / (mu_l * s_v + mu_v * s_l),
        Smith::Separable => 1.0 / ((mu_v + s_v) * (mu_l + s_l)),
    }
}

/// A normal visible from `view`, drawn by the spherical cap of Dupuy and Benyoub 2023, listing 2,
/// from two numbers in [0, 1). No tangent frame. `view` on either side of the
/// horizon: from below, the visible normals are those of facets seen between others, and the cap of
/// directions mirrored about them is z in (-view.z, 1] all the same.
pub fn visible_normal(alpha: [f64; 2], view: Vec3, u: f64, v: f64) -> Vec3 {
    visible_normal_at(alpha, view, ops::sincos(2.0 * std::f64::consts::PI * u), v)
}

/// [`visible_normal`] by the sine and cosine of the azimuth of the cap, whose z is (1 - v)(1 + s) - s,
/// s that of the stretched view. 1 - z = v (1 + s), 1 + z = (1 - v)(1 + s) + (1 - s) and z + s are
/// each taken without a difference: at the pole and at the rim z itself has lost its sine.
#[inline]
pub fn visible_normal_at(
    alpha: [f64; 2],
    view: Vec3,
    (sin_azimuth, cos_azimuth): (f64, f64),
    v: f64,
) -> Vec3 {
    let stretched = normalise([alpha[0] * view[0], alpha[1] * view[1], view[2]]);
    let s = stretched[2];
    let longer = 1.0 + s.abs();
    let shorter = (stretched[0] * stretched[0] + stretched[1] * stretched[1]) / longer;
    let (above, rest) = if s < 0.0 { (shorter, longer) } else { (longer, shorter) };
    let (below, z) = (v * above, (1.0 - v) * above);
    let sine = (below * (z + rest)).sqrt();
    let (x, y) = (sine * cos_azimuth + stretched[0], sine * sin_azimuth + stretched[1]);
    normalise([alpha[0] * x, alpha[1] * y, z])
}

/// The direction `view` mirrored about `normal`, with the cosine v.h.
pub fn mirror(view: Vec3, normal: Vec3) -> (Vec3, f64) {
    let cosine = view[0] * normal[0] + view[1] * normal[1] + view[2] * normal[2];
    let twice = 2.0 * cosine;
    let light = [twice * normal[0] - view[0], twice * normal[1] - view[1], twice * normal[2] - view[2]];
    (light, cosine)
}

fn normalise(x: Vec3) -> Vec3 {
    let length = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    [x[0] / length, x[1] / length, x[2] / length]
}

/// The distribution D of normals at the half vector `h` of unit length, in the stretched form
/// 1/(pi alpha^2 ((x/alpha)^2 + (y/alpha)^2 + z^2)^2), accurate for every alpha > 0.
pub fn distribution(alpha: f64, h: Vec3) -> f64 {
    let (x, y) = (h[0] / alpha, h[1] / alpha);
    let d = 1.0 / (alpha * (x * x + y * y + h[2] * h[2]));
    d * d / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobefit_math::gauss::Gauss;

    #[test]
    fn projected_area_of_the_normals_is_one() {
        let rule = Gauss::new(64);
        for alpha in [0.05, 0.3, 1.0] {
            // t = tan^2 / (tan^2 + alpha^2) flattens D cos: the integral over normals is that of t
            // over [0, 1].
            let total = rule.integrate(0.0, 1.0, |t| {
                let tan2 = alpha * alpha * t / (1.0 - t);
                let cosine = 1.0 / (1.0 + tan2).sqrt();
                let h = [cosine * tan2.sqrt(), 0.0, cosine];
                let dtan2 = alpha * alpha / ((1.0 - t) * (1.0 - t));
                // d omega cos = cos^4 d(tan^2)/2 d phi
                distribution(alpha, h) * cosine * cosine * cosine * cosine * dtan2 * std::f64::consts::PI
            });
            assert!((total - 1.0).abs() < 1e-12, "alpha {alpha}: {total}");
        }
    }

    #[test]
    fn lambda_is_exact_where_the_textbook_form_is_zero() {
        let lambda = lambda(1e-10, 0.5);
        assert!((lambda / (3e-20 / 4.0) - 1.0).abs() < 1e-12, "{lambda}");
    }

    #[test]
    fn complements_add_up() {
        for smith in [Smith::Correlated, Smith::Separable] {
            for (alpha, v, l) in [(0.3, 0.2, 0.7), (1.0, 0.01, 0.5), (1e-3, 0.5, 1e-3)] {
                let (of_v, of_l) = (lambda(alpha, v), lambda(alpha, l));
                let sum = smith.lit_given_visible(of_v, of_l) + smith.shadowed_given_visible(of_v, of_l);
                assert!((sum - 1.0).abs() < 4e-16, "{sum}");
                let (s_v, s_l) = (stretched_length(alpha, v), stretched_length(alpha, l));
                let kept = smith.shadowing_over_cosine(v, s_v, l, s_l) * v;
                let lift = alpha * alpha * (1.0 - l) * (1.0 + l) / (s_l + l);
                let taken = smith.shadowed_over_cosine(v, s_v, l, s_l, lift) * v;
                let masking = 2.0 * v / (v + s_v);
                assert!((kept + taken - masking).abs() < 1e-15, "{smith:?} {alpha} {v} {l}");
            }
        }
    }

    #[test]
    fn visible_normals_have_unit_length_and_face_the_view() {
        let view = [0.6, 0.0, 0.8];
        for i in 0..64 {
            let normal = visible_normal([0.4; 2], view, f64::from(i) / 64.0, f64::from((i * 37) % 64) / 64.0);
            let length = normal.iter().map(|x| x * x).sum::<f64>();
            assert!((length - 1.0).abs() < 1e-14);
            assert!(mirror(view, normal).1 >= 0.0);
        }
    }
}
