//! (being built)
pub mod texels;
