//! Lobes integrated in a room, fast: the directions of a lobe of any width come from a table, and the walls are turned into the lobe's frame
//! once for all of them.

mod fan;
mod outlook;
mod surface;

pub use fan::{Exact, Fan};
pub use outlook::Outlook;
pub use surface::GgxRays;
