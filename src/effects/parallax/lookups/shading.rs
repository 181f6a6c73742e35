//! What the lobe of a surface is taken for.

use crate::effects::parallax::room::Seen;
use crate::effects::parallax::width;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, cross, dot, length, minus, normalise, plus, scaled, tangents};

/// A lobe about an axis, round or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingLobe {
    /// Its axis, of unit length.
    pub axis: Vec3,
    /// Its width, the geometric mean of those along and across the plane of incidence.
    pub alpha: f64,
    /// Its half-axes over that mean, at right angles to `axis`: in the plane of incidence and
    /// across it; their lengths' product is 1.
    pub axes: [Vec3; 2],
}

/// What the lobe is taken for.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// Round about the mirror ray, as wide as alpha: what the split sum takes it for.
    Mirror,
    /// Round about the dominant direction of Lagarde and de Rousiers 2014, listing 21, taken in
    /// alpha: the normal and the mirror ray mixed by (1 - alpha)(sqrt(1 - alpha) + alpha).
    Dominant,
    /// Round about the mirror ray, narrower by the root of n.v, which is at least [`LEAST_COSINE`]:
    /// the Jacobian of the half vector, n.v across the plane of incidence and 1 along.
    RootCosine,
    /// As constants say that were fitted to the lobe of GGX.
    Fitted(LobeFit),
}

/// Constants of a lobe over alpha and mu = |n.v|.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct LobeFit {
    /// Share of the normal mixed into the mirror ray: `min(1, lean[0] alpha^lean[1] mu^lean[2])`.
    pub lean: [f64; 3],
    /// Ratio of its footprint to that of the round lobe:
    /// `mu^(narrow[0] - narrow[1] alpha) (1 - narrow[2] alpha)`, at least 0.05.
    pub narrow: [f64; 3],
    /// Width across over width along the plane of incidence: `mu^(squash[0] - squash[1] alpha)`, at
    /// most 1.
    pub squash: [f64; 2],
}

/// Least cosine n.v in a power: 1/mu has no bound, and a lobe has a width.
pub const LEAST_COSINE: f64 = 0.02;

/// Least footprint ratio of a fitted lobe.
pub const NARROWEST: f64 = 0.05;

impl LobeFit {
    /// For one fetch: the lobe is round. The error of these constants, and of those below, is
    /// within 1 % of that of what study `parallax`, "The lobe of a surface", fits: beside its least
    /// error others are next to as good, and those shipped do not follow every change of a rule.
    pub const ONE: LobeFit =
        LobeFit { lean: [0.7323, 1.7068, -0.2953], narrow: [0.2586, 0.5576, 0.079], squash: [0.0, 0.0] };

    /// For two fetches.
    pub const TWO: LobeFit = LobeFit {
        lean: [1.1401, 1.63, -0.1866],
        narrow: [0.3181, 0.5417, -0.4022],
        squash: [0.8107, 1.2472],
    };

    /// For three fetches.
    pub const THREE: LobeFit = LobeFit {
        lean: [1.0167, 1.6196, -0.0081],
        narrow: [0.377, 0.6347, -0.6971],
        squash: [0.8534, 1.2592],
    };

    /// For a number of fetches; of more than three as for three.
    pub fn of(fetches: u32) -> LobeFit {
        match fetches {
            0 | 1 => LobeFit::ONE,
            2 => LobeFit::TWO,
            _ => LobeFit::THREE,
        }
    }

    /// What lookups of that many fetches are expected to be off by in relative L2 against GGX, the
    /// geometric mean over roughness 0.15 to 0.9: of this lobe, and of the round one about the
    /// mirror ray. As the study finds in the room that the constants are fitted in, with smooth
    /// edges of its box.
    pub fn expected(fetches: u32) -> [f64; 2] {
        match fetches {
            0 | 1 => [0.205, 0.225],
            2 => [0.143, 0.197],
            _ => [0.122, 0.195],
        }
    }

    /// Share of the normal in the axis, ratio of the footprint, width across over width along; at
    /// n.v below 0 as at -n.v.
    pub fn at(&self, alpha: f64, mu: f64) -> [f64; 3] {
        let mu = mu.abs().clamp(LEAST_COSINE, 1.0);
        let power = |exponent: f64| ops::pow(mu, exponent);
        let [a, b, c] = self.lean;
        let lean = (a * ops::pow(alpha, b) * power(c)).clamp(0.0, 1.0);
        let [d, e, f] = self.narrow;
        let ratio = (power(d - e * alpha) * (1.0 - f * alpha)).max(NARROWEST);
        let [g, h] = self.squash;
        [lean, ratio, power(g - h * alpha).clamp(LEAST_COSINE, 1.0)]
    }
}

impl Shading {
    /// The lobe at a shading point. Where that is seen from below, the mirror ray goes straight on,
    /// and a fitted lobe is that of the view mirrored in the surface: it stays above that, and does
    /// not jump where n.v changes its sign.
    pub fn lobe(&self, seen: &Seen) -> ShadingLobe {
        let alpha = seen.alpha;
        let mu = dot(seen.normal, seen.view);
        let mirror = normalise(minus(scaled(seen.normal, 2.0 * mu.max(0.0)), seen.view));
        let (share, ratio, squash) = match self {
            Shading::Mirror => (0.0, 1.0, 1.0),
            Shading::Dominant => (1.0 - (1.0 - alpha) * ((1.0 - alpha).sqrt() + alpha), 1.0, 1.0),
            Shading::RootCosine => (0.0, mu.max(LEAST_COSINE).sqrt(), 1.0),
            Shading::Fitted(fit) => fit.at(alpha, mu).into(),
        };
        let axis = normalise(plus(scaled(seen.normal, share), scaled(mirror, 1.0 - share)));
        // normal and view are on one side of the axis: one of both has a part across it but head on
        // and from straight below, where the lobe is round
        let across = cross(axis, plus(seen.normal, seen.view));
        let root = squash.sqrt();
        let axes = if length(across) > STRAIGHT {
            let across = normalise(across);
            [scaled(cross(across, axis), 1.0 / root), scaled(across, root)]
        } else {
            tangents(axis)
        };
        ShadingLobe { axis, alpha: width(alpha, ratio), axes }
    }
}

/// Sine of an angle below which there is no plane of incidence; the lobe is round there.
const STRAIGHT: f64 = 1e-9;
