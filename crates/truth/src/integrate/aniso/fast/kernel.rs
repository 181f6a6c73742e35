//! E at one azimuth of the view, by all rays about the macro normal, eight rays at a time.

use std::f64::consts::PI;

use super::rules::{Block, PANELS, RayNode, RaysRule};
use crate::integrate::aniso::view::View;
use crate::optics::Smith;
use lobefit_math::lanes::{self, F8, LANES};

/// E by one rule. The view's azimuth lies in the first quadrant, and alpha_y is not above alpha_x.
#[inline(always)]
pub(super) fn rays(view: &View, rule: &RaysRule) -> f64 {
    let shadowing = Shadowing::new(view);
    let panels = Panels::new(view, rule.root);
    let mut total = [0.0; LANES];
    for block in rule.blocks {
        let rays = Rays::new(view, &panels, block);
        let values = rays.integrate(view, &shadowing, rule.ray);
        for i in 0..LANES {
            total[i] += rays.weight[i] * values[i];
        }
    }
    lanes::sum(&total) * shadowing.scale / PI
}

/// G2/mu = scale mu_l/(near mu_l + far s_l), either Smith form.
struct Shadowing {
    scale: f64,
    near: f64,
    far: f64,
}

impl Shadowing {
    #[inline(always)]
    fn new(view: &View) -> Shadowing {
        match view.smith {
            Smith::Separable => Shadowing { scale: 4.0 / (view.mu + view.s_v), near: 1.0, far: 1.0 },
            Smith::Correlated => Shadowing { scale: 2.0, near: view.s_v, far: view.mu },
        }
    }
}

/// Middle direction and tangent of a quarter of the length of every panel, in the azimuth variable
/// beta.
struct Panels {
    root: f64,
    middle: [[f64; 2]; PANELS],
    tangent: [f64; PANELS],
}

/// A direction of unit length.
#[inline(always)]
fn unit(x: f64, y: f64) -> [f64; 2] {
    let length = (x * x + y * y).sqrt();
    [x / length, y / length]
}

#[inline(always)]
fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Panels {
    #[inline(always)]
    fn new(view: &View, root: f64) -> Panels {
        let ([ax, ay], [vx, vy]) = (view.alpha, view.azimuth);
        // The facets' azimuth (x, y) in beta: (root x/alpha_x, y/alpha_y).
        let across = unit(-root * vy / ax, vx / ay);
        let opposite = [-across[0], -across[1]];
        let x = root * view.sine * vx / ax;
        let (above, below) = (unit(x, (view.sine * vy + 1.0) / ay), unit(x, (view.sine * vy - 1.0) / ay));
        let ordered = cross(opposite, below) > 0.0;
        let (seventh, eighth) = if ordered { (opposite, below) } else { (below, opposite) };
        let (east, north, west, south) = ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]);
        let cuts = [east, above, north, across, west, south, seventh, eighth, east];
        let mut out = Panels { root, middle: [[0.0; 2]; PANELS], tangent: [0.0; PANELS] };
        for i in 0..PANELS {
            let (from, to) = (cuts[i], cuts[i + 1]);
            let middle = unit(from[0] + to[0], from[1] + to[1]);
            // from and the middle enclose half the panel
            let cosine = from[0] * middle[0] + from[1] * middle[1];
            out.middle[i] = middle;
            out.tangent[i] = cross(from, middle) / (1.0 + cosine);
        }
        out
    }
}

/// Eight rays of facets h ~ (g z n, 1 - g^2 z^2/4), n the ray's azimuth, g its effective alpha:
/// tan(t/2) = g z/2.
struct Rays {
    weight: F8,
    /// g^2/4
    quarter: F8,
    /// g sin(theta) cos(azimuth between ray and view)
    lean: F8,
    /// 2 alpha_x g n_x and 2 alpha_y g n_y
    along: [F8; 2],
    /// End of the ray in the variable of [`stretch`].
    end: F8,
}

/// z = sinh(9 w) for x = sinh(w), by two triplings, and dz/dx: a polynomial, and for every alpha
/// the peak is about one unit wide in 9 w, with the poles of D at +-i pi/2.
#[inline(always)]
fn stretch(x: f64) -> (f64, f64) {
    let x4 = 4.0 * x * x;
    let y = x * (3.0 + x4);
    let y4 = 4.0 * y * y;
    (y * (3.0 + y4), 9.0 * (1.0 + x4) * (1.0 + y4))
}

