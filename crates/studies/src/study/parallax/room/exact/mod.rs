//! Light integrated in a room: lobes by the edges of its patches, which takes no samples
//! ([`Patches`]), and what a surface reflects by rays ([`GgxRays`]).

mod outlook;
mod patches;
mod surface;

pub use outlook::Outlook;
pub use patches::{Fineness, Patches};
pub use surface::GgxRays;
