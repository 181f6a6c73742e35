//! Tables of `ggx-glass` and `beckmann-glass`: R and T for hundreds of thousands of texels, in microseconds
//! each where the truth (`super::glass`) takes milliseconds.
//!
//! The kernel shares with the truth nothing but Fresnel's formula. Transmission is swept over the
//! light on the far side, where Fresnel and the distribution are rational (`transmit`, its pieces
//! in `ends`); reflection over rings of facets about the view, which one view has in common for all
//! indices of refraction and both sides (`rings`, `reflect`). Both run eight lanes at a time, in
//! several compiled forms that give the same bits (`paths`). A table interpolates in ln(alpha) only
//! (`grid`, `interpolation`) and recomputes a sample of its texels with more nodes (`check`).

mod check;
mod effort;
mod grid;
mod interpolation;
mod kernel;
mod lobe;
mod paths;
mod reflect;
mod rings;
mod rules;
mod stretch;
mod tabled;
mod transmit;

pub use effort::Effort;
pub use grid::{Checked, GlassGrid, Tabulated, tabulate, tabulate_on};
pub use kernel::{Energies, Kernel, MU, covers};
pub use tabled::Tabled;
