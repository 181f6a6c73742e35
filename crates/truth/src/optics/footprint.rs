//! How a wall maps a lobe from the shading point to the probe.
//!
//! A direction e at right angles to the ray w_s, from the shading point to what it hits in distance
//! d_s, moves the place hit by dq = d_s (e - w_s (n.e)/(n.w_s)), n the wall's normal; without its
//! part along the probe's ray w_p and over the probe's distance d_p that is a change of direction
//! from the probe. This map M has the singular values s1 >= s2.

use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot, length, minus, plus, scaled, tangents};

/// Least cosine between a ray and the normal of a wall: below, the footprint is as long as the
/// wall.
pub const LEAST_COSINE: f64 = 0.02;

/// Least ratio of the singular values: both cosines at their least.
const FLATTEST: f64 = LEAST_COSINE * LEAST_COSINE;

/// The map M of a lobe about a ray from the shading point to directions from the probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// s1/s2 >= 1; 1 where the lobe stays round.
    pub kappa: f64,
    /// sqrt(s1 s2) = (d_s/d_p) sqrt(cos psi_p/cos psi_s) > 0: by how much a lobe looks wider from
    /// the probe.
    pub area: f64,
    /// The direction at right angles to the ray along which the footprint is longest, as long as
    /// the lobe is there (1 for a round one); of its two signs the one towards which the footprint
    /// grows. Any where the footprint is round and grows nowhere.
    pub major: Vec3,
    /// sqrt(1 - 1/l^2) in [0, 1): l is the length over the width of the footprint, kappa and what
    /// its growth adds, the ratio of the half-axes of M^T M/(s1 s2) + alpha^2 g g^T, g the gradient
    /// of ln(d_s/d_p). Without the second part `major` would turn at once where kappa passes 1.
    pub length: f64,
    /// The derivative of ln(d_s/d_p) by the tangent of a tilt along `major`, >= 0. The other factor
    /// of `area` is constant over a plane, so that ln `area` grows 3/2 as fast.
    pub growth: f64,
    /// -(n.e)/(n.w_s) of e = `major`: a ray tilted by the tangent t meets the plane where t
    /// `slope` < 1.
    pub slope: f64,
}

/// What a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where.
    pub place: Vec3,
    /// Unit normal of the wall there, outward.
    pub normal: Vec3,
}

impl Stretch {
    /// Of a narrow round lobe, [`Stretch::of_round`] at alpha = 0.
    pub fn of(place: Vec3, hit: impl Into<Hit>, probe: Vec3) -> Option<Stretch> {
        Stretch::of_round(place, hit, probe, 0.0)
    }

    /// Of a round lobe of width `alpha` in [0, 1] from a place, seen from a probe. Cosines with the
    /// wall's normal are at least 0.02. `None` where one of both stands in the place hit, or a
    /// length is no number.
    pub fn of_round(place: Vec3, hit: impl Into<Hit>, probe: Vec3, alpha: f64) -> Option<Stretch> {
        let hit = hit.into();
        let ray = minus(hit.place, place);
        Stretch::of_lobe(place, hit, probe, alpha, tangents(scaled(ray, 1.0 / length(ray))))
    }

    /// [`Stretch::of_round`] of a lobe that is no round one: M after the map from a round lobe's
    /// directions to those of the lobe, whose two half-axes at right angles to the ray are `axes`,
    /// their lengths' product 1.
    pub fn of_lobe(
        place: Vec3,
        hit: impl Into<Hit>,
        probe: Vec3,
        alpha: f64,
        axes: [Vec3; 2],
    ) -> Option<Stretch> {
        let hit = hit.into();
        let (from_place, from_probe) = (minus(hit.place, place), minus(hit.place, probe));
        let (near, far) = (length(from_place), length(from_probe));
        if !(near > 0.0 && far > 0.0 && near.is_finite() && far.is_finite()) {
            return None;
        }
        let (ray, seen) = (scaled(from_place, 1.0 / near), scaled(from_probe, 1.0 / far));
        let steep = dot(hit.normal, ray).max(LEAST_COSINE);
        let slopes = axes.map(|e| -dot(hit.normal, e) / steep);
        let moved = [0, 1].map(|i| scaled(plus(axes[i], scaled(ray, slopes[i])), near));
        let mapped = moved.map(|m| scaled(minus(m, scaled(seen, dot(seen, m))), 1.0 / far));
        let growths = moved.map(|m| dot(ray, m) / near - dot(seen, m) / far);
        let form = Form::of(mapped);
        let kappa = form.axes()?.0;
        let (long, [x, y]) = form.and(growths.map(|g| alpha * g))?.axes()?;
        let along = |pair: [f64; 2]| x * pair[0] + y * pair[1];
        let sign = if along(growths) < 0.0 { -1.0 } else { 1.0 };
        Some(Stretch {
            kappa,
            area: area_ratio(hit.normal, (ray, near), (seen, far)),
            major: scaled(plus(scaled(axes[0], x), scaled(axes[1], y)), sign),
            length: ((1.0 - 1.0 / long) * (1.0 + 1.0 / long)).max(0.0).sqrt(),
            growth: along(growths).abs(),
            slope: sign * along(slopes),
        })
    }
}

