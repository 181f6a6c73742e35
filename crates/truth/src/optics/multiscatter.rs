//! What replaces the light that single scattering on microfacets loses.
//!
//! Notation: E the directional albedo of the lobe for F = 1, loss = 1 - E (passed as such: it is
//! small on smooth surfaces), both with their cosine-weighted averages over the hemisphere.

use std::f64::consts::PI;

/// Multiplier of the single-scattering lobe that makes it lossless at f0 = 1 and adds the colour of
/// a second bounce, 1 + f0 (1/E - 1); 1 at f0 = 0 and where nothing is lost. Fdez-Aguera 2019;
/// Turquin 2019. E > 0.
#[inline(always)]
pub fn compensation(f0: f64, e: f64, loss: f64) -> f64 {
    1.0 + f0 * (loss / e)
}

/// The reciprocal lobe of Kulla and Conty 2017 for F = 1, loss(l) loss(v)/(pi loss_avg), without
/// the cosine: its albedo is the loss. Formed from losses; as alpha -> 0 all three vanish together,
/// and the lobe with them: 0 at loss_avg = 0.
#[inline(always)]
pub fn kulla_conty(loss_l: f64, loss_v: f64, loss_avg: f64) -> f64 {
    if loss_avg == 0.0 { 0.0 } else { loss_l * loss_v / (PI * loss_avg) }
}

/// From which bounce on the colour series of the multiple-scattering lobe counts its reflections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounces {
    /// F_avg E_avg/(1 - F_avg (1 - E_avg)): a form that is also in use. It counts one reflection
    /// less than the light met.
    FromFirst,
    /// F_avg^2 E_avg/(1 - F_avg (1 - E_avg)): the lobe holds only light that met two facets or
    /// more, so that its series sum_(n >= 2) F_avg^n (1 - E_avg)^(n-2) E_avg begins with the
    /// square.
    FromSecond,
}

/// Colour of the multiple-scattering lobe; f_avg the average of Fresnel's reflectance over the
/// hemisphere. 0 at f_avg = 0, 1 at f_avg = 1.
pub fn series(bounces: Bounces, f_avg: f64, e_avg: f64, loss_avg: f64) -> f64 {
    let once = f_avg * e_avg / (1.0 - f_avg * loss_avg);
    match bounces {
        Bounces::FromFirst => once,
        Bounces::FromSecond => f_avg * once,
    }
}

/// 1 - [`series`], without cancellation at f_avg near 1: (1 - f)/(1 - f loss) and (1 - f)(1 + f
/// e)/(1 - f loss).
pub fn absorbed(bounces: Bounces, f_avg: f64, e_avg: f64, loss_avg: f64) -> f64 {
    let once = (1.0 - f_avg) / (1.0 - f_avg * loss_avg);
    match bounces {
        Bounces::FromFirst => once,
        Bounces::FromSecond => once * (1.0 + f_avg * e_avg),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_its_complement_add_up() {
        for bounces in [Bounces::FromFirst, Bounces::FromSecond] {
            for (f, e) in [(0.0, 0.5), (0.3, 0.7), (1.0, 0.4), (0.999, 0.999), (0.5, 1.0)] {
                let sum = series(bounces, f, e, 1.0 - e) + absorbed(bounces, f, e, 1.0 - e);
                assert!((sum - 1.0).abs() < 4e-16, "{bounces:?} {f} {e}: {sum}");
            }
            assert_eq!(series(bounces, 1.0, 0.6, 0.4), 1.0);
        }
    }

    #[test]
    fn the_lobe_vanishes_with_its_losses() {
        assert_eq!(kulla_conty(0.0, 0.0, 0.0), 0.0);
        // all losses scaled by t: the lobe is proportional to t
        let at = |t: f64| kulla_conty(0.2 * t, 0.3 * t, 0.1 * t);
        assert!((at(1e-12) / at(1.0) - 1e-12).abs() < 1e-26);
        assert_eq!(compensation(1.0, 0.5, 0.5), 2.0);
    }
}
