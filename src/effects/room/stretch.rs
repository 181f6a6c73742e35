//! How a lobe from a shading point lies in the cubemap of a probe that looks at the same place of a wall.

use super::lookup::Meeting;
use crate::math::vector::{Vec3, dot, length, minus, scaled};

/// Least cosine of a ray to the wall's normal: 1/cosine has no bound. Empirical, of the prototype; the taps carry what is beyond.
pub const GRAZING: f64 = 0.02;

/// Ratios of the footprint of a shading point's cone on a wall to the probe's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// From the probe to the place, of unit length; any where the probe is there.
    pub towards: Vec3,
    /// Distance of the shading point over that of the probe: infinite where the probe is at the place.
    pub distance: f64,
    /// Cosine of the shading point's ray to the normal, at least [`GRAZING`].
    pub here: f64,
    /// Cosine of the probe's ray to it, at least [`GRAZING`].
    pub there: f64,
    /// Cosine between the two rays.
    between: f64,
}

impl Stretch {
    /// Where a ray of direction `mirror` meets a wall.
    pub fn of(met: &Meeting, mirror: Vec3, probe: Vec3) -> Stretch {
        let from = minus(met.place, probe);
        let far = length(from);
        let towards = if far > 0.0 { scaled(from, 1.0 / far) } else { mirror };
        Stretch {
            towards,
            distance: met.distance / far,
            here: dot(met.normal, mirror).max(GRAZING),
            there: dot(met.normal, towards).max(GRAZING),
            between: dot(mirror, towards),
        }
    }

    /// Root of the ratio of the solid angles: the geometric mean of the two singular values of the map of directions
    /// e -> (e - mirror (n.e)/(n.mirror)) distance, less its part along `towards`.
    pub fn area(&self) -> f64 {
        self.distance * (self.there / self.here).sqrt()
    }

    /// Ratio of the singular values of that map, at least 1: of their product there/here (distances apart) and of the sum of their squares.
    pub fn stretch(&self) -> f64 {
        // w: the mirror direction, p: towards. A direction e at right angles to w goes to v = e - w k_e, k_e = (n.e)/(n.w), less p (p.v).
        // Over an orthonormal pair of e: sum |v|^2 = 2 + k^2, k^2 = (1 - a^2)/a^2, and
        // sum (p.v)^2 = |p - w c|^2 - 2 c K + c^2 k^2, K = sum (p.e) k_e = (n.p - a c)/a.
        let (a, b, c) = (self.here, self.there, self.between);
        let k2 = (1.0 - a * a) / (a * a);
        let along = (b - a * c) / a;
        let along2 = (1.0 - c * c) - 2.0 * c * along + c * c * k2;
        let (half, product) = (0.5 * (2.0 + k2 - along2), b / a);
        let ratio = (half / product).max(1.0);
        // (s1^2 + s2^2)/2 over s1 s2 is (kappa + 1/kappa)/2
        ratio + ((ratio - 1.0) * (ratio + 1.0)).sqrt()
    }
}
