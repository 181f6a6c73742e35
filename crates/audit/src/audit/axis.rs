//! How an axis of somebody's table may be read: which input runs along it, what its coordinate
//! means, and where texel i lies.

use lobefit_math::ops;

/// An input of a quantity that may run along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Input {
    /// GGX width.
    Alpha,
    /// Cosine between normal and view.
    Mu,
    /// Index of refraction, inside over outside.
    Ior,
    /// Squared cosine of the view's azimuth from the alpha_x axis: of tables that say so, no axis
    /// of which it runs along.
    Azimuth,
    /// Anisotropy a: aspect = sqrt(1 - 0.9 a), alpha_x = alpha/aspect, alpha_y = alpha aspect.
    Anisotropy,
}

impl Input {
    /// Its name in places and curves.
    pub fn name(self) -> &'static str {
        match self {
            Input::Alpha => "alpha",
            Input::Mu => "mu",
            Input::Ior => "ior",
            Input::Anisotropy => "anisotropy",
            Input::Azimuth => "cos2_phi",
        }
    }

    /// The coordinates that tables use for it.
    pub fn scales(self) -> &'static [Scale] {
        match self {
            Input::Alpha => &[Scale::Roughness, Scale::Alpha, Scale::RoughnessFourth, Scale::AlphaSquared],
            Input::Mu => &[Scale::Mu, Scale::RootMu, Scale::Theta, Scale::RootOfOneMinusMu, Scale::MuSquared],
            Input::Ior => &[
                Scale::IorUnit,
                Scale::IorOneAndHalf,
                Scale::IorTwo,
                Scale::F0,
                Scale::RootF0,
                Scale::FourthRootF0,
                Scale::IorInverse,
                Scale::IorInverseTwo,
            ],
            Input::Anisotropy => &[Scale::Anisotropy, Scale::AnisotropySquared, Scale::Aspect],
            Input::Azimuth => &[],
        }
    }
}

/// What a coordinate x in [0, 1] means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// alpha = x.
    Alpha,
    /// alpha = x^2.
    Roughness,
    /// alpha = x^4.
    RoughnessFourth,
    /// alpha = sqrt(x).
    AlphaSquared,
    /// mu = x.
    Mu,
    /// mu = x^2.
    RootMu,
    /// mu = cos(x pi/2).
    Theta,
    /// mu = 1 - x^2.
    RootOfOneMinusMu,
    /// mu = sqrt(x).
    MuSquared,
    /// The index itself, from 1 to 2: an argument of a function that is named for it.
    Ior,
    /// The index the other way round, eta = 1/ior, from 1/2 to 1 as ior falls from 2: an argument
    /// of a function that is named for an index.
    Eta,
    /// ior = 1 + x.
    IorUnit,
    /// ior = 1 + 1.5 x.
    IorOneAndHalf,
    /// ior = 1 + 2 x.
    IorTwo,
    /// ior = (1 + sqrt(F0))/(1 - sqrt(F0)) with F0 = x.
    F0,
    /// The same with F0 = x^2.
    RootF0,
    /// The same with F0 = x^4.
    FourthRootF0,
    /// ior = 1/x, infinite at 0.
    IorInverse,
    /// ior = 2/(1 + x).
    IorInverseTwo,
    /// anisotropy = x.
    Anisotropy,
    /// anisotropy = sqrt(x).
    AnisotropySquared,
    /// sqrt(1 - 0.9 anisotropy) = x.
    Aspect,
}

/// Every scale, for options.
pub const SCALES: [Scale; 22] = [
    Scale::Alpha,
    Scale::Roughness,
    Scale::RoughnessFourth,
    Scale::AlphaSquared,
    Scale::Mu,
    Scale::RootMu,
    Scale::Theta,
    Scale::RootOfOneMinusMu,
    Scale::MuSquared,
    Scale::Ior,
    Scale::Eta,
    Scale::IorUnit,
    Scale::IorOneAndHalf,
    Scale::IorTwo,
    Scale::F0,
    Scale::RootF0,
    Scale::FourthRootF0,
    Scale::IorInverse,
    Scale::IorInverseTwo,
    Scale::Anisotropy,
    Scale::AnisotropySquared,
    Scale::Aspect,
];

impl Scale {
    /// The input that it is a coordinate of.
    pub fn input(self) -> Input {
        match self {
            Scale::Alpha | Scale::Roughness | Scale::RoughnessFourth | Scale::AlphaSquared => Input::Alpha,
            Scale::Mu | Scale::RootMu | Scale::Theta | Scale::RootOfOneMinusMu | Scale::MuSquared => {
                Input::Mu
            }
            Scale::Anisotropy | Scale::AnisotropySquared | Scale::Aspect => Input::Anisotropy,
            _ => Input::Ior,
        }
    }

