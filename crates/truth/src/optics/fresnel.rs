//! Fresnel reflectance: exact for dielectrics and conductors, and Schlick's approximation, with
//! their averages over the hemisphere.

use std::sync::LazyLock;

use lobefit_math::gauss::Gauss;
use lobefit_math::panels;

/// Weight of F90 in Schlick's Fresnel, (1 - c)^5, from 1 - c (pass the difference: it can be had
/// without cancellation). Schlick 1994, eq. 24.
#[inline(always)]
pub fn schlick_weight(one_minus_cosine: f64) -> f64 {
    let square = one_minus_cosine * one_minus_cosine;
    square * square * one_minus_cosine
}

/// Reflectance at normal incidence of a dielectric with relative index of refraction `ior` >= 1:
/// ((n-1)/(n+1))^2.
pub fn f0_of_ior(ior: f64) -> f64 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
}

/// Schlick's reflectance f0 + (1 - f0)(1 - c)^5 with F90 = 1, from 1 - c; f0 at c = 1, 1 at c = 0.
#[inline(always)]
pub fn schlick(f0: f64, one_minus_cosine: f64) -> f64 {
    f0 + (1.0 - f0) * schlick_weight(one_minus_cosine)
}

/// 2 int_0^1 F(c) c dc of Schlick's Fresnel, (1 + 20 f0)/21: the weight's own average is 2
/// (1/6 - 1/7) = 1/21.
pub fn schlick_average(f0: f64) -> f64 {
    (1.0 + 20.0 * f0) / 21.0
}

/// Squared amplitudes (s, p) of an interface of relative index `eta` = n_view/n_far at incidence of
/// cosine c and squared sine s2, c_t the cosine of refraction and `contrast` = 1 - eta^2.
///
/// The textbook amplitudes have numerators that cancel as eta -> 1; both are rewritten with
/// c_t - eta c = contrast/(c_t + eta c): r_s = (eta c - c_t)/(eta c + c_t) = -contrast/(eta
/// c + c_t)^2, r_p = (c - eta c_t)/(c + eta c_t), c^2 - eta^2 c_t^2 = (1 - eta^2)(c^2
/// (1 + eta^2) - eta^2) = contrast (c^2 - eta^2 s^2).
#[inline(always)]
pub fn unpolarised(eta: f64, contrast: f64, c: f64, s2: f64, c_t: f64) -> f64 {
    let (sum_s, sum_p) = (eta * c + c_t, c + eta * c_t);
    let r_s = contrast / (sum_s * sum_s);
    let r_p = contrast * (c * c - eta * eta * s2) / (sum_p * sum_p);
    0.5 * (r_s * r_s + r_p * r_p)
}

/// Unpolarised reflectance of a dielectric of index `ior` >= 1 seen from outside at the cosine c in
/// [0, 1]: f0 at c = 1, 1 at c = 0 for ior > 1, and 0 everywhere for ior = 1. Born and Wolf,
/// Principles of Optics, sec. 1.5.2.
pub fn dielectric(ior: f64, c: f64) -> f64 {
    let contrast = (ior - 1.0) * (ior + 1.0) / (ior * ior);
    if contrast == 0.0 {
        return 0.0;
    }
    let eta = 1.0 / ior;
    let c_t = (contrast + eta * eta * c * c).sqrt();
    unpolarised(eta, contrast, c, (1.0 - c) * (1.0 + c), c_t)
}

/// 2 int_0^1 F(c) c dc of [`dielectric`], to 1e-12: panels graded to the branch point at c = i
/// sqrt(ior^2 - 1); 0 at ior = 1, NaN below it. Duntley 1942 has it in closed form, which cancels near
/// ior = 1.
pub fn dielectric_average(ior: f64) -> f64 {
    static RULE: LazyLock<Gauss> = LazyLock::new(|| Gauss::new(24));
    let branch = ((ior - 1.0) * (ior + 1.0)).sqrt();
    if branch == 0.0 || branch.is_nan() {
        return branch;
    }
    let cuts = panels::from_zero(1.0, branch);
    let part = |cut: &[f64]| RULE.integrate(cut[0], cut[1], |c| 2.0 * c * dielectric(ior, c));
    cuts.windows(2).map(part).sum()
}

