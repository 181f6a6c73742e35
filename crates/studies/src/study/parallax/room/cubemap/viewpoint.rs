//! From where a texel sees the room.

use crate::study::parallax::room::{Convex, Plane};
use lobefit_math::vector::{Vec3, dot, length, minus, plus, scaled};
use lobefit_truth::optics::footprint::{area_ratio, width};

/// Where the lobe of a texel starts, its axis and its width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// A place inside the room.
    pub place: Vec3,
    /// Unit direction to where the proxy shows the texel.
    pub axis: Vec3,
    /// Width of the lobe from there.
    pub alpha: f64,
}

/// The law of a bake. The texel of a direction w shows the place q where the ray from the probe
/// along w leaves the proxy, whatever the law; seen from elsewhere, the lobe is as much wider or
/// narrower as leaves its footprint on the wall as large as that of the probe's lobe: by
/// rho = (d_p/d_v) sqrt(cos psi_v/cos psi_p) and the flow of the cosine-weighted lobe ([`width`]).
/// Flows compose, so that a lookup needs not know the law: that of an ordinary bake is right for
/// all.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "law")]
pub enum Viewpoint {
    /// From the probe along w: the ordinary, angular bake.
    Probe,
    /// From above q at right angles to its plane, at the probe's distance from that plane: what a
    /// texel shows no longer depends on how obliquely the probe sees it. At the edges of the proxy
    /// the two planes disagree.
    Perpendicular,
    /// Between the probe and the place above q, by the share e/(e + widths alpha d_p) of the way: e
    /// is the distance of q from the nearest edge of the proxy on its wall, alpha d_p the radius of
    /// the lobe there. At an edge it is the probe, for either wall; far from all edges, and for
    /// narrow lobes, above q.
    Sliding {
        /// Radii at which it is half way; positive.
        widths: f64,
    },
}

/// How far above a wall a viewpoint may be at most, of the way to what is opposite.
const REACH: f64 = 0.9;

impl Viewpoint {
    /// From where the texel of a direction is seen for a lobe of a width in (0, 1]. A direction in
    /// which the probe sees no plane, or one that it stands in, is seen from the probe.
    pub fn eye(self, proxy: &Convex, probe: Vec3, towards: Vec3, alpha: f64) -> Eye {
        let ordinary = Eye { place: probe, axis: towards, alpha };
        let met = proxy.exit(probe, towards).filter(|(distance, _)| *distance > 0.0);
        let Some((far, wall)) = met.filter(|_| self != Viewpoint::Probe) else { return ordinary };
        let place = plus(probe, scaled(towards, far));
        let normal = proxy.planes[wall].normal;
        let opposite = proxy.exit(place, scaled(normal, -1.0)).map_or(f64::INFINITY, |(t, _)| t);
        let height = proxy.planes[wall].depth(probe).min(REACH * opposite);
        let share = match self {
            Viewpoint::Sliding { widths } => {
                let edge = to_edge(proxy, place, wall);
                if edge.is_finite() { edge / (edge + widths * alpha * far) } else { 1.0 }
            }
            Viewpoint::Probe | Viewpoint::Perpendicular => 1.0,
        };
        let above = minus(place, scaled(normal, height));
        let eye = plus(probe, scaled(minus(above, probe), share));
        let ray = minus(place, eye);
        let near = length(ray);
        if near == 0.0 {
            return ordinary;
        }
        let axis = scaled(ray, 1.0 / near);
        // from the probe to the eye, as a lookup goes from the shading point to the probe
        Eye { place: eye, axis, alpha: width(alpha, area_ratio(normal, (towards, far), (axis, near))) }
    }
}

/// Distance of a place on a wall of a convex body from the wall's nearest edge, in the plane of the
/// wall; infinite where there is none.
pub fn to_edge(proxy: &Convex, place: Vec3, wall: usize) -> f64 {
    let normal = proxy.planes[wall].normal;
    let distance = |(i, plane): (usize, &Plane)| {
        let along = dot(normal, plane.normal);
        let sine2 = 1.0 - along * along;
        // parallel planes have no edge
        if i == wall || sine2 < 1e-12 { f64::INFINITY } else { plane.depth(place).max(0.0) / sine2.sqrt() }
    };
    proxy.planes.iter().enumerate().map(distance).fold(f64::INFINITY, f64::min)
}