    /// The word in options and verdicts.
    pub fn name(self) -> &'static str {
        match self {
            Scale::Alpha => "alpha",
            Scale::Roughness => "roughness",
            Scale::RoughnessFourth => "alpha^(1/4)",
            Scale::AlphaSquared => "alpha^2",
            Scale::Mu => "mu",
            Scale::RootMu => "sqrt(mu)",
            Scale::Theta => "theta",
            Scale::RootOfOneMinusMu => "sqrt(1-mu)",
            Scale::MuSquared => "mu^2",
            Scale::Ior => "ior",
            Scale::Eta => "eta",
            Scale::IorUnit => "ior-1",
            Scale::IorOneAndHalf => "(ior-1)/1.5",
            Scale::IorTwo => "(ior-1)/2",
            Scale::F0 => "F0",
            Scale::RootF0 => "sqrt(F0)",
            Scale::FourthRootF0 => "F0^(1/4)",
            Scale::IorInverse => "1/ior",
            Scale::IorInverseTwo => "2/ior-1",
            Scale::Anisotropy => "anisotropy",
            Scale::AnisotropySquared => "anisotropy^2",
            Scale::Aspect => "aspect",
        }
    }

    /// What the name leaves open; may be empty.
    pub fn note(self) -> &'static str {
        match self {
            Scale::Roughness => "alpha = roughness^2",
            Scale::Theta => "mu = cos(x pi/2)",
            Scale::F0 | Scale::RootF0 | Scale::FourthRootF0 => "F0 of normal incidence",
            Scale::Eta => "eta = 1/ior",
            Scale::Aspect => "aspect = sqrt(1 - 0.9 anisotropy)",
            _ => "",
        }
    }

    /// The input at a coordinate in [0, 1].
    pub fn input_at(self, x: f64) -> f64 {
        match self {
            Scale::Alpha | Scale::Mu | Scale::Anisotropy => x,
            Scale::Roughness | Scale::RootMu => x * x,
            Scale::RoughnessFourth => x * x * x * x,
            Scale::AlphaSquared | Scale::MuSquared | Scale::AnisotropySquared => x.sqrt(),
            // cos(pi/2) is 6e-17 in f64, the grazing view.
            Scale::Theta if x == 1.0 => 0.0,
            Scale::Theta => ops::cos(0.5 * std::f64::consts::PI * x),
            Scale::RootOfOneMinusMu => (1.0 - x) * (1.0 + x),
            Scale::Ior | Scale::IorUnit => 1.0 + x,
            Scale::IorOneAndHalf => 1.0 + 1.5 * x,
            Scale::IorTwo => 1.0 + 2.0 * x,
            Scale::F0 => ior_of(x.sqrt()),
            Scale::RootF0 => ior_of(x),
            Scale::FourthRootF0 => ior_of(x * x),
            Scale::IorInverse => 1.0 / x,
            Scale::Eta | Scale::IorInverseTwo => 2.0 / (1.0 + x),
            Scale::Aspect => ((1.0 - x * x) / 0.9).clamp(0.0, 1.0),
        }
    }
}

/// The index of refraction whose F0 is the square of this root; infinite at 1.
fn ior_of(root: f64) -> f64 {
    (1.0 + root) / (1.0 - root)
}

/// Where texel i of n lies on its axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Registration {
    /// (i + 1/2)/n: where a texture unit looks.
    Centre,
    /// i/(n - 1).
    Endpoint,
    /// i/n.
    Left,
    /// (i + 1)/n.
    Right,
    /// (i + 3/2)/n, clamped to 1: a texel above its centre.
    OneHigh,
    /// (i - 1/2)/n, clamped to 0: a texel below its centre.
    OneLow,
    /// (i + 1)/(n - 1), clamped to 1: a texel above its end point.
    EndHigh,
    /// (i - 1)/(n - 1), clamped to 0: a texel below its end point.
    EndLow,
}

/// Every registration, the usual ones first.
pub const REGISTRATIONS: [Registration; 8] = [
    Registration::Centre,
    Registration::Endpoint,
    Registration::Left,
    Registration::Right,
    Registration::OneHigh,
    Registration::OneLow,
    Registration::EndHigh,
    Registration::EndLow,
];

