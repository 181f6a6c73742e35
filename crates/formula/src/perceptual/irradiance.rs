//! The light that a white Lambertian surface sends back under an environment, by quadrature of its
//! parts in closed form.

use std::f64::consts::PI;

use super::environment::{Environment, Lamp};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot, normalise, plus, scaled};

/// Nodes of each panel over the height of the sky.
const NODES: usize = 24;

/// Radiance of a white Lambertian surface with the normal `normal`, of unit length: the mean of the
/// incident light weighted by the cosine, L = 1/pi int L(l) max(n.l, 0) dl. Lamps in closed form,
/// the sky by Gauss rules over its height: to 1e-7 relative.
pub fn diffuse_light(environment: &Environment, normal: Vec3) -> [f64; 3] {
    let lamps = environment.lamps.iter().map(|lamp| scaled(lamp.radiance, share(lamp, normal)));
    lamps.fold(sky(environment, normal), plus)
}

/// 1/pi int max(n.l, 0) dl over a lamp: a cap of half angle s whose axis stands t from the normal.
/// Above the horizon, cos t sin^2 s; below, 0; where the horizon cuts it, with x = cot s and y = -x
/// cot t, 1/pi [sin^2 s (cos t acos y - x sin t sqrt(1 - y^2)) + atan(sin t sqrt(1 - y^2)/x)]
/// (Snyder 1996, "Area Light Sources for Real-Time Graphics").
fn share(lamp: &Lamp, normal: Vec3) -> f64 {
    let cosine = dot(normalise(lamp.towards), normal).clamp(-1.0, 1.0);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let edge = lamp.cosine();
    let square = (1.0 - edge) * (1.0 + edge);
    if cosine >= square.sqrt() {
        return cosine * square;
    }
    if cosine <= -square.sqrt() {
        return 0.0;
    }
    let x = edge / square.sqrt();
    let y = (-x * cosine / sine).clamp(-1.0, 1.0);
    let root = ((1.0 - y) * (1.0 + y)).sqrt();
    let angle = ops::atan2(root, y);
    (square * (cosine * angle - x * sine * root) + ops::atan2(sine * root, x)) / PI
}

/// The same of sky and ground, whose light knows the height h alone: 1/pi int L(h) w(h) dh, w the
/// integral of max(n.l, 0) over the ring of lights at h. Panels end where the light or the ring
/// changes its law; there both go with half powers of the distance, which the substitution
/// h = low + (high - low) t^2 (3 - 2t) makes smooth.
fn sky(environment: &Environment, normal: Vec3) -> [f64; 3] {
    let rim = ((1.0 - normal[1]) * (1.0 + normal[1])).max(0.0).sqrt();
    let mut cuts = vec![-1.0, -environment.haze, 0.0, environment.haze, -rim, rim, 1.0];
    cuts.retain(|cut| (-1.0..=1.0).contains(cut));
    cuts.sort_by(f64::total_cmp);
    let rule = Gauss::new(NODES);
    let mut light = [0.0; 3];
    for cut in cuts.windows(2).filter(|cut| cut[1] > cut[0]) {
        let width = cut[1] - cut[0];
        for (node, weight) in rule.nodes.iter().zip(&rule.weights) {
            let t = 0.5 * (1.0 + node);
            let height = cut[0] + width * (t * t * (3.0 - 2.0 * t));
            let part = 0.5 * weight * width * 6.0 * t * (1.0 - t) * ring(height, normal[1]) / PI;
            // any direction of that height
            let flat = ((1.0 - height) * (1.0 + height)).sqrt();
            light = plus(light, scaled(environment.sky([flat, height, 0.0]), part));
        }
    }
    light
}

/// Integral over the azimuth of max(a + b cos(azimuth), 0), a = h n_y, b = sqrt(1 - h^2)
/// sqrt(1 - n_y^2): the cosine to a normal of height `up` of the lights at a height.
fn ring(height: f64, up: f64) -> f64 {
    let a = height * up;
    let b = ((1.0 - height) * (1.0 + height) * (1.0 - up) * (1.0 + up)).max(0.0).sqrt();
    if a >= b {
        return 2.0 * PI * a;
    }
    if a <= -b {
        return 0.0;
    }
    let sine = ((b - a) * (b + a)).sqrt();
    2.0 * (a * ops::atan2(sine, -a) + sine)
}
