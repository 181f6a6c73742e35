//! The integrals against oracles.

mod aniso_many;
mod coupling;
mod error_bound;
mod footprint;
mod glass_table;
mod interpolant;
mod kernel_table;
mod lobes;
mod monte_carlo;
mod oracles;
mod sheen;
mod slant;
mod walk;
