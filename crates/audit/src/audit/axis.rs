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

    /// The coordinates that tables use for it: no axis of a table runs over an index itself, nor over
    /// its inverse from 1/2.
    pub fn scales(self) -> impl Iterator<Item = Scale> {
        SCALES.into_iter().filter(move |s| s.input() == self && !matches!(s, Scale::Ior | Scale::Eta))
    }
}

/// Scales, of those of an input the usual ones first: the input that each is a coordinate of, the word in
/// options and verdicts, the input at a coordinate in [0, 1].
macro_rules! scales {
    ($($(#[$doc:meta])* $name:ident: $input:ident, $word:literal, $at:expr;)*) => {
        /// What a coordinate x in [0, 1] means.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Scale {
            $(#[doc = concat!("x = ", $word, ".")] $(#[$doc])* $name,)*
            /// An input between two ends, which the user states or its slices show.
            Span(&'static Span),
        }

        /// Every scale; of those of an input the usual ones first.
        pub const SCALES: [Scale; [$($word),*].len()] = [$(Scale::$name),*];

        impl Scale {
            /// The input that it is a coordinate of, the word in options and verdicts, the input at a
            /// coordinate in [0, 1].
            fn facts(self) -> (Input, &'static str, fn(f64) -> f64) {
                match self {
                    $(Scale::$name => (Input::$input, $word, $at),)*
                    // The share of the way between its ends.
                    Scale::Span(span) => (span.input, &span.name, |x| x),
                }
            }
        }
    };
}

scales! {
    Roughness: Alpha, "roughness", |x| x * x;
    Alpha: Alpha, "alpha", |x| x;
    RoughnessThird: Alpha, "alpha^(1/3)", |x| x * x * x;
    RoughnessFourth: Alpha, "alpha^(1/4)", |x| x * x * x * x;
    AlphaSquared: Alpha, "alpha^2", f64::sqrt;
    Mu: Mu, "mu", |x| x;
    RootMu: Mu, "sqrt(mu)", |x| x * x;
    // cos(pi/2) is 6e-17 in f64, the grazing view.
    /// mu = cos(x pi/2).
    Theta: Mu, "theta", |x| if x == 1.0 { 0.0 } else { ops::cos(0.5 * std::f64::consts::PI * x) };
    RootOfOneMinusMu: Mu, "sqrt(1-mu)", |x| (1.0 - x) * (1.0 + x);
    MuSquared: Mu, "mu^2", f64::sqrt;
    /// The index itself, from 1 to 2: an argument of a function that is named for it.
    Ior: Ior, "ior", |x| 1.0 + x;
    /// The index the other way round, 1/ior, from 1/2 to 1 as ior falls from 2: an argument of a function
    /// that is named for an index.
    Eta: Ior, "eta", |x| 2.0 / (1.0 + x);
    IorUnit: Ior, "ior-1", |x| 1.0 + x;
    IorOneAndHalf: Ior, "(ior-1)/1.5", |x| 1.0 + 1.5 * x;
    IorTwo: Ior, "(ior-1)/2", |x| 1.0 + 2.0 * x;
    /// MoonRay's tables of transmission, as they are looked up.
    IorFromTwo: Ior, "(ior-1.05)/2", |x| 1.05 + 2.0 * x;
    /// The same as their comment has it.
    IorFromToThree: Ior, "(ior-1.05)/1.95", |x| 1.05 + 1.95 * x;
    /// Two halves: from inside with ior falling from 2.5 to 1, then from outside with ior rising from
    /// 1 to 2.5 (Adobe's OpenPBR BSDF). Below 1 the input is 1/ior.
    IorBothSides: Ior, "1/ior..ior", |x| if x < 0.5 { 1.0 / (2.5 - 3.0 * x) } else { 3.0 * x - 0.5 };
    /// ior = (1 + sqrt(F0))/(1 - sqrt(F0)).
    F0: Ior, "f0", |x| ior_of(x.sqrt());
    RootF0: Ior, "sqrt(f0)", ior_of;
    FourthRootF0: Ior, "f0^(1/4)", |x| ior_of(x * x);
    /// Infinite at 0.
    IorInverse: Ior, "1/ior", |x| 1.0 / x;
    IorInverseTwo: Ior, "2/ior-1", |x| 2.0 / (1.0 + x);
    Anisotropy: Anisotropy, "anisotropy", |x| x;
    AnisotropySquared: Anisotropy, "anisotropy^2", f64::sqrt;
    /// sqrt(1 - 0.9 anisotropy).
    Aspect: Anisotropy, "aspect", |x| ((1.0 - x * x) / 0.9).clamp(0.0, 1.0);
}

/// An input that runs evenly between two ends.
#[derive(Clone, Debug)]
pub struct Span {
    /// The input.
    pub input: Input,
    /// Its values at the coordinates 0 and 1.
    pub ends: [f64; 2],
    /// The word in options: `ior=1.1..2.2`.
    pub name: String,
    /// Whether the user states it.
    pub is_stated: bool,
    /// Whether the ends are those of its root: of a roughness, whose square alpha is.
    pub is_root: bool,
}

impl Span {
    /// Options and audits live as long as the program.
    fn scale(self) -> Scale {
        Scale::Span(Box::leak(Box::new(self)))
    }
}

impl PartialEq for Span {
    fn eq(&self, other: &Span) -> bool {
        self.name == other.name
    }
}

impl Eq for Span {}

impl Scale {
    /// Evenly between two ends of an input.
    pub fn between(input: Input, [low, high]: [f64; 2], is_stated: bool) -> Scale {
        let name = format!("{}={low}..{high}", input.name());
        Span { input, ends: [low, high], name, is_stated, is_root: false }.scale()
    }

    /// Evenly between two roughnesses.
    pub fn between_roughnesses([low, high]: [f64; 2], is_stated: bool) -> Scale {
        let name = format!("{}={low}..{high}", Scale::Roughness.name());
        Span { input: Input::Alpha, ends: [low, high], name, is_stated, is_root: true }.scale()
    }

    /// The input that it is a coordinate of.
    pub fn input(self) -> Input {
        self.facts().0
    }

    /// The word in options and verdicts.
    pub fn name(self) -> &'static str {
        self.facts().1
    }

    /// The input at a coordinate in [0, 1].
    pub fn input_at(self, x: f64) -> f64 {
        let x = self.facts().2(x);
        let Scale::Span(Span { ends: [low, high], is_root, .. }) = self else { return x };
        let x = low + (high - low) * x;
        if *is_root { x * x } else { x }
    }

    /// Whether it runs over both sides of a surface.
    pub fn is_of_both_sides(self) -> bool {
        self == Scale::IorBothSides
    }

    /// What the name leaves open; may be empty.
    pub fn note(self) -> &'static str {
        match self {
            Scale::Roughness => "alpha = roughness^2",
            Scale::Theta => "mu = cos(x pi/2)",
            Scale::F0 | Scale::RootF0 | Scale::FourthRootF0 => "f0 at normal incidence",
            Scale::Eta => "eta = 1/ior",
            Scale::Aspect => "aspect = sqrt(1 - 0.9 anisotropy)",
            Scale::Span(span) if !span.is_stated => "by its slices, as no range is stated",
            Scale::IorBothSides => "ior 2.5 falling to 1 from inside, then rising to 2.5 from outside",
            _ => "",
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
    /// a and b of (i + a)/(n - b), the word in options, and that in words and as a formula.
    fn facts(self) -> ([f64; 2], &'static str, &'static str) {
        match self {
            Registration::Centre => ([0.5, 0.0], "centre", "texel centres, (i + 1/2)/n"),
            Registration::Endpoint => ([0.0, 1.0], "endpoint", "end points, i/(n - 1)"),
            Registration::Left => ([0.0, 0.0], "left", "left edges, i/n"),
            Registration::Right => ([1.0, 0.0], "right", "right edges, (i + 1)/n"),
            Registration::OneHigh => ([1.5, 0.0], "one-high", "one texel above the centres, (i + 3/2)/n"),
            Registration::OneLow => ([-0.5, 0.0], "one-low", "one texel below the centres, (i - 1/2)/n"),
            Registration::EndHigh => {
                ([1.0, 1.0], "end-high", "one texel above the end points, (i + 1)/(n - 1)")
            }
            Registration::EndLow => {
                ([-1.0, 1.0], "end-low", "one texel below the end points, (i - 1)/(n - 1)")
            }
        }
    }

    /// The word in options.
    pub fn name(self) -> &'static str {
        self.facts().1
    }

    /// In words and as a formula.
    pub fn words(self) -> &'static str {
        self.facts().2
    }

    /// The registration that a reader assumes without documentation: centres, or end points where
    /// the texels lie about end points.
    pub fn plain(self) -> Registration {
        if self.facts().0[1] == 1.0 { Registration::Endpoint } else { Registration::Centre }
    }

    /// The registration of the same texels counted from the other end.
    pub fn mirrored(self) -> Registration {
        let [shift, ends] = self.facts().0;
        let other = [1.0 - ends - shift, ends];
        REGISTRATIONS.into_iter().find(|r| r.facts().0 == other).unwrap_or(self)
    }

    /// Coordinate of texel i of n, clamped to [0, 1].
    pub fn coordinate(self, i: usize, n: usize) -> f64 {
        let [shift, ends] = self.facts().0;
        ((i as f64 + shift) / (n as f64 - ends).max(1.0)).clamp(0.0, 1.0)
    }

    /// Position in texels of a coordinate, clamped to the table's edge.
    pub fn position(self, x: f64, n: usize) -> f64 {
        let ([shift, ends], n) = (self.facts().0, n as f64);
        (x * (n - ends) - shift).clamp(0.0, n - 1.0)
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

    /// Coordinate of texel i of n; of an axis over both sides each half has ends of its own.
    pub fn coordinate(&self, i: usize, n: usize) -> f64 {
        let (i, half) = (if self.reversed { n - 1 - i } else { i }, n / 2);
        match self.scale.is_of_both_sides() {
            false => self.registration.coordinate(i, n),
            true if i < half => 0.5 - 0.5 * self.registration.coordinate(half - 1 - i, half),
            true => 0.5 + 0.5 * self.registration.coordinate(i - half, n - half),
        }
    }

    /// The input at texel i of n.
    pub fn node(&self, i: usize, n: usize) -> f64 {
        self.scale.input_at(self.coordinate(i, n)).max(self.floor)
    }

    /// Position in texels of a coordinate, with a registration of the reader's own.
    pub fn position(&self, x: f64, n: usize, registration: Registration) -> f64 {
        let half = n / 2;
        let p = match self.scale.is_of_both_sides() {
            false => registration.position(x, n),
            true if x < 0.5 => (half - 1) as f64 - registration.position(1.0 - 2.0 * x, half),
            true => half as f64 + registration.position(2.0 * x - 1.0, n - half),
        };
        if self.reversed { (n - 1) as f64 - p } else { p }
    }

    /// Whether two readings differ in their floor alone.
    pub fn like(&self, other: &AxisReading) -> bool {
        AxisReading { floor: 0.0, ..*self } == AxisReading { floor: 0.0, ..*other }
    }
}
