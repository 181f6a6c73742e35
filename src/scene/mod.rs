//! Bytes to a validated scene, which owns every limit on input.
//!
//! A scene is JSON of our own (`lobefit schema` prints its JSON Schema). Unknown and repeated
//! fields, `null`, negative zero and anything out of range are refused with file, line, column and
//! field. Nothing here opens a file.

mod beckmann;
mod culling;
mod file;
mod goals;
mod kernel;
mod layers;
mod limited;
pub mod limits;
mod material;
mod name;
mod number;
mod output;
mod probe;
mod slices;
mod table;
mod wants;

pub use culling::{CULLING, CameraPath, Culling, Generator, Pass, World};
pub use file::{Scene, UNNAMED, schema};
pub use goals::Goals;
pub use kernel::{kernel, kernel_schema};
pub use layers::*;
pub use limited::Limits;
pub use material::{EXACT_FRESNEL, Kind, Lobe, Material, smallest_rough};
pub use output::Output;
pub use probe::Probe;
pub use table::{Layout, Serves, TableWant};
pub use wants::{ExactWant, FitWant, Norm, ValueWant, Wants};

use lobefit_strict::value;
pub use lobefit_strict::{Position, SceneError, escape, place};
