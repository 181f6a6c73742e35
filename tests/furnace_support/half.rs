//! Albedos of the textbook's lobe by the directions of its facets: nothing of the program's own
//! integrators.
//!
//! With the slope p = alpha rho (cos phi, sin phi) of a facet, measured against the view's azimuth,
//! and T = tan theta of the view, the lobe's albedo is
//!
//!   E = 1/(2 pi) integral du dphi G2 (1 - alpha rho cos(phi) T),   u = rho^2/(1 + rho^2),
//!
//! since D cos(theta_h) dw_h = du dphi/(2 pi) and dw_l = 4 (v.h) dw_h. The light is above the
//! surface where alpha rho < sqrt(1 + (cos(phi) T)^2) - cos(phi) T: from 0 to an end at which G2
//! vanishes with the light's cosine. Tanh-sinh quadrature takes that end, the midpoint rule the
//! azimuth, whose analytic strip is about 1/T wide.

use lobefit::data::Smith;
use lobefit_math::ops;

/// The albedo with F = 1, and its part weighted by Schlick's (1 - v.h)^5.
#[derive(Clone, Copy, Debug)]
pub struct Albedo {
    pub e: f64,
    pub b: f64,
}

/// Both at a cosine of the view, settled: the rule with half the nodes agrees within `bound`.
pub fn albedo(smith: Smith, alpha: f64, mu: f64, bound: f64) -> Albedo {
    let [coarse, fine] = [1, 2].map(|k| integrate(smith, alpha, mu, k));
    let settled = (coarse.e - fine.e).abs().max((coarse.b - fine.b).abs());
    assert!(settled <= bound, "the rule at alpha {alpha}, mu {mu}: {coarse:?} {fine:?}");
    fine
}

fn integrate(smith: Smith, alpha: f64, mu: f64, fineness: usize) -> Albedo {
    let tangent = (1.0 - mu * mu).sqrt() / mu;
    let azimuths = fineness * (48 + (6.0 * tangent) as usize);
    let rule = TanhSinh::new(fineness);
    let (mut e, mut b) = (0.0, 0.0);
    for k in 0..azimuths {
        // Half the circle; the other is its mirror image.
        let cosine = ops::cos(std::f64::consts::PI * (k as f64 + 0.5) / azimuths as f64);
        let lean = cosine * tangent;
        let largest = (if lean > 0.0 {
            1.0 / ((1.0 + lean * lean).sqrt() + lean)
        } else {
            (1.0 + lean * lean).sqrt() - lean
        }) / alpha;
        let end = largest * largest / (1.0 + largest * largest);
        for [x, w] in &rule.nodes {
            let u = end * x;
            let rho = (u / (1.0 - u)).sqrt();
            let Some((value, vh)) = facet(smith, alpha, mu, alpha * rho, lean) else { continue };
            let d = 1.0 - vh;
            e += end * w * value;
            b += end * w * value * (d * d * (d * d) * d);
        }
    }
    Albedo { e: e / azimuths as f64, b: b / azimuths as f64 }
}

/// G2 (v.h)/(v.n h.n) of a facet with this slope, and v.h; none where the light is not above the
/// surface.
fn facet(smith: Smith, alpha: f64, mu: f64, slope: f64, lean: f64) -> Option<(f64, f64)> {
    let facing = 1.0 - slope * lean;
    let square = 1.0 + slope * slope;
    let light = mu * (2.0 * facing / square - 1.0);
    // The far end of the tail rounds to a slope without bounds.
    if light.is_nan() || light <= 0.0 {
        return None;
    }
    let lambda = |c: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - c * c).max(0.0) / (c * c)).sqrt() - 1.0);
    let (v, l) = (lambda(mu), lambda(light.min(1.0)));
    let shadowing = match smith {
        Smith::Correlated => 1.0 / (1.0 + v + l),
        Smith::Separable => 1.0 / ((1.0 + v) * (1.0 + l)),
    };
    Some((shadowing * facing, mu * facing / square.sqrt()))
}

/// Tanh-sinh quadrature over [0, 1]: x = 1/(1 + exp(-pi sinh t)), for integrands without a
/// singularity at 0 that vanish at 1.
struct TanhSinh {
    /// Node and weight.
    nodes: Vec<[f64; 2]>,
}

impl TanhSinh {
    fn new(fineness: usize) -> TanhSinh {
        let step = 0.2 / fineness as f64;
        let count = (3.4 / step) as i32;
        let node = |k: i32| {
            let t = f64::from(k) * step;
            let (grow, fall) = (ops::exp(t), ops::exp(-t));
            let (sinh, cosh) = (0.5 * (grow - fall), 0.5 * (grow + fall));
            let x = 1.0 / (1.0 + ops::exp(-std::f64::consts::PI * sinh));
            let y = 1.0 / (1.0 + ops::exp(std::f64::consts::PI * sinh));
            [x, step * std::f64::consts::PI * cosh * x * y]
        };
        TanhSinh { nodes: (-count..=count).map(node).collect() }
    }
}
