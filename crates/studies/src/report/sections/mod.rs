//! The sections of the pages: which figures show which results, and the words around them.

pub mod coupling;
mod metals;
pub mod parallax;
pub mod surfaces;
mod walks;

/// What the lead of a page of a reduced study begins with.
const REDUCED: &str = "REDUCED SIZE, for tests: few points, small pictures, few roughnesses. What it says of better and worse is not the \
     study's. ";
