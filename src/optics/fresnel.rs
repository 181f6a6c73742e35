//! Fresnel reflectance.

/// Weight of F90 in Schlick's Fresnel, (1 - c)^5, from 1 - c (pass the difference: it can be had without
/// cancellation). Schlick 1994, eq. 24.
#[inline(always)]
pub fn schlick_weight(one_minus_cosine: f64) -> f64 {
    let square = one_minus_cosine * one_minus_cosine;
    square * square * one_minus_cosine
}

/// Reflectance at normal incidence of a dielectric with relative index of refraction `ior` >= 1: ((n-1)/(n+1))^2.
pub fn f0_of_ior(ior: f64) -> f64 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
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
}
