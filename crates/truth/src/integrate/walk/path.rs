//! One path over the microsurface.
//!
//! Heights enter through c in [0, 1] alone, the part of the surface that lies below (the cumulative
//! distribution of heights), so the walk needs no distribution of heights: a ray going up from c
//! reaches c' > c unblocked with probability (c/c')^Lambda, and leaves at c' = 1; one going down
//! reaches c' < c with probability (c'/c)^(1 + Lambda), Lambda that of the opposite direction, as
//! Lambda(-w) = -1 - Lambda(w) (Heitz et al. 2016, with C1(h) = c). The first facet is met from
//! c = 1.

use rand::RngExt;
use rand_pcg::Pcg64;

use super::{BINS, BOUNCES, CHANNELS};
use crate::optics::ggx::{self, Vec3};
use lobefit_math::ops;
use lobefit_math::sobol::DIMENSIONS;

/// Bounces after which a path is given up. At alpha = 1 and no absorption less than 1e-6 of the
/// energy is left after 40; what is left here is counted into the standard error.
const MOST_BOUNCES: usize = 400;

/// What paths brought.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub bounces: [[f64; CHANNELS]; BOUNCES],
    /// Of one bounce, and of more.
    pub lights: [[[f64; CHANNELS]; BINS]; 2],
    pub unfinished: [f64; CHANNELS],
}

impl Tally {
    /// All of it times a factor.
    pub fn scaled(mut self, factor: f64) -> Tally {
        let parts =
            self.bounces.iter_mut().chain(self.lights.as_flattened_mut()).chain([&mut self.unfinished]);
        parts.flatten().for_each(|value| *value *= factor);
        self
    }

    fn score(&mut self, bounce: usize, cosine: f64, energy: [f64; CHANNELS]) {
        let bin = ((cosine * BINS as f64) as usize).min(BINS - 1);
        for channel in 0..CHANNELS {
            self.bounces[bounce.min(BOUNCES - 1)][channel] += energy[channel];
            self.lights[bounce.min(1)][bin][channel] += energy[channel];
        }
    }
}

/// The surface that paths are followed on.
pub(super) struct Path<'a, F> {
    pub alpha: f64,
    pub mu: [f64; 2],
    pub reflectance: &'a F,
}

impl<F: Fn(f64) -> [f64; CHANNELS]> Path<'_, F> {
    /// Follows one path; `first` decides its first facet and height.
    pub fn follow(&self, first: [f64; DIMENSIONS], random: &mut Pcg64, tally: &mut Tally) {
        let view = self.view(random);
        let mut ray = view.map(|x| -x);
        let mut height = self.down(ray, 1.0, first[2]);
        let mut point = [first[0], first[1]];
        let mut energy = [1.0; CHANNELS];
        for bounce in 0..MOST_BOUNCES {
            let from = ray.map(|x| -x);
            let (light, cosine) =
                ggx::mirror(from, ggx::visible_normal([self.alpha; 2], from, point[0], point[1]));
            let reflectance = (self.reflectance)(cosine.clamp(0.0, 1.0));
            energy = std::array::from_fn(|c| energy[c] * reflectance[c]);
            if energy == [0.0; CHANNELS] {
                return;
            }
            ray = light;
            // in (0, 1]
            let x = 1.0 - random.random::<f64>();
            if ray[2] > 0.0 {
                let lambda = ggx::lambda_towards([self.alpha; 2], ray);
                let open = ops::pow(height, lambda);
                tally.score(bounce, ray[2], energy.map(|e| e * open));
                if x <= open {
                    return;
                }
                height = (height * ops::pow(x, -1.0 / lambda)).min(1.0);
            } else if ray[2] < 0.0 {
                height = self.down(ray, height, x);
            }
            point = [random.random(), random.random()];
        }
        for channel in 0..CHANNELS {
            tally.unfinished[channel] += energy[channel];
        }
    }

    /// The direction of the view: mu^2 uniform over its range.
    fn view(&self, random: &mut Pcg64) -> Vec3 {
        let [low, high] = self.mu;
        let mu = if low == high {
            low
        } else {
            (low * low + (high - low) * (high + low) * (1.0 - random.random::<f64>())).sqrt().min(high)
        };
        [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu]
    }

    /// Height of the facet that a ray going down from `height` meets.
    fn down(&self, ray: Vec3, height: f64, x: f64) -> f64 {
        height * ops::pow(x, 1.0 / (1.0 + ggx::lambda_towards([self.alpha; 2], ray)))
    }
}
