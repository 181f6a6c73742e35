//! Nodes along rays and azimuths and how many a tolerance takes: fixed along every ray and in every
//! panel of azimuths, so that eight rays run side by side.

use std::sync::OnceLock;

use crate::optics::Smith;
use lobefit_math::gauss::Gauss;
use lobefit_math::lanes::{F8, LANES};
use lobefit_math::ops;

/// Panels of azimuths about the macro normal: the four quadrants between the ellipse's axes, the
/// second and the fourth cut where the rays are perpendicular to the view, the first and the fourth
/// where they meet the horizon with the light along the short axis.
pub(super) const PANELS: usize = 8;

/// Most nodes along a ray or in a panel.
const MOST: usize = 96;

/// Share of the quadratic clustering of nodes at the horizon (measured: best of 0.3, 0.5, 0.7, 0.85
/// and 1 for both Smith forms).
const HORIZON: f64 = 0.85;

/// Share of the clustering of nodes at both ends of a panel (measured: best of 0.5, 0.8 and 1).
const ENDS: f64 = 0.5;

/// Thinnest layer at the horizon, as a logarithm.
const THINNEST: usize = 9;

/// A node along the rays: its place in units of the ray's end, and its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayNode {
    pub at: f64,
    pub weight: f64,
}

/// Eight azimuths: the panel of each, its place in the panel from -1 to 1, and its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub panel: [usize; LANES],
    pub at: F8,
    pub weight: F8,
}

/// The nodes of one integral over rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct RaysRule {
    pub ray: &'static [RayNode],
    pub blocks: &'static [Block],
    /// The azimuth variable beta: tan(psi) = root tan(beta), psi that of the stretched slopes.
    pub root: f64,
}

impl RaysRule {
    /// The rule for a view, so that E is good to 10^-digits.
    pub fn new(smith: Smith, alpha: [f64; 2], mu: f64, digits: f64) -> RaysRule {
        let mean = (alpha[0] * alpha[1]).sqrt();
        // Where the lobe is narrow, D alone matters, which does not depend on psi; where it is wide
        // the shadowing varies with the azimuth itself, tan = (alpha_y/alpha_x) tan(psi), and the
        // variable between the two is best (measured).
        let root = ops::pow(alpha[0] / alpha[1], 0.5 * mean.min(1.0));
        RaysRule {
            ray: ray_nodes(radial(smith, alpha, mu, digits), layer(smith, alpha, mu, digits)),
            blocks: blocks(per_panel(smith, alpha, mu, digits)),
            root,
        }
    }

    /// Integrand evaluations of one such integral, padding included.
    pub fn evaluations(&self) -> u64 {
        (self.blocks.len() * LANES * self.ray.len()) as u64
    }
}

/// Digits above three, squared: how the harder cases grow with the digits (measured, 4 to 8
/// digits).
fn growth(digits: f64) -> f64 {
    let above = (digits - 3.0).max(0.0);
    above * above
}

/// Nodes along a ray, fitted to measured errors for alpha 1e-3..1, aspect sqrt(0.1)..1: the ray is
/// longer, in units of the peak, for small alpha; alpha_x above 1 bends the shadowing; the
/// correlated form has a layer of width mu at the horizon.
fn radial(smith: Smith, alpha: [f64; 2], mu: f64, digits: f64) -> usize {
    let mean = (alpha[0] * alpha[1]).sqrt();
    let length = ops::asinh(1.0 / mean);
    let widest = alpha[0].max(alpha[1]);
    let bend = if widest > 1.0 { (1.5 + growth(digits)) * ops::log(widest) } else { 0.0 };
    // A clustering for a thin layer leaves fewer nodes to the peak, which is far off in units of a
    // small alpha.
    let width = layer(smith, alpha, mu, digits) as f64;
    let layer = match smith {
        Smith::Correlated => {
            let spent = (width - 2.0).max(0.0) * (length - 1.9).max(0.0);
            (0.35 * ops::log(0.04 / mu)).max(0.0) + 0.15 * spent
        }
        Smith::Separable => 0.25 * width,
    };
    let nodes = 2.5 + digits * (1.2 + 0.28 * length) + bend + layer * digits;
    (nodes.ceil() as usize).clamp(4, MOST)
}

/// Width of the layer at the horizon as a logarithm, rounded, where it takes nodes of its own: the
/// correlated form has a pole at mu_l = -mu s_l/s_v, either one turns on the scale alpha. Of a
/// narrow lobe little lies there, and a tolerance needs only so much of it (measured).
fn layer(smith: Smith, alpha: [f64; 2], mu: f64, digits: f64) -> usize {
    let decades = 0.5 * ops::log(alpha[0] * alpha[1]) / std::f64::consts::LN_10;
    let width = match smith {
        Smith::Separable if digits > 6.2 && decades > -2.9 && decades < -1.5 && mu < 0.02 => THICKEST,
        Smith::Separable => 0.0,
        Smith::Correlated => {
            let from = if decades > -1.1 { 0.6 } else { 0.3 };
            ops::log(from / mu) * (decades + 3.0).clamp(0.0, 1.0)
        }
    };
    let width = width.min(digits - 2.0 + 4.0 * (decades + 2.0).clamp(0.0, 1.0));
    if width < THICKEST { 0 } else { (width.round() as usize).min(THINNEST) }
}

