//! Bytes of other people's files to plain values. Says what a file holds and nothing about what it
//! means: which axis is roughness, which channel E, where texels sample their axes is for the audit
//! to find out.
//!
//! [`read_table`] reads tables, [`read_functions`] shader functions. Every file is hostile until
//! read: nothing is allocated on the word of a header, values that are not finite are named errors
//! and never numbers, and each message names the file, the place and what to do.

mod error;
mod image;
pub mod limits;
mod recognise;
mod shader;
mod shape;
mod table;
mod text;

pub use error::ForeignError;
use error::Spot;
pub use recognise::read_table;
pub use shader::{LeftOut, ShaderFunction, Surroundings, holds_functions, read_functions};
pub(crate) use shape::{place, words};
pub use table::{Channel, ForeignTable, Hints, RawFormat, Step};
pub use text::holds_arrays;