/// Unpolarised reflectance of a conductor of complex index eta + i k (eta > 0, k >= 0, relative to
/// outside) at the cosine c in [0, 1]; 1 at c = 0, and without absorption from the critical angle on. Born
/// and Wolf, sec. 14.2, with (a + i b)^2 = eta^2 - k^2 - s^2 + 2 i eta k: R_s = ((a - c)^2 + b^2)/((a + c)^2
/// + b^2), and R_p = R_s |s^2 - c (a + i b)|^2/|s^2 + c (a + i b)|^2.
///
/// Of a and b the larger is a root and the other follows from a b = eta k. The difference of a and c
/// cancels near an index of 1; where a is the larger of both roots, it is taken from a^2 - c^2 =
/// (eta - 1)(eta + 1) - k^2 + b^2, of small numbers, over a + c.
pub fn conductor(eta: f64, k: f64, c: f64) -> f64 {
    let (s2, product) = ((1.0 - c) * (1.0 + c), eta * k);
    let contrast = (eta - 1.0) * (eta + 1.0) - k * k;
    let real = real_part(eta, k, c);
    let larger = (0.5 * ((real * real + 4.0 * product * product).sqrt() + real.abs())).sqrt();
    // Both are 0 at the critical angle itself.
    let smaller = if larger == 0.0 { 0.0 } else { product / larger };
    let (a, b, difference) = if real >= 0.0 {
        (larger, smaller, (contrast + smaller * smaller) / (larger + c))
    } else {
        (smaller, larger, smaller - c)
    };
    let (less, more) = (difference * difference + b * b, (a + c) * (a + c) + b * b);
    let (minus, plus) = (s2 - c * a, s2 + c * a);
    let absorbed = c * c * b * b;
    0.5 * (less / more) * (1.0 + (minus * minus + absorbed) / (plus * plus + absorbed))
}

/// eta^2 + c^2 - 1 - k^2, summed with twice the digits. Without absorption it goes through 0 at the critical
/// angle of an index below 1, and the reflectance falls from 1 with its root: of a plain sum half of the
/// digits would be left. A fused product has what squaring rounds off, Knuth's sum of two what adding does.
fn real_part(eta: f64, k: f64, c: f64) -> f64 {
    let (mut sum, mut rest) = (-1.0, 0.0);
    for (sign, x) in [(1.0, eta), (1.0, c), (-1.0, k)] {
        let square = sign * x * x;
        let next = sum + square;
        let added = next - sum;
        rest += (sum - (next - added)) + (square - added) + (sign * x).mul_add(x, -square);
        sum = next;
    }
    sum + rest
}

/// Reflectance of [`conductor`] at normal incidence, ((eta - 1)^2 + k^2)/((eta + 1)^2 + k^2).
pub fn f0_of_conductor(eta: f64, k: f64) -> f64 {
    let (less, more) = (eta - 1.0, eta + 1.0);
    (less * less + k * k) / (more * more + k * k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert!((f0_of_ior(1.5) - 0.04).abs() < 1e-16);
        assert_eq!(f0_of_ior(1.0), 0.0);
        assert_eq!(schlick_weight(1.0), 1.0);
        assert_eq!(schlick_weight(0.5), 0.03125);
    }

    #[test]
    fn dielectric_ends_and_average_are_the_closed_forms() {
        for n in [1.0001, 1.2, 1.5, 2.5] {
            assert!((dielectric(n, 1.0) - f0_of_ior(n)).abs() < 1e-15);
            assert!((dielectric(n, 0.0) - 1.0).abs() < 1e-12, "{n}: {}", dielectric(n, 0.0));
        }
        assert_eq!((dielectric(1.0, 0.3), dielectric_average(1.0)), (0.0, 0.0));
        for n in [1.2, 1.33, 1.5, 2.0, 2.5_f64] {
            let (n2, n4) = (n * n, n * n * n * n);
            let closed = 0.5
                + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
                + n2 * (n2 - 1.0) * (n2 - 1.0) / ((n2 + 1.0) * (n2 + 1.0) * (n2 + 1.0))
                    * lobefit_math::ops::log((n - 1.0) / (n + 1.0))
                - 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0))
                + 8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0) * (n4 - 1.0)) * lobefit_math::ops::log(n);
            assert!((dielectric_average(n) - closed).abs() < 1e-12, "{n}: {}", dielectric_average(n));
        }
    }

    #[test]
    fn a_conductor_has_its_f0_and_becomes_a_dielectric_without_absorption() {
        assert!((conductor(0.2, 3.0, 1.0) - f0_of_conductor(0.2, 3.0)).abs() < 1e-14);
        assert!((conductor(0.2, 3.0, 0.0) - 1.0).abs() < 1e-14);
        for c in [0.05, 0.3, 0.7, 1.0] {
            assert!((conductor(1.5, 1e-9, c) - dielectric(1.5, c)).abs() < 1e-8, "{c}");
        }
    }
}