/// Layers thicker than exp(-3) are resolved by the quadratic clustering.
const THICKEST: f64 = 3.0;

/// Nodes in each panel, fitted likewise.
fn per_panel(smith: Smith, alpha: [f64; 2], mu: f64, digits: f64) -> usize {
    let mean = (alpha[0] * alpha[1]).sqrt();
    let ratio = (alpha[0] / alpha[1]).max(alpha[1] / alpha[0]);
    let width = (ops::log(mean / 0.1) / std::f64::consts::LN_10).clamp(0.0, 1.0);
    let wide = width * (ratio - 1.0).min(1.0);
    let grazing = match smith {
        Smith::Correlated => 0.35 * ops::log(0.04 / mu).max(0.0) * (digits - 4.0).max(0.0),
        Smith::Separable => 0.0,
    };
    let nodes = 1.5 * digits - 0.5 + grazing + wide * (2.0 + 0.12 * growth(digits));
    (nodes.ceil() as usize).clamp(4, MOST)
}

/// Azimuths of the view in one quadrant, for the mean: E's coefficients in cos(2 k b) fall as
/// exp(-2 k strip) and their weights in the mean likewise.
pub(super) fn azimuths(alpha: [f64; 2], digits: f64) -> usize {
    folds(alpha, digits, 4.0)
}

/// Coefficients in cos(2 k b), for E at one azimuth.
pub(super) fn harmonics(alpha: [f64; 2], digits: f64) -> usize {
    folds(alpha, digits, 2.0)
}

/// n so that 0.4 exp(-speed strip n) is 10^-digits, strip = atanh(sqrt(min/max)); the factor 0.4 is
/// measured.
fn folds(alpha: [f64; 2], digits: f64, speed: f64) -> usize {
    let narrow = (alpha[0] / alpha[1]).min(alpha[1] / alpha[0]).sqrt();
    if narrow >= 1.0 {
        return 1;
    }
    let strip = 0.5 * (ops::log1p(narrow) - ops::log1p(-narrow));
    let needed = ops::log(0.4) + digits * std::f64::consts::LN_10;
    ((needed / (speed * strip)).ceil() as usize).max(2)
}

/// Gauss nodes in y in [0, 1], clustered at the horizon, where the shadowing varies fast: 1 - (1-c)
/// y - c y^2 in units of the end, or for a thin layer there, of width exp(-layer), 1 - (exp(layer
/// y) - 1)/(exp(layer) - 1).
fn ray_nodes(n: usize, layer: usize) -> &'static [RayNode] {
    static NODES: [[OnceLock<Vec<RayNode>>; MOST + 1]; THINNEST + 1] =
        [const { [const { OnceLock::new() }; MOST + 1] }; THINNEST + 1];
    NODES[layer][n].get_or_init(|| {
        let rule = Gauss::new(n);
        let node = |(x, w): (&f64, &f64)| {
            let y = 0.5 * (1.0 + x);
            let (distance, slope) = if layer == 0 {
                (y * ((1.0 - HORIZON) + HORIZON * y), (1.0 - HORIZON) + 2.0 * HORIZON * y)
            } else {
                let rate = layer as f64;
                let (grown, whole) = (ops::exp(rate * y), ops::exp(rate) - 1.0);
                ((grown - 1.0) / whole, rate * grown / whole)
            };
            RayNode { at: 1.0 - distance, weight: 0.5 * w * slope }
        };
        rule.nodes.iter().zip(&rule.weights).map(node).collect()
    })
}

/// All panels' nodes in blocks of eight; the last block is padded with rays of weight 0.
fn blocks(n: usize) -> &'static [Block] {
    static BLOCKS: [OnceLock<Vec<Block>>; MOST + 1] = [const { OnceLock::new() }; MOST + 1];
    BLOCKS[n].get_or_init(|| {
        let nodes = panel_nodes(n);
        let all: Vec<(usize, f64, f64)> = (0..PANELS)
            .flat_map(|panel| nodes.iter().map(move |&(at, weight)| (panel, at, weight)))
            .collect();
        all.chunks(LANES).map(block).collect()
    })
}

/// Gauss nodes on [-1, 1] clustered at both ends by a sine.
fn panel_nodes(n: usize) -> Vec<(f64, f64)> {
    use std::f64::consts::FRAC_PI_2;
    let rule = Gauss::new(n);
    let node = |(x, w): (&f64, &f64)| {
        let (sine, cosine) = ops::sincos(FRAC_PI_2 * x);
        ((1.0 - ENDS) * x + ENDS * sine, w * ((1.0 - ENDS) + ENDS * FRAC_PI_2 * cosine))
    };
    rule.nodes.iter().zip(&rule.weights).map(node).collect()
}

fn block(nodes: &[(usize, f64, f64)]) -> Block {
    let mut out = Block { panel: [0; LANES], at: [0.0; LANES], weight: [0.0; LANES] };
    for (i, (panel, at, weight)) in nodes.iter().enumerate() {
        (out.panel[i], out.at[i], out.weight[i]) = (*panel, *at, *weight);
    }
    out
}
