//! What a GGX surface reflects.

use std::f64::consts::PI;

use super::super::Seen;
use super::super::light::Room;
use super::outlook::Outlook;
use lobefit::data::Smith;
use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, dot, normalise, plus, scaled, tangents};
use lobefit_truth::optics::ggx;

/// Points for visible normals, azimuth of the cap and height in it; and points on panels.
#[derive(Clone, Debug)]
pub struct GgxRays {
    /// Sine and cosine of the azimuth, and the height.
    points: Vec<((f64, f64), f64)>,
    /// On every panel.
    panels: Vec<[f64; 2]>,
}

/// Visible normals for each point on a panel.
const NORMALS: u32 = 8;

impl GgxRays {
    /// `count` visible normals and an eighth of that on every panel, scrambled Sobol sets of a
    /// seed.
    pub fn new(count: u32, seed: u32) -> GgxRays {
        let set = |seed: u32| Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995, 0]);
        let (normals, panels) = (set(seed), set(seed ^ 0x7feb_352d));
        let point = |i| (ops::sincos(2.0 * PI * normals.coordinate(i, 0)), normals.coordinate(i, 1));
        let on_panel = |i| [0, 1].map(|axis| panels.coordinate(i, axis));
        GgxRays {
            points: (0..count).map(point).collect(),
            panels: (0..count / NORMALS).map(on_panel).collect(),
        }
    }

    /// The light of a room that a GGX surface (height-correlated Smith, no Fresnel) reflects
    /// towards the eye over its own albedo, which a split sum multiplies by afterwards. By
    /// importance sampling of visible normals, whose weight is G2/G1, together with points spread
    /// evenly over every bright panel, both weighted by the balance heuristic (Veach and Guibas
    /// 1995): unbiased, and without the noise of panels that few rays meet. The surface lies where
    /// its normal says, whatever wall is there.
    pub fn reflected(&self, room: &Room, seen: &Seen) -> [f64; 3] {
        let [x, y] = tangents(seen.normal);
        let frame = [x, y, seen.normal];
        let outlook = Outlook::new(room, seen.place, frame);
        let view = frame.map(|axis| dot(axis, seen.view));
        let lit = |light: Vec3| ggx::lit_given_visible(Smith::Correlated, seen.alpha, view[2], light[2]);
        let (count, spread) = (self.points.len() as f64, self.panels.len() as f64);
        let rays = |light: Vec3| count * density(seen.alpha, view, light);
        let (mut sum, mut whole) = ([0.0; 3], 0.0);
        for &(azimuth, height) in &self.points {
            let normal = ggx::visible_normal_at([seen.alpha; 2], view, azimuth, height);
            let (light, _) = ggx::mirror(view, normal);
            if light[2] > 0.0 {
                let weight = lit(light);
                let (radiance, points) = outlook.among(light, spread);
                let share = if points > 0.0 { 1.0 / (1.0 + points / rays(light)) } else { 1.0 };
                sum = plus(sum, scaled(radiance, weight * share));
                whole += weight;
            }
        }
        outlook.panels(&self.panels, |light, radiance, points| {
            if light[2] > 0.0 {
                let share = 1.0 / (1.0 + points / rays(light));
                sum = plus(sum, scaled(radiance, lit(light) * share));
            }
        });
        if whole > 0.0 { scaled(sum, 1.0 / whole) } else { [0.0; 3] }
    }
}

/// Density over solid angle of `light`, the mirror direction of visible normals: G1 D/(4 n.v).
fn density(alpha: f64, view: Vec3, light: Vec3) -> f64 {
    let half = normalise(plus(view, light));
    ggx::distribution(alpha, half) / (2.0 * (view[2] + ggx::stretched_length(alpha, view[2])))
}