impl Registration {
    /// The word in options.
    pub fn name(self) -> &'static str {
        match self {
            Registration::Centre => "centre",
            Registration::Endpoint => "endpoint",
            Registration::Left => "left",
            Registration::Right => "right",
            Registration::OneHigh => "one-high",
            Registration::OneLow => "one-low",
            Registration::EndHigh => "end-high",
            Registration::EndLow => "end-low",
        }
    }

    /// The registration that a reader assumes without documentation: centres, or end points where
    /// the texels lie about end points.
    pub fn plain(self) -> Registration {
        match self {
            Registration::Endpoint | Registration::EndHigh | Registration::EndLow => Registration::Endpoint,
            _ => Registration::Centre,
        }
    }

    /// In words and as a formula.
    pub fn words(self) -> &'static str {
        match self {
            Registration::Centre => "texel centres, (i + 1/2)/n",
            Registration::Endpoint => "end points, i/(n - 1)",
            Registration::Left => "left edges, i/n",
            Registration::Right => "right edges, (i + 1)/n",
            Registration::OneHigh => "one texel above the centres, (i + 3/2)/n",
            Registration::OneLow => "one texel below the centres, (i - 1/2)/n",
            Registration::EndHigh => "one texel above the end points, (i + 1)/(n - 1)",
            Registration::EndLow => "one texel below the end points, (i - 1)/(n - 1)",
        }
    }

    /// Coordinate of texel i of n, in [0, 1].
    pub fn coordinate(self, i: usize, n: usize) -> f64 {
        let (i, n) = (i as f64, n as f64);
        match self {
            Registration::Centre => (i + 0.5) / n,
            Registration::Endpoint | Registration::EndHigh | Registration::EndLow if n < 2.0 => 0.0,
            Registration::Endpoint => i / (n - 1.0),
            Registration::EndHigh => ((i + 1.0) / (n - 1.0)).min(1.0),
            Registration::EndLow => ((i - 1.0) / (n - 1.0)).max(0.0),
            Registration::Left => i / n,
            Registration::Right => (i + 1.0) / n,
            Registration::OneHigh => ((i + 1.5) / n).min(1.0),
            Registration::OneLow => ((i - 0.5) / n).max(0.0),
        }
    }

    /// Position in texels of a coordinate, clamped to the table's edge.
    pub fn position(self, x: f64, n: usize) -> f64 {
        let n = n as f64;
        let p = match self {
            Registration::Centre => x * n - 0.5,
            Registration::Endpoint => x * (n - 1.0),
            Registration::Left => x * n,
            Registration::Right => x * n - 1.0,
            Registration::OneHigh => x * n - 1.5,
            Registration::OneLow => x * n + 0.5,
            Registration::EndHigh => x * (n - 1.0) - 1.0,
            Registration::EndLow => x * (n - 1.0) + 1.0,
        };
        p.clamp(0.0, n - 1.0)
    }
}

/// One way to read an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisReading {
    /// What its coordinate means.
    pub scale: Scale,
    /// Where its texels lie.
    pub registration: Registration,
    /// Whether the coordinate falls from the first texel to the last.
    pub reversed: bool,
    /// Least value that the input was clamped to; 0 for none.
    pub floor: f64,
}

impl AxisReading {
    /// Without a floor.
    pub fn new(scale: Scale, registration: Registration, reversed: bool) -> AxisReading {
        AxisReading { scale, registration, reversed, floor: 0.0 }
    }

    /// Coordinate of texel i of n.
    pub fn coordinate(&self, i: usize, n: usize) -> f64 {
        self.registration.coordinate(if self.reversed { n - 1 - i } else { i }, n)
    }

    /// The input at texel i of n.
    pub fn node(&self, i: usize, n: usize) -> f64 {
        self.scale.input_at(self.coordinate(i, n)).max(self.floor)
    }

    /// Position in texels of a coordinate, with a registration of the reader's own.
    pub fn position(&self, x: f64, n: usize, registration: Registration) -> f64 {
        let p = registration.position(x, n);
        if self.reversed { (n - 1) as f64 - p } else { p }
    }

    /// Whether two readings differ in their floor alone.
    pub fn like(&self, other: &AxisReading) -> bool {
        AxisReading { floor: 0.0, ..*self } == AxisReading { floor: 0.0, ..*other }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_undo_coordinates() {
        for registration in REGISTRATIONS {
            for i in 1..7 {
                let back = registration.position(registration.coordinate(i, 9), 9);
                assert!((back - i as f64).abs() < 1e-12, "{registration:?} {i}: {back}");
            }
        }
    }

    #[test]
    fn scales_cover_their_inputs() {
        for scale in SCALES {
            // No axis of a table runs over an index itself, nor over its inverse from 1/2.
            assert!(
                matches!(scale, Scale::Ior | Scale::Eta) || scale.input().scales().contains(&scale),
                "{scale:?}"
            );
        }
        assert!((Scale::FourthRootF0.input_at(0.04_f64.sqrt().sqrt()) - 1.5).abs() < 1e-12);
        assert_eq!(Scale::Theta.input_at(1.0), 0.0);
    }
}
