//! A walk over the facets of a rough dielectric interface, through which light may pass any number of times
//! before it leaves (Heitz et al. 2016, sec. 5): nothing is lost.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::{REPLICAS, Walks};
use crate::integrate::IntegrateError;
use crate::integrate::monte_carlo::{
    Draw, Points, Run, Sampled, check_samples, column, of_replicas, refract,
};
use crate::optics::ggx::{self, Vec3};
use lobefit_math::ops;

/// Follows a ray that comes from w (z > 0, on the ray's own side) until it leaves the facets: its direction,
/// and whether it leaves above. `from_above` says which side of the interface w lies on.
pub fn through([alpha, ior]: [f64; 2], w: Vec3, from_above: bool, random: &mut Pcg64) -> (Vec3, bool) {
    // In the frame of the ray's own medium, which is above; `below` is the part of the facets below the ray.
    let (mut ray, mut below, mut is_above) = (w.map(|x| -x), 1.0, from_above);
    loop {
        let u: f64 = random.random();
        let lambda = ggx::lambda_towards([alpha; 2], ray);
        let leaves = if ray[2] > 0.0 { ops::pow(below, lambda) } else { 0.0 };
        if u >= 1.0 - leaves {
            return (if is_above { ray } else { ray.map(|x| -x) }, is_above);
        }
        // A ray that goes down has the Lambda of its opposite: -1 - Lambda.
        let lambda = if ray[2] > 0.0 { lambda } else { -1.0 - lambda };
        below = (below * ops::pow(1.0 - u, -1.0 / lambda)).clamp(0.0, 1.0);
        let from = ray.map(|x| -x);
        let normal = ggx::visible_normal([alpha; 2], from, random.random(), random.random());
        let eta = if is_above { 1.0 / ior } else { ior };
        let (reflectance, refracted) = refract(eta, from, normal);
        ray = match refracted.filter(|_| random.random::<f64>() >= reflectance) {
            None => ggx::mirror(from, normal).0,
            Some(ray) => {
                (is_above, below) = (!is_above, 1.0 - below);
                ray.map(|x| -x)
            }
        };
    }
}

/// The share of diffuse light from below that leaves above.
///
/// # Errors
/// Too few or too many paths.
pub fn escape(interface: [f64; 2], Walks { paths, seed }: Walks) -> Result<Sampled, IntegrateError> {
    let run = Run { samples: paths, seed, points: Points::Random, draw: Draw::VisibleNormal };
    check_samples(run)?;
    let means = of_replicas(run, |each, mut draws| {
        let [stream, turn, _] = draws.next();
        let mut random = Pcg64::seed_from_u64(stream.to_bits() ^ turn.to_bits().rotate_left(REPLICAS as u32));
        let one = |_| {
            let cosine = (1.0 - random.random::<f64>()).sqrt();
            let w = [((1.0 - cosine) * (1.0 + cosine)).sqrt(), 0.0, cosine];
            f64::from(u8::from(through(interface, w, false, &mut random).1))
        };
        [(0..each).map(one).sum::<f64>() / each as f64, 0.0, 0.0]
    });
    Ok(column(&means, paths, |w| w[0]))
}
