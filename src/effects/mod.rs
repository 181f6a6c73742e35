//! The effects that a scene can call for. Each is a value of [`Effect`] in the [`catalogue`] and has a folder: who calls for it, its
//! quantities, fits and tables, its shader code and its page. What several effects share stands beside their folders.

pub mod anisotropy;
mod called;
mod catalogue;
mod code;
mod containers;
pub mod context;
pub mod coupling;
pub mod demand;
mod deviation;
mod effect;
mod error;
pub mod glass;
pub mod grid;
mod made;
mod notes;
pub mod page;
pub mod parallax;
pub mod reflection;
pub mod room;
mod selection;
pub mod sheen;
pub mod surface;
pub mod table;
mod who;

pub use called::{Called, JobSummary, LeftOut};
pub use catalogue::{catalogue, named};
pub use context::UserHypothesis;
pub use deviation::{Deviation, Rounding};
pub use effect::{Effect, Note};
pub use error::BakeError;
pub use made::{Made, Part};
use notes::{NOTE_F0, NOTE_LOOKUP, NOTE_PATH_TRACER, ggx};