/// A quadratic form [[p + q, r], [r, p - q]], whose eigenvalues are p +- |(q, r)|.
struct Form {
    p: f64,
    q: f64,
    r: f64,
    /// p^2 - q^2 - r^2, apart: the difference cancels.
    determinant: f64,
}

impl Form {
    /// M^T M of the columns of M.
    fn of([a, b]: [Vec3; 2]) -> Form {
        let (aa, bb, r) = (dot(a, a), dot(b, b), dot(a, b));
        Form { p: 0.5 * (aa + bb), q: 0.5 * (aa - bb), r, determinant: (aa * bb - r * r).max(0.0) }
    }

    /// This over the root of its determinant, with v v^T.
    fn and(&self, [v, w]: [f64; 2]) -> Option<Form> {
        let unit = 1.0 / self.determinant.max(self.p * self.p * FLATTEST * FLATTEST).sqrt();
        let (p, q, r) = (self.p * unit, self.q * unit, self.r * unit);
        // v^T adj(F) v, the form of its adjoint [[p - q, -r], [-r, p + q]], is what the determinant
        // grows by
        let grows = (p - q) * v * v - 2.0 * r * v * w + (p + q) * w * w;
        let (p, q, r) = (p + 0.5 * (v * v + w * w), q + 0.5 * (v * v - w * w), r + v * w);
        let determinant = self.determinant * unit * unit + grows.max(0.0);
        determinant.is_finite().then_some(Form { p, q, r, determinant })
    }

    /// The root of the ratio of its eigenvalues, and the unit vector of the larger.
    fn axes(&self) -> Option<(f64, [f64; 2])> {
        let large = self.p + (self.q * self.q + self.r * self.r).sqrt();
        if !(large > 0.0 && large.is_finite()) {
            return None;
        }
        let small = (self.determinant / large).max(large * FLATTEST * FLATTEST);
        let (sine, cosine) = ops::sincos(0.5 * ops::atan2(self.r, self.q));
        Some(((large / small).max(1.0).sqrt(), [cosine, sine]))
    }
}

/// cos psi_p/cos psi_s of the unit rays from a shading point and from a probe to a place on a wall
/// of that outward unit `normal`, cosines of at least [`LEAST_COSINE`].
pub fn slant_ratio(normal: Vec3, from_place: Vec3, from_probe: Vec3) -> f64 {
    let cosine = |ray: Vec3| {
        let cosine = dot(normal, ray);
        if cosine < LEAST_COSINE { LEAST_COSINE } else { cosine }
    };
    cosine(from_probe) / cosine(from_place)
}

/// [`Stretch::area`] by a unit ray and its length > 0 from the shading point and another from the
/// probe: rho by the root of the ratio of solid angles, (d_s/d_p) sqrt(cos psi_p/cos psi_s).
pub fn area_ratio(normal: Vec3, from_place: (Vec3, f64), from_probe: (Vec3, f64)) -> f64 {
    from_place.1 / from_probe.1 * slant_ratio(normal, from_place.0, from_probe.0).sqrt()
}

/// The width, at most 1, of a fetch that stands for a lobe of width `alpha` in [0, 1] whose
/// footprint is `ratio` > 0 times as wide from the probe as from the shading point: the fitted flow
/// of fixed-energy cones for the cosine-weighted lobe, its constant rounded to 1.
pub fn width(alpha: f64, ratio: f64) -> f64 {
    let x = ratio * alpha;
    x / (1.0 + alpha - x).max(x)
}

/// One of several fetches for a lobe.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct RuleTap {
    /// How far its ray is tilted from the lobe's axis along [`Stretch::major`]: the tangent of the
    /// angle.
    pub tilt: f64,
    /// Its width as seen from the shading point over that of the lobe.
    pub width: f64,
    /// Its share; those of a lobe sum to 1.
    pub weight: f64,
}