impl Rays {
    #[inline(always)]
    fn new(view: &View, panels: &Panels, block: &Block) -> Rays {
        let [ax, ay] = view.alpha;
        let (vx, vy) = (view.sine * view.azimuth[0], view.sine * view.azimuth[1]);
        let mut middle = [[0.0; LANES]; 2];
        let mut tangent = [0.0; LANES];
        for i in 0..LANES {
            let panel = block.panel[i];
            (middle[0][i], middle[1][i]) = (panels.middle[panel][0], panels.middle[panel][1]);
            tangent[i] = panels.tangent[panel];
        }
        let mut weight = [0.0; LANES];
        let mut quarter = [0.0; LANES];
        let mut lean = [0.0; LANES];
        let mut along = [[0.0; LANES]; 2];
        let mut grown = [0.0; LANES];
        for i in 0..LANES {
            // psi - middle = 2 atan(t)
            let t = tangent[i] * block.at[i];
            let inverse = 1.0 / (1.0 + t * t);
            let (cosine, sine) = ((1.0 - t * t) * inverse, 2.0 * t * inverse);
            let x = cosine * middle[0][i] - sine * middle[1][i];
            let y = panels.root * (cosine * middle[1][i] + sine * middle[0][i]);
            let inverse2 = 1.0 / (x * x + y * y);
            let shrink = inverse2.sqrt();
            weight[i] = block.weight[i] * tangent[i] * 2.0 * inverse * (panels.root * inverse2);
            // g n
            let (x, y) = (ax * (x * shrink), ay * (y * shrink));
            let g2 = x * x + y * y;
            let g = g2.sqrt();
            quarter[i] = 0.25 * g2;
            lean[i] = x * vx + y * vy;
            (along[0][i], along[1][i]) = (2.0 * ax * x, 2.0 * ay * y);
            let z = 2.0 * horizon(view.mu, lean[i] / g) / g;
            grown[i] = z + (1.0 + z * z).sqrt();
        }
        Rays { weight, quarter, lean, along, end: ninth(&grown) }
    }

    /// int z/(cos^2 + sin^2/g^2)^2 (v.h) mu_l/(near mu_l + far s_l) dz along each ray, in
    /// homogeneous coordinates: lengths grow by 1 + g^2 z^2/4 for the facet and by its square for
    /// the light.
    #[inline(always)]
    fn integrate(&self, view: &View, shadowing: &Shadowing, nodes: &[RayNode]) -> F8 {
        let mu = view.mu;
        let fixed = [0, 1].map(|k| view.alpha[k] * view.sine * view.azimuth[k]);
        let mut total = [0.0; LANES];
        for node in nodes {
            for i in 0..LANES {
                let (z, slope) = stretch(self.end[i] * node.at);
                let z2 = z * z;
                let tan2 = self.quarter[i] * z2;
                let (cosine, length) = (1.0 - tan2, 1.0 + tan2);
                let length2 = length * length;
                let d = cosine * cosine + z2;
                let vh = mu * cosine + self.lean[i] * z;
                let up = 2.0 * vh * cosine - mu * length2;
                let up = if up > 0.0 { up } else { 0.0 };
                let far = vh * z;
                let x = self.along[0][i] * far - fixed[0] * length2;
                let y = self.along[1][i] * far - fixed[1] * length2;
                let stretched = ((x * x + y * y) + up * up).sqrt();
                let below = (d * d) * (shadowing.near * up + shadowing.far * stretched);
                total[i] += (node.weight * slope) * (far * length) * up / below;
            }
        }
        for i in 0..LANES {
            total[i] *= self.end[i];
        }
        total
    }
}

/// tan(t/2) where the light reaches the horizon, mu cos(2t) + lean sin(2t) = 0: without
/// cancellation for either sign.
#[inline(always)]
fn horizon(mu: f64, lean: f64) -> f64 {
    let q = (mu * mu + lean * lean).sqrt();
    let far = q + if lean > 0.0 { lean } else { -lean };
    let (opposite, adjacent) = if lean > 0.0 { (far, mu) } else { (mu, far) };
    opposite / (adjacent + (opposite * opposite + adjacent * adjacent).sqrt())
}

/// sinh(asinh(z)/9) from e^asinh(z).
#[inline(always)]
fn ninth(grown: &F8) -> F8 {
    let mut power = lanes::ln(grown);
    for i in 0..LANES {
        power[i] *= 1.0 / 9.0;
    }
    let mut out = lanes::exp(&power);
    for i in 0..LANES {
        out[i] = 0.5 * (out[i] - 1.0 / out[i]);
    }
    out
}
