//! Directions of a lobe, one by one.

use std::f64::consts::PI;

use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::Vec3;
use lobefit_truth::optics::kernel::Kernel;

/// Directions about the axis z drawn by the energy of a lobe, each of the same weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Rays {
    directions: Vec<Vec3>,
}

impl Rays {
    /// `count` directions of the lobe of a kernel and a width in (0, 1], a scrambled Sobol set of a
    /// seed.
    pub fn new(kernel: &Kernel, alpha: f64, count: u32, seed: u32) -> Rays {
        let lobe = kernel.lobe(alpha);
        let points = Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995, 0]);
        let direction = |i: u32| {
            let u = lobe.quantile(points.coordinate(i, 0));
            let (sine, cosine) = (2.0 * u.sqrt() / (1.0 + u), (1.0 - u) / (1.0 + u));
            let (s, c) = ops::sincos(2.0 * PI * points.coordinate(i, 1));
            [sine * c, sine * s, cosine]
        };
        Rays { directions: (0..count).map(direction).collect() }
    }

    /// The directions, about z.
    pub fn directions(&self) -> &[Vec3] {
        &self.directions
    }
}
