//! What a shader does at a shading point with the cubemap of a probe.

use lobefit_math::vector::{Vec3, plus, scaled};
use lobefit_truth::optics::footprint::Hit;

/// A shading point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Where it is.
    pub place: Vec3,
    /// Normal of its surface, of unit length.
    pub normal: Vec3,
    /// Towards the eye, of unit length, above the surface.
    pub view: Vec3,
    /// GGX width of its surface, in (0, 1].
    pub alpha: f64,
}

/// One fetch from the cubemap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Direction from the probe, of unit length.
    pub towards: Vec3,
    /// Width of the lobe that the level was prefiltered with.
    pub alpha: f64,
    /// Share of it in the result; those of a lookup sum to 1.
    pub weight: f64,
}

/// A way to look a cubemap up, with its proxy and the place of its probe.
pub trait Lookup: Sync {
    /// Its fetches; none where nothing is reflected.
    fn taps(&self, seen: &Seen) -> Vec<Tap>;
}

/// Where a ray meets a proxy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// How far along the ray.
    pub distance: f64,
    /// Where.
    pub place: Vec3,
    /// Unit normal of the proxy there, outward.
    pub normal: Vec3,
}

impl From<&Meeting> for Hit {
    fn from(met: &Meeting) -> Hit {
        Hit { place: met.place, normal: met.normal }
    }
}

/// What a lookup takes a room for.
pub trait Proxy: Sync {
    /// Where a ray of unit length from inside meets it, as a lobe of width `alpha` about the ray
    /// shall; `None` where it does not.
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting>;
}

/// What a fetch gives: the lobe integrated, or a texel of a chain.
pub trait Fetch: Sync {
    /// Radiance of one fetch, without its weight.
    fn fetch(&self, tap: &Tap) -> [f64; 3];

    /// The weighted sum of fetches.
    fn sum(&self, taps: &[Tap]) -> [f64; 3] {
        taps.iter().fold([0.0; 3], |sum, tap| plus(sum, scaled(self.fetch(tap), tap.weight)))
    }
}
