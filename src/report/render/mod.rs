//! Spheres in the light of an environment, seen from afar: no bounces between them, no shadows, one lobe at each point.
//!
//! [`spheres`] shows several materials of one GGX width under the same sample directions, so that what differs between two of its
//! pictures is the material and hardly the noise; every picture comes in two independent halves, from which the noise of their mean
//! follows. Directions come from scrambled Sobol points whose seeds are the pixel's, rows are computed in parallel and joined in
//! order: the same bytes for any number of threads.

mod directions;
mod environment;
mod irradiance;
mod lit;
mod sphere;

pub use environment::{Environment, Lamp};
pub use irradiance::diffuse_light;
pub use lit::{Halves, Settings, inside, spheres};

use crate::optics::ggx::Vec3;

/// Materials to be shown side by side.
pub trait Materials: Sync {
    /// How many there are.
    fn count(&self) -> usize;

    /// Adds, for each material, the sum over the lights of BRDF times weight to the radiance towards `view` in `sums`, by channel. View
    /// and lights are of unit length and above the horizon of the normal z; a light's weight holds its radiance and its cosine.
    fn shade(&self, view: Vec3, lights: &[(Vec3, [f64; 3])], sums: &mut [[f64; 3]]);
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn scaled(a: Vec3, by: f64) -> Vec3 {
    a.map(|x| x * by)
}

fn plus(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn normalise(a: Vec3) -> Vec3 {
    scaled(a, 1.0 / dot(a, a).sqrt())
}

/// Two directions at right angles to `axis` and to one another (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
fn tangents(axis: Vec3) -> [Vec3; 2] {
    let [x, y, z] = axis;
    let sign = if z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}
