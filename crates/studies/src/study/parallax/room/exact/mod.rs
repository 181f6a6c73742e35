//! Lobes integrated in a room, fast: by the edges of its patches, which takes no samples
//! ([`Patches`]); or by directions that come from a table for a lobe of any width and kernel, the
//! walls turned into the lobe's frame once for all of them ([`Fan`]).

mod fan;
mod outlook;
mod patches;
mod surface;

pub use fan::Fan;
pub use outlook::Outlook;
pub use patches::{Fineness, Patches};
pub use surface::GgxRays;
