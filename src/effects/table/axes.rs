//! Axes of the layouts for the trilinear lookup. All register their end points: the ends of every range are texels.

use crate::data::{Axis, Registration, Warp};

/// Smallest index of refraction from which slices linear in it do better than those that crowd at the matched index.
const APART: f64 = 1.1;

/// Axes of the azimuth mean over the given range of roughness and of anisotropy, in [0, 1].
///
/// The columns follow the layer mu ~ alpha, with alpha the geometric mean of alpha_x and alpha_y.
pub fn aniso_axes(size: [usize; 3], roughness: [f64; 2], anisotropy: [f64; 2]) -> [Axis; 3] {
    let mu = axis("mu", size[0], Warp::Homogeneous, [0.0, 1.0]);
    let slices = axis("anisotropy", size[2], Warp::Aspect, anisotropy);
    [mu, axis("roughness", size[1], Warp::Linear, roughness), slices]
}

/// Axes of the table with the azimuth: those of [`aniso_axes`], the columns looked up with the alpha towards the view,
/// [`super::Azimuth::alpha`], in place of alpha. E at one column then hardly depends on the azimuth for small alpha.
pub fn azimuth_axes(size: [usize; 3], roughness: [f64; 2], anisotropy: [f64; 2]) -> [Axis; 3] {
    let [_, rows, slices] = aniso_axes(size, roughness, anisotropy);
    [axis("mu", size[0], Warp::HomogeneousAzimuth, [0.0, 1.0]), rows, slices]
}

/// Axes of one side of glass over the given range of roughness and of ior, in [1, 4].
///
/// Towards ior = 1 the loss of a view from inside changes where the refraction that an average facet makes, of the order of
/// (ior - 1) / alpha, exceeds mu, and again where mu passes the critical cosine sqrt(2 (ior - 1)). The slices crowd there; the
/// columns follow the second. From outside it is smoother, and the same axes serve.
pub fn glass_axes(size: [usize; 3], roughness: [f64; 2], ior: [f64; 2]) -> [Axis; 3] {
    let mu = axis("mu", size[0], Warp::HomogeneousIor, [0.0, 1.0]);
    let slices = if ior[0] < APART { Warp::Ior } else { Warp::Linear };
    [mu, axis("roughness", size[1], Warp::Linear, roughness), axis("ior", size[2], slices, ior)]
}

fn axis(name: &str, size: usize, warp: Warp, [min, max]: [f64; 2]) -> Axis {
    Axis { name: name.into(), size, registration: Registration::Endpoint, warp, min, max }
}
