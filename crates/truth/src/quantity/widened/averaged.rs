//! `averaged-width`: the lobe averaged over the normals that a texel of a normal map stands for, as a
//! coarser level of the map has them: their mean, and its length L.
//!
//! Normals are drawn about the mean by von Mises and Fisher, p ~ exp(k cos), L = coth(k) - 1/k; each counts
//! the same, whatever the view sees of it, and those that face away send back nothing.

use std::sync::OnceLock;

use super::super::Input;
use super::{ALPHA, FACTS, Facts, Lights, MU, Widened, mirrored, tilted};
use crate::optics::ggx::Vec3;
use lobefit_math::{ops, vector};

/// `averaged-width`.
pub static AVERAGED_WIDTH: Widened = Widened {
    facts: Facts {
        name: "averaged-width",
        inputs: &[ALPHA, MU, Input::new("mean_length", [0.5, 1.0])],
        outputs: &["roughness_averaged", "radius", "error"],
        remark: "of normals by von Mises and Fisher about their mean; radius in radians",
        ..FACTS
    },
    lights: averaged,
    beside: None,
    nodes: &[11, 8, 9],
    drawn: 1 << 12,
    quick: 1.5e-2,
    known: OnceLock::new(),
};

/// k of a mean length in [0.5, 1); infinite at 1.
fn concentration(length: f64) -> f64 {
    let (mut low, mut high) = (1.0, 2.0 / (1.0 - length));
    for _ in 0..100 {
        let k: f64 = 0.5 * (low + high);
        let rest = ops::exp(-2.0 * k);
        let found = (1.0 + rest) / (1.0 - rest) - 1.0 / k;
        if found < length { low = k } else { high = k }
    }
    0.5 * (low + high)
}

fn averaged(view: Vec3, x: &[f64]) -> Lights {
    let (alpha, k) = (x[0], concentration(x[2]));
    let rest = ops::exp(-2.0 * k);
    Box::new(move |u| {
        let fall = if k.is_finite() { -ops::log(u[2] + (1.0 - u[2]) * rest) / k } else { 0.0 };
        let normal = tilted([0.0, 0.0, 1.0], fall, u[3]);
        let [a, b] = vector::tangents(normal);
        let local = [vector::dot(view, a), vector::dot(view, b), vector::dot(view, normal)];
        let (light, energy) = mirrored(alpha, local, u[0], u[1]).filter(|_| local[2] > 0.0)?;
        Some((vector::turned(normal, [a, b], light), energy))
    })
}
