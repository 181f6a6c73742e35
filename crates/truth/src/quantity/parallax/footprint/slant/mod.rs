//! Footprints of lobes on a wall that their axes meet at a slant, and the fetches from a probe that
//! come nearest.
//!
//! The wall is the plane z = 0 and q, where the axis of the shading point's lobe meets it, its
//! origin; shading point and probe lie above, each in its distance and at its slant ([`Slant`]). A
//! footprint is the energy per ln R and angle over the wall, R the distance from q: K(theta)
//! cos(psi)/dist^2 R^2, normalised to 1 over the whole plane; what leaves a lobe past the plane's
//! horizon is left out of target and fetch alike. In (ln R, angle) narrow and wide lobes are
//! equally smooth, rows reach from 3e-3 of the narrow axis of the footprint to 300 distances, and
//! the trapezoidal rule converges as it does for [`measures`](super::measures).
//!
//! Distances between footprints f and g ([`Off`]): the total variation (1/2) int |f - g|, the
//! relative root mean square and the largest difference per wall area, and the norm that is
//! minimised, H^-1: the expected squared error over images with a 1/f^2 spectrum on the wall. In ln
//! R the Laplacian has constant coefficients: of the Fourier mode m >= 0 of f - g over the angle,
//! the norm's square is the integral of the squared moving average int exp(-m (x - x')) F_m(x') dx'
//! over x' < x. For m = 0 that is the difference of the encircled energies: on a wall without slant
//! it is the distance of [`adjusted`](super::adjusted).

mod best;
mod case;
mod geometry;
mod normal;
mod wall;

pub use best::{Nearest, best_width};
pub use case::{Case, Off, Squares};
pub use geometry::{Slant, Stand};
pub use normal::Normal;
pub use wall::{Footprint, Resolution, Wall};

pub(super) const QUANTITY: &str = "slanted footprint";
