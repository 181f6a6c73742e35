//! Pure models of optics. Each function states its domain, its limits and its source.

pub mod beckmann;
pub mod diffuse;
pub mod distribution;
pub mod footprint;
pub mod fresnel;
pub mod ggx;
pub mod kernel;
pub mod multiscatter;
pub mod schlick_smith;
mod smith;

pub use smith::Smith;
