//! `coated-width`: a rough base seen through a rough dielectric coat.
//!
//! The view goes in through a facet of the coat, is mirrored by one of the base inside, and leaves through
//! another facet of the coat; with the exact Fresnel term of the coat and F = 1 of the base. Light that
//! the coat throws back inside is left out: it returns wider, and later.

use std::sync::OnceLock;

use super::super::Input;
use super::{ALPHA, FACTS, Facts, Lights, MU, SMITH, Widened, mirrored};
use crate::integrate::monte_carlo::{refract, shadowing};
use crate::optics::ggx::{self, Vec3};

/// `coated-width`.
pub static COATED_WIDTH: Widened = Widened {
    facts: Facts {
        name: "coated-width",
        inputs: &[
            ALPHA,
            MU,
            Input::new("coat_roughness", [0.01, 1.0]),
            Input::new("ior", [1.05, 2.0]).usually([1.05, 2.0]),
        ],
        outputs: &["roughness_coated", "radius", "error"],
        remark: "alpha of the base, ior and roughness of the coat (alpha = roughness^2); radius in radians",
        ..FACTS
    },
    lights: coated,
    beside: None,
    nodes: &[9, 8, 9, 4],
    drawn: 1 << 11,
    quick: 2e-2,
    known: OnceLock::new(),
};

fn coated(view: Vec3, x: &[f64]) -> Lights {
    let (alpha, coat, ior) = (x[0], [x[2] * x[2]; 2], x[3]);
    Box::new(move |u| {
        let through = |eta: f64, from: Vec3, u: [f64; 2]| {
            let (reflectance, light) = refract(eta, from, ggx::visible_normal(coat, from, u[0], u[1]));
            let light = light.filter(|light| light[2] < 0.0)?;
            Some((light, (1.0 - reflectance) * shadowing(SMITH, coat, from, light).0))
        };
        let (down, entered) = through(1.0 / ior, view, [u[2], u[3]])?;
        let (up, kept) = mirrored(alpha, down.map(|x| -x), u[0], u[1])?;
        // Seen from inside, the coat's facets are the same about the other side of the surface.
        let (out, left) = through(ior, [-up[0], -up[1], up[2]], [u[4], u[5]])?;
        Some(([out[0], out[1], -out[2]], entered * kept * left))
    })
}
