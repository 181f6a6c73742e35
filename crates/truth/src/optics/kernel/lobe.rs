//! A lobe of some width: energies, densities, quantiles.

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::Kernel;
use super::tabulated::Blend;
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;

/// A lobe of some width.
#[derive(Clone, Debug)]
pub struct Lobe {
    form: Form,
    a2: f64,
    /// The unnormalised energy of the hemisphere.
    whole: f64,
}

/// What a kernel is of one width.
#[derive(Clone, Debug)]
enum Form {
    Ndf,
    Half,
    HalfCosine,
    Table(Blend),
}

/// Widths whose square lies between this and its inverse are integrated by a rule: closed forms
/// cancel at alpha = 1.
const NEAR_ONE: f64 = 0.5;

/// Newton's steps or, where one leaves the interval, halvings: far more than are taken.
const QUANTILE_STEPS: usize = 200;

/// On [0, u <= 1] the density's poles -A <= -1/2 and -1 leave (2 + sqrt 3)^-32 = 5e-19.
static RULE: LazyLock<Gauss> = LazyLock::new(|| Gauss::new(16));

impl Lobe {
    pub(super) fn new(kernel: &Kernel, alpha: f64) -> Lobe {
        let form = match kernel {
            Kernel::Ndf => Form::Ndf,
            Kernel::Half => Form::Half,
            Kernel::HalfCosine => Form::HalfCosine,
            Kernel::Tabulated(table) => Form::Table(Blend::new(table, alpha)),
        };
        let mut lobe = Lobe { form, a2: alpha * alpha, whole: 1.0 };
        lobe.whole = lobe.within(1.0);
        lobe
    }

    /// The share of energy inside a cone, by the tangent t >= 0 of its angle; an infinite tangent
    /// is the horizon, where it is 1. Absolute error below 1e-14, of a table's lobe as it is
    /// interpolated.
    pub fn encircled(&self, t: f64) -> f64 {
        self.within(half_tangent2(t)) / self.whole
    }

    /// The derivative of [`Lobe::encircled`] by ln t.
    pub fn slope(&self, t: f64) -> f64 {
        let u = half_tangent2(t);
        // du/d ln t = 2 u (1 - u)/(1 + u)
        self.density(u) * 2.0 * u * (1.0 - u) / (1.0 + u) / self.whole
    }

    /// The u = tan^2(theta/2) of the cone that holds a share `energy` in [0, 1]; to 1e-12 of
    /// itself.
    pub fn quantile(&self, energy: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        // what `half` holds: the other two are near it where they are narrow
        let wanted = energy.clamp(0.0, 1.0);
        let mut u = (self.a2 * wanted / (1.0 + self.a2 - wanted)).clamp(f64::MIN_POSITIVE, 1.0);
        for _ in 0..QUANTILE_STEPS {
            let off = self.within(u) / self.whole - wanted;
            if off > 0.0 {
                high = u
            } else {
                low = u
            }
            let next = u - off * self.whole / self.density(u);
            let inside = next > low && next < high;
            let next = if inside { next } else { 0.5 * (low + high) };
            if (next - u).abs() <= 1e-13 * u {
                return next;
            }
            u = next;
        }
        u
    }

    /// The share of energy per solid angle at u = tan^2(theta/2) in [0, 1]: dc = -2/(1 + u)^2 du.
    pub fn per_solid_angle(&self, u: f64) -> f64 {
        self.density(u) * (1.0 + u) * (1.0 + u) / (4.0 * PI * self.whole)
    }

    /// Unnormalised density over u.
    fn density(&self, u: f64) -> f64 {
        let a2 = self.a2;
        match &self.form {
            Form::Ndf => {
                let across = self.across(u) * (1.0 + u);
                2.0 / (across * across)
            }
            Form::Half => 2.0 / ((a2 + u) * (a2 + u)),
            Form::HalfCosine => (1.0 - u) / ((a2 + u) * (a2 + u) * (1.0 + u)),
            Form::Table(blend) => blend.density(a2, u),
        }
    }

    /// 1 - (1-A) c^2 = A + (1-A) sin^2(theta).
    fn across(&self, u: f64) -> f64 {
        self.a2 + (1.0 - self.a2) * 4.0 * u / ((1.0 + u) * (1.0 + u))
    }

    /// Unnormalised energy from the axis to u in [0, 1].
    fn within(&self, u: f64) -> f64 {
        let a2 = self.a2;
        match &self.form {
            Form::Half => 2.0 * u / (a2 * (a2 + u)),
            Form::Table(blend) => blend.within(a2, u),
            _ if (NEAR_ONE..=1.0 / NEAR_ONE).contains(&a2) => RULE.integrate(0.0, u, |v| self.density(v)),
            Form::Ndf => self.beyond(0.0) - self.beyond(u),
            Form::HalfCosine => {
                let rest = 1.0 - a2;
                let logarithms = ops::log1p(u) - ops::log1p(u / a2);
                2.0 / (rest * rest) * logarithms + (1.0 + a2) / rest * u / (a2 * (a2 + u))
            }
        }
    }

    /// int_0^c dx/(1 - k x^2)^2 = c/(2 (1 - k c^2)) + artanh(sqrt(k) c)/(2 sqrt(k)), k = 1 - A: the
    /// energy of `ndf` beyond u.
    fn beyond(&self, u: f64) -> f64 {
        let (k, c, across) = (1.0 - self.a2, (1.0 - u) / (1.0 + u), self.across(u));
        let y = k.abs().sqrt() * c;
        // artanh y = ln((1 + y)^2/(1 - y^2))/2, and 1 - y^2 is `across`, which does not cancel
        let inverse = if k > 0.0 { 0.5 * ops::log((1.0 + y) * (1.0 + y) / across) } else { ops::atan(y) };
        0.5 * (c / across + inverse / k.abs().sqrt())
    }
}

/// tan^2(theta/2) of a tangent: (t/(1 + sqrt(1 + t^2)))^2, without overflow.
fn half_tangent2(t: f64) -> f64 {
    let half = if t > 1.0 {
        let inverse = 1.0 / t;
        1.0 / (inverse + (1.0 + inverse * inverse).sqrt())
    } else {
        t / (1.0 + (1.0 + t * t).sqrt())
    };
    half * half
}
