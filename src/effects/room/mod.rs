//! Rooms of known light, and how the cubemap of a probe inside is looked up to stand for what a surface in them reflects.
//!
//! Lengths are metres; z is up. A room is a convex body of planes ([`Convex`]) that shine as [`Room`] says: what is seen from anywhere
//! inside in any direction is known in closed form. A [`Lookup`] answers a shading point ([`Seen`]) with fetches ([`Tap`]) from the
//! probe; a [`Proxy`] is what it takes the room for. [`Exact`] integrates fetches without texels, [`Fan`] the same lobe from the shading point,
//! and [`GgxRays`] what a whole GGX surface reflects.

mod catalogue;
pub mod cubemap;
mod exact;
mod fetch;
mod light;
mod lookup;
pub mod proxies;
mod shape;

pub use catalogue::{octagon, practice, room_a, room_b};
pub use exact::{Exact, Fan, GgxRays, Outlook};
pub use fetch::Rays;
pub use light::{Checker, Panel, Room, Wall};
pub use lookup::{Fetch, Lookup, Meeting, Proxy, Seen, Tap};
pub use shape::{Convex, Plane};
