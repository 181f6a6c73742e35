//! `lit-width`: the lobe lit by a disk, or by a sphere, that a renderer takes for a point at its middle.
//!
//! Lights are spread evenly over a cap of the angular radius `light_radius` about the direction to the
//! middle. `normalisation` is for renderers that light with the nearest point of the disk to the mirror
//! direction in place of a wider lobe (Karis 2013): the factor on the lobe there that keeps its energy,
//! int f(v, l) (n.l) dl over int f(v, l') (n.l') dl with l' nearest to l.

use std::f64::consts::PI;
use std::sync::OnceLock;

use super::super::{Input, Residual, Use};
use super::{ALPHA, Beside, FACTS, Facts, Lights, MU, Means, SMITH, Widened, mirrored, tilted};
use crate::optics::ggx::{self, Vec3};
use lobefit_math::ops;

/// The factor on the lobe at the nearest point of a light: the energy is off by its relative error.
pub const LIGHT: Use = Use {
    name: "light",
    meaning: "the factor on the lobe at the nearest point of a disk light, error relative",
    metric: "relative error of the light's energy",
    residual: Residual::Quotient,
    blends: false,
};

/// `lit-width`.
pub static LIT_WIDTH: Widened = Widened {
    facts: Facts {
        name: "lit-width",
        inputs: &[ALPHA, MU, Input::new("light_radius", [0.0, 0.5])],
        outputs: &["roughness_lit", "radius", "normalisation", "error"],
        remark: "light_radius and radius in radians; normalisation of the lobe at the light's nearest point",
        ..FACTS
    },
    lights: lit,
    beside: Some(Beside { of: normalisation, used: &[LIGHT] }),
    nodes: &[11, 8, 9],
    drawn: 1 << 12,
    quick: 1.5e-2,
    known: OnceLock::new(),
};

fn lit(view: Vec3, x: &[f64]) -> Lights {
    let (alpha, fall) = (x[0], 1.0 - ops::cos(x[2]));
    Box::new(move |u| {
        let (light, energy) = mirrored(alpha, view, u[0], u[1])?;
        Some((tilted(light, fall * u[2], u[3]), energy))
    })
}

/// With l at theta from the mirror direction, the middles whose nearest point it is lie at theta + a:
/// each dl stands for sin(theta + a)/sin(theta) dl, and the mirror direction itself for a whole disk.
fn normalisation(x: &[f64], bare: Means) -> f64 {
    let (alpha, mu, radius) = (x[0], x[1], x[2]);
    let area = ggx::stretched_length(alpha, mu);
    // D = 1/(pi alpha^2), and f (n.l) = D G2/(4 mu).
    let peak = SMITH.shadowing_over_cosine(mu, area, mu, area) / (4.0 * PI * alpha * alpha);
    let plateau = 2.0 * PI * (1.0 - ops::cos(radius)) * peak / bare.energy;
    1.0 / (plateau + ops::cos(radius) + ops::sin(radius) * bare.cotangent)
}
