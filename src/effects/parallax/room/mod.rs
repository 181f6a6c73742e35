//! How the cubemap of a probe inside a room is looked up.
//!
//! Lengths are metres; z is up. A [`Lookup`] answers a shading point ([`Seen`]) with fetches
//! ([`Tap`]) from the cubemap; a [`Proxy`] is the body that it takes the room for. Rooms of known
//! light, in which lookups are measured, are in the package of the studies.

mod lookup;
pub mod proxies;
mod shape;

pub use lookup::{Fetch, Lookup, Meeting, Proxy, Seen, Tap};
pub use shape::{Convex, Plane};
