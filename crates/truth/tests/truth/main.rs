//! Quantities against integrals by other means, samples, closed forms and published values.

mod accuracy;
mod aniso_glass;
mod beckmann;
mod beckmann_glass;
mod brdf;
mod coat;
mod eon;
mod error;
mod many;
mod refracted;
mod seen;
mod shadowing;
mod widened;
