//! Rooms of known light, in which lookups of a probe's cubemap are measured.
//!
//! A room is a convex body of planes ([`Convex`]) that shine as [`Room`] says: what is seen from
//! anywhere inside in any direction is known in closed form. [`Patches`] integrates lobes
//! from the probe, which are the fetches of a [`Lookup`] without texels, and from shading points,
//! and [`GgxRays`] what a whole GGX surface reflects.

mod catalogue;
pub mod cubemap;
mod exact;
mod fetch;
mod light;

pub use catalogue::{octagon, practice, room_a, room_b};
pub use exact::{Fineness, GgxRays, Outlook, Patches};
pub use fetch::Rays;
pub use light::{Checker, Panel, Room, Wall};
pub use lobefit::effects::parallax::room::{
    Convex, Fetch, Lookup, Meeting, Plane, Proxy, Seen, Tap, proxies,
};
