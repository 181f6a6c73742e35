//! Spheres in the light of an environment, seen from afar: no bounces between them, no shadows, one
//! lobe at each point.
//!
//! [`spheres`] shows several materials of one GGX width under the same sample directions, so that
//! what differs between two of its pictures is the material and hardly the noise; every picture
//! comes in two independent halves, from which the noise of their mean follows. Directions come
//! from scrambled Sobol points whose seeds are the pixel's, rows are computed in parallel and
//! joined in order: the same bytes for any number of threads.

mod lit;
mod sphere;

pub use lit::{Halves, Settings, inside, spheres};
pub use lobefit_formula::perceptual::{Environment, Lamp, diffuse_light};

use lobefit_truth::optics::ggx::Vec3;

/// Materials to be shown side by side.
pub trait Materials: Sync {
    /// How many there are.
    fn count(&self) -> usize;

    /// Adds, for each material, the sum over the lights of BRDF times weight to the radiance
    /// towards `view` in `sums`, by channel. View and lights are of unit length and above the
    /// horizon of the normal z; a light's weight holds its radiance and its cosine.
    fn shade(&self, view: Vec3, lights: &[(Vec3, [f64; 3])], sums: &mut [[f64; 3]]);
}
