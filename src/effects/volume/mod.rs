//! What the effects with tables of three axes share.

mod lookup;

pub use lookup::{Lookup, LookupError, Point};
