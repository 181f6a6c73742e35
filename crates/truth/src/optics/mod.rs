//! Pure models of optics. Each function states its domain, its limits and its source.

mod alpha_map;
pub mod azimuth;
pub mod beckmann;
pub mod diffuse;
pub mod distribution;
pub mod footprint;
pub mod fresnel;
pub mod ggx;
pub mod kernel;
mod mips;
pub mod multiscatter;
mod ndf;
pub mod schlick_smith;
mod smith;

pub use alpha_map::AlphaMap;
pub use mips::{LOG_FROM, LOG_SCALE, MipChain, MipMap};
pub use ndf::Ndf;
pub use smith::Smith;
