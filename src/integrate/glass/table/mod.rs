//! Tables of `ggx-glass`.
#![allow(missing_docs)]

mod check;
mod effort;
mod ends;
mod grid;
mod interpolation;
mod kernel;
mod lobe;
mod paths;
mod reflect;
mod rings;
mod rules;
mod transmit;

pub use effort::Effort;
pub use grid::{Checked, GlassGrid, Tabulated, tabulate};
pub use kernel::{Energies, Kernel};
pub use paths::Path;
